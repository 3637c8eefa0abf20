#include "agent/link/outbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/route/digest.h"

namespace trailcast::agent {
namespace {

// Segments 0..n-1 that are held without a gap.
std::uint32_t PrefixLength(const std::vector<SegmentIndex>& held) {
  std::uint32_t length = 0;
  while (length < held.size() && held[length].value() == length) ++length;
  return length;
}

std::vector<SegmentIndex> Without(const std::vector<SegmentIndex>& all,
                                  const std::vector<SegmentIndex>& some) {
  std::vector<SegmentIndex> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}

// Grows `info` by one segment.
void Count(route::RouteInfo& info, const route::Segment& segment, std::size_t bytes) {
  ++info.segment_count;
  info.length_m += segment.length_m;
  info.bytes += bytes;
}

}  // namespace

Result<std::vector<std::string>> Outbox::LoadBacklog() {
  auto routes = store_.ListRoutes();
  if (!routes) return tl::unexpected(routes.error());
  std::vector<std::string> notes;
  for (route::RouteInfo& info : *routes) {
    auto unreceipted = store_.UnreceiptedSegments(info.key);
    if (!unreceipted) return tl::unexpected(unreceipted.error());
    if (unreceipted->empty() || sending_.contains(info.key)) continue;
    if (info.state == route::RouteState::kTeaching && info.scout != self_) {
      notes.push_back(
          fmt::format("route '{}' was left unfinished by agent '{}' and is not sent: run with "
                      "--name {} for that",
                      info.name, info.scout.value(), info.scout.value()));
      continue;
    }
    auto note = TakeUp(std::move(info));
    if (!note) return tl::unexpected(note.error());
    notes.push_back(std::move(*note));
  }
  return notes;
}

Result<std::string> Outbox::TakeUp(route::RouteInfo info) {
  auto held = store_.HeldSegments(info.key);
  auto unreceipted = store_.UnreceiptedSegments(info.key);
  if (!held) return tl::unexpected(held.error());
  if (!unreceipted) return tl::unexpected(unreceipted.error());
  const bool cut_off = info.state == route::RouteState::kTeaching;
  const std::uint32_t count = cut_off ? PrefixLength(*held) : info.segment_count;
  // A crash may come between a segment and the info that counts it: count anew.
  route::RouteInfo counted = info;
  counted.segment_count = 0;
  counted.length_m = 0.0;
  counted.bytes = 0;
  std::vector<route::Digest> digests;
  for (std::uint32_t i = 0; i < count; ++i) {
    auto piece = store_.ReadSegment(info.key, SegmentIndex(i));
    if (!piece) return tl::unexpected(piece.error());
    auto segment = route::Open(*piece);
    if (!segment) return tl::unexpected(segment.error());
    Count(counted, *segment, piece->bytes.size());
    digests.push_back(piece->digest);
  }
  if (cut_off) {
    info = counted;
    info.manifest_digest = route::ManifestDigest(digests);
    info.state = route::RouteState::kComplete;
    if (auto put = store_.PutRoute(info); !put) return tl::unexpected(put.error());
  }
  Emplace(info, Without(*held, *unreceipted), std::nullopt);
  return fmt::format("route '{}' from an earlier run: {} of {} segments have no receipt{}",
                     info.name, unreceipted->size(), info.segment_count,
                     cut_off ? "; its teaching was cut off and it ends there" : "");
}

void Outbox::Emplace(const route::RouteInfo& info, const std::vector<SegmentIndex>& receipted,
                     std::optional<route::RouteBuilder> teaching) {
  auto read = [this, key = info.key](SegmentIndex index) { return store_.ReadSegment(key, index); };
  exchange::RouteSender sender(self_, info, std::move(read), receipted);
  sending_.emplace(info.key, Sending{std::move(sender), std::move(teaching), {}});
}

Result<void> Outbox::Begin(const route::RouteInfo& info) {
  route::RouteBuilder teaching(info);
  const route::RouteInfo empty = teaching.info();
  if (auto put = store_.PutRoute(empty); !put) return put;
  Emplace(empty, {}, std::move(teaching));
  return {};
}

Result<void> Outbox::Add(const route::RouteKey& key, const route::Segment& segment) {
  Sending& sending = sending_.at(key);
  route::SegmentPiece piece = sending.teaching->Add(segment);
  const auto taught_before = store_.FindContent(piece.digest);
  if (!taught_before) return tl::unexpected(taught_before.error());
  if (auto appended = store_.AppendSegments({&piece, 1}); !appended) return appended;
  if (auto put = store_.PutRoute(sending.teaching->info()); !put) return put;
  if (*taught_before) piece.bytes.clear();
  sending.sender.Add(std::move(piece), sending.teaching->info());
  return {};
}

Result<void> Outbox::Complete(const route::RouteKey& key) {
  Sending& sending = sending_.at(key);
  sending.teaching->Complete();
  if (auto put = store_.PutRoute(sending.teaching->info()); !put) return put;
  sending.sender.Update(sending.teaching->info());
  return {};
}

void Outbox::Handle(const exchange::Message& message, Time now) {
  for (auto& [key, sending] : sending_) sending.sender.Handle(message, now);
}

std::vector<exchange::Message> Outbox::Tick(Time now) {
  std::vector<exchange::Message> messages;
  for (auto& [key, sending] : sending_) {
    auto due = sending.sender.Tick(now);
    std::move(due.begin(), due.end(), std::back_inserter(messages));
  }
  return messages;
}

std::vector<Error> Outbox::TakeReadErrors() {
  std::vector<Error> errors;
  for (auto& [key, sending] : sending_) {
    auto some = sending.sender.TakeReadErrors();
    std::move(some.begin(), some.end(), std::back_inserter(errors));
  }
  return errors;
}

Result<void> Outbox::SaveReceipts() {
  for (auto& [key, sending] : sending_) {
    for (const SegmentIndex index : sending.sender.TakeNewlyReceipted()) {
      sending.confirmed.insert(index);
    }
    // The last segment's receipt is written down with the whole route's: as long as it is not,
    // another run knows that the route's end may not have reached a server.
    const SegmentIndex last(sending.sender.info().segment_count - 1);
    std::vector<SegmentIndex> ready(sending.confirmed.begin(), sending.confirmed.end());
    if (!sending.sender.AllReceipted()) std::erase(ready, last);
    if (ready.empty()) continue;
    if (auto marked = store_.MarkReceipted(key, ready); !marked) return marked;
    for (const SegmentIndex index : ready) sending.confirmed.erase(index);
  }
  return {};
}

const route::RouteInfo& Outbox::info(const route::RouteKey& key) const {
  return sending_.at(key).sender.info();
}

std::size_t Outbox::unreceipted() const {
  std::size_t count = 0;
  for (const auto& [key, sending] : sending_) count += sending.sender.Unreceipted().size();
  return count;
}

std::optional<std::string> Outbox::refusal() const {
  for (const auto& [key, sending] : sending_) {
    const auto& refused = sending.sender.refused();
    if (!refused) continue;
    return fmt::format("server '{}' takes nothing of route '{}' revision {}: {}",
                       refused->server.value(), sending.sender.info().name, key.revision.value(),
                       refused->reason);
  }
  return std::nullopt;
}

bool Outbox::AllReceipted() const {
  return std::all_of(sending_.begin(), sending_.end(),
                     [](const auto& entry) { return entry.second.sender.AllReceipted(); });
}

}  // namespace trailcast::agent
