#include "agent/teach/src/going_on.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "agent/session/end_finder.h"
#include "services/route/labels.h"

namespace trailcast::agent {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::seconds kTellStillEvery{5};

Result<void> CheckAlike(const RobotDevice& device, const Observation& first,
                        const route::RouteInfo& cut_off, const route::Segment& last,
                        const vision::IntakeOptions& intake) {
  const auto size = vision::WorkingSize({first.image.width, first.image.height}, intake);
  const bool same_size =
      size.width == cut_off.image_width_px && size.height == cut_off.image_height_px;
  if (device.camera() != cut_off.camera || !same_size) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} was taught with camera '{}' ({} x {}) and cannot go on with '{}' ({} x {}): "
                "teach it anew, with --unfinished keep or discard",
                route::Describe(cut_off), cut_off.camera, cut_off.image_width_px,
                cut_off.image_height_px, device.camera(), size.width, size.height);
  }
  if (first.odometry.has_value() != last.has_odometry) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} was taught {} odometry and cannot go on {} it: teach it anew, with "
                "--unfinished keep or discard",
                route::Describe(cut_off), last.has_odometry ? "with" : "without",
                last.has_odometry ? "without" : "with");
  }
  return {};
}

}  // namespace

Result<Observation> FindWhereItEnded(RobotDevice& device, Observation first,
                                     const route::RouteInfo& cut_off, const route::Segment& last,
                                     const vision::IntakeOptions& intake,
                                     const std::function<bool()>& stop) {
  if (auto alike = CheckAlike(device, first, cut_off, last, intake); !alike) {
    return tl::unexpected(alike.error());
  }
  spdlog::info(
      "looking for where segment {} of '{}' ended: what was driven after it is lost, so drive the "
      "robot over the last metres of that segment again, and on; teaching goes on from there",
      last.index.value(), cut_off.name);
  EndFinder finder(last, cut_off.image_width_px, intake);
  Observation observation = std::move(first);
  auto told_at = steady_clock::now();
  for (int frame = 0; !finder.Look(observation.image); ++frame) {
    if (stop()) {
      return Fail(ErrorCode::kUnavailable,
                  "stopped before the robot came by where {} ended: it stays as it was",
                  route::Describe(cut_off));
    }
    if (steady_clock::now() - told_at > kTellStillEvery) {
      told_at = steady_clock::now();
      spdlog::info("not there yet: at most {} of segment {}'s end seen", finder.MostSeen(),
                   last.index.value());
    }
    auto next = device.Next();
    if (!next) return tl::unexpected(next.error());
    if (!*next) {
      return Fail(ErrorCode::kInvalidArgument,
                  "this drive of {} frames did not come by where {} ended (at most {} of segment "
                  "{}'s end were seen): begin before it, on the same path; it stays as it was",
                  frame + 1, route::Describe(cut_off), finder.MostSeen(), last.index.value());
    }
    observation = std::move(**next);
  }
  spdlog::info("the robot is where segment {} ended ({} seen): teaching on", last.index.value(),
               finder.MostSeen());
  return observation;
}

}  // namespace trailcast::agent
