// This part of FollowerLink notes how far along its route the robot is, for the next run.
#include <spdlog/spdlog.h>

#include <utility>

#include "agent/link/follower_link.h"
#include "services/base/time.h"
#include "services/base/unix_time.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// This is often enough to find the place again, and no burden for a memory card.
constexpr milliseconds kNoteEvery{1000};

void Complain(const Result<void>& noted) {
  if (!noted)
    spdlog::warn("a later run will not know where this one got to: {}", noted.error().message);
}

}  // namespace

std::optional<LeftAt> FollowerLink::ReadPlace() const {
  if (options_.begin_m > 0.0) return LeftAt{.along_m = options_.begin_m};
  if (options_.place_file.empty() || options_.from_start) return std::nullopt;
  const auto noted = place_note_.Read();
  if (!noted) {
    spdlog::warn("beginning at the route's start: {}", noted.error().message);
    return std::nullopt;
  }
  if (!*noted) return std::nullopt;
  const NotedPlace& place = **noted;
  if (place.key != route_->key) {
    spdlog::info("beginning at the route's start: the last run was on another route or revision");
    return std::nullopt;
  }
  spdlog::info(
      "the last run got {:.1f} m along the route, {:.0f} s ago: looking whether the robot "
      "is still there",
      place.along_m, 1e-3 * static_cast<double>(NowUnixMs() - place.unix_ms));
  return LeftAt{place.along_m, place.magnification};
}

void FollowerLink::TakeReports() {
  while (auto report = reports_.TryGet()) {
    latest_ = std::move(*report);
    if (route_ && options_.notes_followed) followed_note_.Note(latest_, *route_);
  }
  if (latest_.state == ReplayState::kFollowing && latest_.along_m && route_) {
    place_ = {route_->key, *latest_.along_m, latest_.magnification, NowUnixMs()};
  }
}

void FollowerLink::NotePlace() {
  const auto now = steady_clock::now();
  const bool due = !noted_ || now - *noted_ >= kNoteEvery;
  if (options_.place_file.empty() || !place_ || !due) return;
  noted_ = now;
  Complain(place_note_.Write(*place_));
}

void FollowerLink::EndNote(exchange::AgentMode mode) {
  if (options_.place_file.empty()) return;
  if (mode == exchange::AgentMode::kArrived) {
    Complain(place_note_.Remove());
  } else if (place_) {
    Complain(place_note_.Write(*place_));
  }
}

}  // namespace trailcast::agent
