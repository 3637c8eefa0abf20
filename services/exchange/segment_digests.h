#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "services/route/route.h"

namespace trailcast::exchange {

// These are the digests of some of a route's segments, in one block of memory. A map's hundred
// thousand small nodes, allocated one by one between messages that come and go, would keep freed
// memory from being used again. Segments come nearly in order, which costs least.
class SegmentDigests {
 public:
  struct Entry {
    SegmentIndex index;
    route::Digest digest;
  };

  SegmentDigests() = default;
  // Takes those of segments 0, 1, .. in order.
  explicit SegmentDigests(const std::vector<route::Digest>& digests) {
    for (const route::Digest& digest : digests) {
      Put(SegmentIndex(static_cast<std::uint32_t>(entries_.size())), digest);
    }
  }

  [[nodiscard]] const route::Digest* Find(SegmentIndex index) const {
    const auto at = From(index);
    return at != entries_.end() && at->index == index ? &at->digest : nullptr;
  }
  [[nodiscard]] bool contains(SegmentIndex index) const { return Find(index) != nullptr; }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  // Returns all, rising.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  // Returns the first entry that is not below `index`.
  [[nodiscard]] std::vector<Entry>::const_iterator From(SegmentIndex index) const {
    return std::lower_bound(
        entries_.begin(), entries_.end(), index,
        [](const Entry& entry, SegmentIndex wanted) { return entry.index < wanted; });
  }

  void Put(SegmentIndex index, const route::Digest& digest) {
    const auto at = entries_.begin() + (From(index) - entries_.cbegin());
    if (at != entries_.end() && at->index == index) {
      at->digest = digest;
    } else {
      entries_.insert(at, {index, digest});
    }
  }
  // Returns the removed digest, if there was one.
  std::optional<route::Digest> Remove(SegmentIndex index) {
    const auto at = From(index);
    if (at == entries_.end() || at->index != index) return std::nullopt;
    const route::Digest digest = at->digest;
    entries_.erase(at);
    return digest;
  }
  void clear() { entries_.clear(); }

 private:
  std::vector<Entry> entries_;  // by index
};

}  // namespace trailcast::exchange
