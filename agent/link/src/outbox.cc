#include "agent/link/outbox.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/route/digest.h"
#include "services/route/labels.h"

namespace trailcast::agent {
namespace {

std::vector<SegmentIndex> Without(const std::vector<SegmentIndex>& all,
                                  const std::vector<SegmentIndex>& some) {
  std::vector<SegmentIndex> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace

Result<std::vector<std::string>> Outbox::LoadBacklog() {
  auto routes = store_.ListRoutes();
  if (!routes) return tl::unexpected(routes.error());
  std::vector<std::string> notes;
  for (route::RouteInfo& info : *routes) {
    auto unreceipted = store_.UnreceiptedSegments(info.key);
    if (!unreceipted) return tl::unexpected(unreceipted.error());
    const bool unwanted = info.standing == route::Standing::kRetired;
    const bool taken = sending_.contains(info.key) || info.key == spared_;
    if (unreceipted->empty() || unwanted || taken) continue;
    if (info.state == route::RouteState::kTeaching && info.scout != self_) {
      notes.push_back(
          fmt::format("route '{}' was left unfinished by agent '{}' and is not sent: run with "
                      "--name {} for that",
                      info.name, info.scout.value(), info.scout.value()));
      continue;
    }
    auto note = TakeUp(std::move(info), Receipts::kNoted);
    if (!note) return tl::unexpected(note.error());
    notes.push_back(std::move(*note));
  }
  return notes;
}

Result<std::string> Outbox::TakeUp(route::RouteInfo info, Receipts receipts) {
  auto held = store_.SegmentDigests(info.key);
  auto unreceipted = store_.UnreceiptedSegments(info.key);
  if (!held) return tl::unexpected(held.error());
  if (!unreceipted) return tl::unexpected(unreceipted.error());
  const bool cut_off = info.state == route::RouteState::kTeaching;
  if (cut_off) {
    if (auto ended = EndCutOff(info, *held); !ended) return tl::unexpected(ended.error());
  }
  exchange::SegmentDigests digests;
  std::vector<SegmentIndex> indices;
  for (const store::HeldSegment& segment : *held) {
    digests.Put(segment.index, segment.digest);
    indices.push_back(segment.index);
  }
  const std::size_t damaged =
      info.segment_count - std::min<std::size_t>(info.segment_count, indices.size());
  const bool noted = receipts == Receipts::kNoted;
  Emplace(info, std::move(digests),
          noted ? Without(indices, *unreceipted) : std::vector<SegmentIndex>(), std::nullopt);
  return fmt::format(
      "{} from an earlier run: {} of {} segments are not acknowledged{}{}", route::Describe(info),
      unreceipted->size(), info.segment_count,
      cut_off ? "; its teaching was cut off, it ends there, and no robot follows it unless an "
                "operator activates it"
              : "",
      damaged > 0 ? fmt::format("; {} are damaged on the disk and cannot be sent", damaged) : "");
}

void Outbox::Emplace(const route::RouteInfo& info, exchange::SegmentDigests held,
                     const std::vector<SegmentIndex>& receipted,
                     std::optional<route::RouteBuilder> teaching) {
  auto read = [this, key = info.key](SegmentIndex index) { return store_.ReadSegment(key, index); };
  exchange::RouteSender sender(self_, info, std::move(read), std::move(held), receipted);
  sending_.emplace(info.key, Sending{std::move(sender), std::move(teaching)});
}

Result<void> Outbox::Begin(const route::RouteInfo& info) {
  route::RouteBuilder teaching(info);
  const route::RouteInfo empty = teaching.info();
  if (auto put = store_.PutRoute(empty); !put) return put;
  Emplace(empty, {}, {}, std::move(teaching));
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

Result<void> Outbox::Complete(const route::RouteKey& key, bool cut_off) {
  Sending& sending = sending_.at(key);
  sending.teaching->Complete(cut_off);
  if (auto put = store_.PutRoute(sending.teaching->info()); !put) return put;
  sending.sender.Update(sending.teaching->info());
  return {};
}

void Outbox::Handle(const exchange::Message& message, Time now) {
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    if (status->role == exchange::AgentRole::kServer) servers_.Touch(status->agent);
  }
  if (const auto* request = std::get_if<exchange::SegmentRequest>(&message)) OfferAgain(*request);
  for (auto& [key, sending] : sending_) sending.sender.Handle(message, now);
}

void Outbox::OfferAgain(const exchange::SegmentRequest& request) {
  if (!request.lacking.empty() || servers_.Find(request.requester) == nullptr) return;
  if (sending_.contains(request.key)) return;
  auto info = store_.FindRoute(request.key);
  if (!info || !*info || (*info)->state != route::RouteState::kComplete) return;
  if ((*info)->standing == route::Standing::kRetired) return;
  const std::string which = route::Describe(**info);
  if (auto taken = TakeUp(std::move(**info), Receipts::kNone); !taken) {
    spdlog::warn("cannot offer {} to '{}': {}", which, request.requester.value(),
                 taken.error().message);
  } else {
    spdlog::info("server '{}' lacks {}, which this agent holds: sending it again",
                 request.requester.value(), which);
  }
}

std::vector<exchange::Message> Outbox::Tick(Time now) {
  std::vector<exchange::Message> messages;
  // Earlier revisions come first, because a server activates a route's first complete one.
  std::vector<exchange::RouteSender*> senders;
  for (auto& [key, sending] : sending_) senders.push_back(&sending.sender);
  std::sort(senders.begin(), senders.end(),
            [](const auto* a, const auto* b) { return a->info().revision < b->info().revision; });
  for (exchange::RouteSender* sender : senders) {
    auto due = sender->Tick(now);
    std::move(due.begin(), due.end(), std::back_inserter(messages));
  }
  return messages;
}

void Outbox::NotSent(const exchange::Message& message, Time now) {
  for (auto& [key, sending] : sending_) sending.sender.NotSent(message, now);
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
    if (auto numbered = sending.sender.TakeNumbered()) {
      if (sending.laid_aside) numbered->standing = route::Standing::kRetired;
      if (auto put = store_.PutRoute(*numbered); !put) return put;
    }
    if (sending.sender.deleted() && !std::exchange(sending.laid_aside, true)) {
      route::RouteInfo kept = sending.sender.info();
      kept.standing = route::Standing::kRetired;
      if (auto put = store_.PutRoute(kept); !put) return put;
    }
    for (const SegmentIndex index : sending.sender.TakeNewlyReceipted()) {
      sending.confirmed.insert(index);
    }
    // The last segment's acknowledgement is written down together with the whole route's. Until
    // then, another run knows that the route's end may not have reached a server.
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
  for (const auto& [key, sending] : sending_) {
    if (!sending.sender.deleted()) count += sending.sender.Unreceipted().size();
  }
  return count;
}

std::optional<std::string> Outbox::refusal() const {
  for (const auto& [key, sending] : sending_) {
    const std::string which = route::Describe(sending.sender.info());
    if (const auto& refused = sending.sender.refused()) {
      return fmt::format("server '{}' takes nothing of {}: {}", refused->server.value(), which,
                         refused->reason);
    }
    if (const auto& server = sending.sender.contradicted_by()) {
      return fmt::format(
          "server '{}' holds other segments under the identity of {} (was this robot's store "
          "copied, or put back from a backup?): nothing of it counts as acknowledged there",
          server->value(), which);
    }
  }
  return std::nullopt;
}

const std::string& Outbox::remark(const route::RouteKey& key) const {
  return sending_.at(key).sender.remark();
}

std::optional<exchange::StandingThere> Outbox::standing(const route::RouteKey& key) const {
  return sending_.at(key).sender.standing();
}

std::vector<route::RouteInfo> Outbox::Receipted() const {
  std::vector<route::RouteInfo> receipted;
  for (const auto& [key, sending] : sending_) {
    if (sending.sender.AllReceipted()) receipted.push_back(sending.sender.info());
  }
  return receipted;
}

bool Outbox::Done() const {
  return std::all_of(sending_.begin(), sending_.end(),
                     [](const auto& entry) { return entry.second.sender.Done(); });
}

bool Outbox::AllReceipted() const {
  return std::all_of(sending_.begin(), sending_.end(),
                     [](const auto& entry) { return entry.second.sender.AllReceipted(); });
}

}  // namespace trailcast::agent
