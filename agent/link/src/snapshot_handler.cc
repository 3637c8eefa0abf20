#include "agent/link/snapshot_handler.h"

#include <algorithm>
#include <variant>

#include "services/base/text.h"
#include "services/exchange/bounds.h"

namespace trailcast::agent {

void SnapshotHandler::Handle(const exchange::Message& message, Time now) {
  const auto* request = std::get_if<exchange::SnapshotRequest>(&message);
  if (request == nullptr || request->agent != self_) return;
  Forget(now);
  const auto before = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return waiting.request.client == request->client;
  });
  if (before != waiting_.end()) {
    *before = {*request, now};
  } else if (waiting_.size() < kMostClients) {
    waiting_.push_back({*request, now});
  }
}

// A request this old is given up, or its client has asked again.
void SnapshotHandler::Forget(Time now) {
  std::erase_if(waiting_, [&](const Waiting& waiting) { return now - waiting.since > kAskedFor; });
  if (waiting_.empty()) asked_ = false;
}

bool SnapshotHandler::Asks(Time now) {
  Forget(now);
  if (asked_ || waiting_.empty()) return false;
  if (asked_at_ && now - *asked_at_ < kEvery) return false;
  asked_ = true;
  asked_at_ = now;
  return true;
}

bool SnapshotHandler::AskedInVain(Time now) const { return asked_ && now - *asked_at_ > kPatience; }

std::optional<exchange::Snapshot> SnapshotHandler::Give(CameraPicture picture, Time now) {
  Forget(now);
  if (!asked_) return std::nullopt;
  asked_ = false;
  const exchange::SnapshotRequest request = waiting_.front().request;
  waiting_.pop_front();
  return exchange::Snapshot{.agent = self_,
                            .client = request.client,
                            .request = request.request,
                            .picture = std::move(picture.jpeg),
                            .marked = picture.marked,
                            .detail = PlainText(picture.detail, exchange::kMaxLineBytes)};
}

}  // namespace trailcast::agent
