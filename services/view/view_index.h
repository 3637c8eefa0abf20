#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "services/route/route.h"
#include "services/route/view.h"

namespace trailcast::view {

struct ViewIndexOptions {
  std::uint32_t most_segments = 200'000;
  // The last segment may exceed this. README.md says how much a segment takes.
  std::size_t most_bytes = 100'000'000;
};

// This finds segments with features that look like those of a view. It is an inverted index from 20
// bits of a descriptor (its word) to the segments, with 12 more bits (its check) to tell apart
// features that share a word. It also looks up words that differ by up to two bits, so that nothing
// need be learnt beforehand. It finds candidates, which are then compared feature by feature
// (view_match.h). It is not thread-safe.
class ViewIndex {
 public:
  struct Place {
    route::RouteKey key;
    SegmentIndex segment;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
    auto operator<=>(const Place&) const = default;
  };

  explicit ViewIndex(const ViewIndexOptions& options = {});

  // Returns false, and adds nothing, when the index is full. A segment that it already holds stays
  // unchanged.
  [[nodiscard]] bool Add(const route::RouteKey& key, const route::Segment& segment);
  // Removes all of the route's segments, if there are any.
  void Remove(const route::RouteKey& key);

  // Returns the segments with the most features in common, weighted by their similarity, the best
  // first.
  [[nodiscard]] std::vector<Place> Candidates(std::span<const route::ViewFeature> view,
                                              std::size_t most);

  [[nodiscard]] bool Holds(const Place& place) const;
  // Returns the segments of the place's route that come up to so many before or after it, without
  // itself.
  [[nodiscard]] std::vector<Place> Around(const Place& place, std::size_t before_and_after) const;
  [[nodiscard]] std::size_t routes() const { return routes_.size(); }
  // Returns the number of segments.
  [[nodiscard]] std::size_t size() const { return slots_.size() - free_slots_.size() - dead_; }
  [[nodiscard]] bool full() const {
    const std::size_t for_reuse = free_chunks_.size() * sizeof(Chunk);
    return size() >= options_.most_segments || bytes() - for_reuse >= options_.most_bytes;
  }
  // Returns the size of the tables with their content.
  [[nodiscard]] std::size_t bytes() const;

 private:
  // The upper 20 bits of an entry are its segment's slot, the lower 12 its check.
  static constexpr std::uint32_t kNoEntry = 0xFFFFFFFFU;
  struct Chunk {
    std::array<std::uint32_t, 7> entries;
    std::uint32_t next;  // 0 is none
  };
  static constexpr std::uint32_t kChunksABlock = 4096;
  using Block = std::array<Chunk, kChunksABlock>;
  struct Route {
    std::uint32_t number = 0;
    std::vector<std::uint32_t> segments;  // in order
  };
  struct Slot {
    std::uint32_t route = 0;  // its number
    std::uint32_t segment = 0;
    std::uint32_t features = 0;
  };
  static constexpr std::size_t kOctaves = 4;
  struct Tally {
    std::array<std::uint16_t, kOctaves> votes{};  // by the size of the features that voted
    std::uint16_t voter = 0;                      // the last feature of the view that voted
  };

  // Returns nothing when all are taken.
  [[nodiscard]] std::optional<std::uint32_t> TakeSlot();
  // Returns the route, which gets a number if it is new.
  [[nodiscard]] Route& RouteOf(const route::RouteKey& key);
  void InsertAll();  // inserts entries_
  void Insert(std::uint32_t word, std::uint32_t entry);
  [[nodiscard]] std::uint32_t TakeChunk(std::uint32_t next);
  [[nodiscard]] Chunk& ChunkAt(std::uint32_t number) {
    return (*blocks_[number / kChunksABlock])[number % kChunksABlock];
  }
  void Sweep();
  void SweepWord(std::uint32_t word);
  void FindAlike(const route::Descriptor& descriptor);
  void FindAlike(std::uint32_t chunk, std::uint32_t check);
  void Vote(std::uint16_t number, std::size_t octave);
  [[nodiscard]] static int Votes(const Tally& tally);

  ViewIndexOptions options_;
  std::vector<std::uint32_t> heads_;  // by word: its first chunk's number, or 0
  // Chunks lie in blocks, so that they are not scattered among short-lived memory.
  std::vector<std::unique_ptr<Block>> blocks_;
  std::uint32_t chunk_count_ = 1;  // number 0 is not used
  std::vector<std::uint32_t> free_chunks_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_slots_;
  std::size_t dead_ = 0;  // slots whose segment was removed, but not their entries
  std::map<route::RouteKey, Route> routes_;
  std::vector<const route::RouteKey*> keys_;  // by number: the keys in routes_
  std::vector<std::uint32_t> free_numbers_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      entries_;                        // being inserted, with their words
  std::vector<Tally> tallies_;         // by slot, while voting
  std::vector<std::uint32_t> alike_;   // slots
  std::vector<std::uint32_t> chains_;  // the chains that are searched for them
};

}  // namespace trailcast::view
