// This part of the server handles meetings of its routes.
#include <spdlog/spdlog.h>

#include "route_server/server.h"
#include "services/base/unix_time.h"
#include "services/route/labels.h"

namespace trailcast::server {

void Server::NoteOfNetwork(const route::RouteInfo& info) {
  network_->Note(info);
  junctions_->Note(info);
}

void Server::KeepLookingForJunctions(std::chrono::steady_clock::time_point now) {
  if (!junctions_ || !upkeep_->store_trouble().empty()) return;
  if (const auto turned = junctions_->Turn(now); !turned) {
    const bool is_fault = turned.error().code == ErrorCode::kInternal;
    spdlog::log(is_fault ? spdlog::level::err : spdlog::level::debug, "looking for junctions: {}",
                turned.error().message);
  }
  for (const Crossing& crossing : junctions_->TakeCrossings()) Tell(crossing, now);
  for (const Meeting& meeting : junctions_->TakeMeetings()) Propose(meeting);
  for (const route::RouteKey& key : junctions_->TakeSearched()) {
    ++metrics_.junctions.routes_searched;
    network_->MarkSearched(key);
  }
}

// Commits are collected, because one for each would delay acknowledgements while many routes are
// searched and many robots follow.
void Server::KeepWhatIsLearnt() {
  if (!network_) return;
  if (const auto saved = network_->SaveSearched(); !saved) {
    spdlog::warn("some routes will be searched for junctions again: {}", saved.error().message);
  }
  if (const auto kept = network_->KeepFollowed(NowUnixMs()); !kept) {
    spdlog::warn("how well robots follow is not saved: {}", kept.error().message);
  }
}

void Server::Propose(const Meeting& meeting) {
  constexpr double kNever = 2.0;
  const auto proposed =
      network_->Propose(meeting, takes_sure_junctions_ ? kSure : kNever, NowUnixMs());
  NoteMade();
  if (!proposed) {
    spdlog::warn("proposing a junction: {}", proposed.error().message);
  } else if (*proposed && (*proposed)->taken) {
    ++metrics_.junctions.taken;
    spdlog::info("{}: taken, as --junctions-auto says", (*proposed)->line);
  } else if (*proposed) {
    ++metrics_.junctions.proposed;
    spdlog::info("{}: 'trailcast network confirm' makes it one", (*proposed)->line);
  }
}

void Server::Tell(const Crossing& crossing, std::chrono::steady_clock::time_point now) {
  ++metrics_.junctions.crossings;
  const std::string text = fmt::format("crosses {} at {:.1f} m", crossing.known, crossing.along_m);
  spdlog::info("{}, which is being taught, {}", route::Describe(crossing.teaching), text);
  keeper_->Remark(crossing.teaching.key, text, now);
}

}  // namespace trailcast::server
