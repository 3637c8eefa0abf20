// This part of the outbox ends, continues or gives up teachings that were cut off.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "agent/link/outbox.h"
#include "services/route/digest.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::agent {
namespace {

// Returns how many segments from 0 are held without a gap.
std::uint32_t PrefixLength(const std::vector<store::HeldSegment>& held) {
  std::uint32_t length = 0;
  while (length < held.size() && held[length].index.value() == length) ++length;
  return length;
}

}  // namespace

// Segments are counted again, because a crash may come between a segment and the info that counts
// it. A segment that cannot be read counts with the others' mean, and is requested from any holder.
Result<void> Outbox::EndCutOff(route::RouteInfo& info,
                               const std::vector<store::HeldSegment>& held) {
  const std::uint32_t count = PrefixLength(held);
  std::vector<route::Digest> digests;
  std::uint32_t whole = 0;
  info.length_m = 0.0;
  info.bytes = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    digests.push_back(held[i].digest);
    auto piece = store_.ReadSegment(info.key, SegmentIndex(i));
    auto segment = piece ? route::Open(*piece) : tl::unexpected(piece.error());
    if (!segment && segment.error().code != ErrorCode::kCorrupt) {
      return tl::unexpected(segment.error());
    }
    if (!segment) continue;
    ++whole;
    info.length_m += segment->length_m;
    info.bytes += piece->bytes.size();
  }
  if (whole > 0) {
    info.length_m *= static_cast<double>(count) / whole;
    info.bytes = info.bytes * count / whole;
  }
  info.segment_count = count;
  info.manifest_digest = route::ManifestDigest(digests);
  info.state = route::RouteState::kComplete;
  info.cut_off = true;
  return store_.PutRoute(info);
}

Result<void> Outbox::GoOn(const route::RouteInfo& earlier, const route::RouteInfo& info) {
  const auto held = store_.SegmentDigests(earlier.key);
  const auto unreceipted = store_.UnreceiptedSegments(earlier.key);
  if (!held) return tl::unexpected(held.error());
  if (!unreceipted) return tl::unexpected(unreceipted.error());
  const bool same = info.key == earlier.key;
  route::RouteBuilder teaching(info);
  exchange::SegmentDigests digests;
  std::set<SegmentIndex> receipted;
  std::vector<route::SegmentPiece> pieces;
  for (std::uint32_t i = 0; i < std::max(PrefixLength(*held), earlier.segment_count); ++i) {
    auto piece = store_.ReadSegment(earlier.key, SegmentIndex(i));
    const auto segment = piece ? route::Open(*piece) : tl::unexpected(piece.error());
    if (!segment) {
      return Wrap(segment.error(), fmt::format("cannot go on with {}", route::Describe(earlier)));
    }
    piece->key = info.key;
    teaching.Add(*piece, segment->length_m);
    digests.Put(piece->index, piece->digest);
    if (same) receipted.insert(piece->index);
    pieces.push_back(std::move(*piece));
  }
  for (const SegmentIndex index : *unreceipted) receipted.erase(index);
  if (!same) {
    if (auto appended = store_.AppendSegments(pieces); !appended) return appended;
  }
  const route::RouteInfo begun = teaching.info();
  if (auto put = store_.PutRoute(begun); !put) return put;
  Emplace(begun, std::move(digests), {receipted.begin(), receipted.end()}, std::move(teaching));
  return {};
}

Result<std::string> Outbox::Discard(route::RouteInfo info, bool send) {
  const auto held = store_.SegmentDigests(info.key);
  const auto unreceipted = store_.UnreceiptedSegments(info.key);
  if (!held) return tl::unexpected(held.error());
  if (!unreceipted) return tl::unexpected(unreceipted.error());
  const std::string which = route::Describe(info);
  const std::string id = route::ShortIds().Of(info);
  // Segments that were sent a moment ago may have arrived as well.
  const bool may_be_there = unreceipted->size() < held->size() || sending_.contains(info.key);
  if (may_be_there && send) {
    if (auto taken = TakeUp(info, Receipts::kNoted); !taken) return taken;
    info = sending_.at(info.key).sender.info();
    sending_.at(info.key).laid_aside = true;
  }
  info.standing = route::Standing::kRetired;
  if (auto put = store_.PutRoute(info); !put) return tl::unexpected(put.error());
  if (!may_be_there) {
    return fmt::format("{} ({}) is discarded: no server has confirmed any of it", which, id);
  }
  return fmt::format(
      "{} ({}) is discarded here; a server may have some of it, and no scout deletes anything "
      "there: "
      "{}an operator deletes it with 'trailcast routes delete {}'",
      which, id,
      send ? "it is told that the teaching was cut off, so that no robot follows it, and " : "",
      id);
}

}  // namespace trailcast::agent
