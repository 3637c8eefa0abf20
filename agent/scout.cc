#include "agent/scout.h"

#include <spdlog/spdlog.h>

#include <set>
#include <utility>

#include "agent/device/standstill.h"
#include "agent/session/teach_session.h"
#include "services/base/unix_time.h"
#include "services/route/labels.h"

namespace trailcast::agent {
namespace {

route::RouteInfo NewRoute(const ScoutOptions& options, const RobotDevice& device,
                          const image::GrayImage& frame) {
  route::RouteInfo info;
  info.name = options.route;
  info.scout = options.link.agent;
  info.camera = device.camera();
  info.image_width_px = frame.width;
  info.image_height_px = frame.height;
  info.taught_unix_ms = NowUnixMs();
  const std::set<std::string> tags(options.tags.begin(), options.tags.end());
  info.tags.assign(tags.begin(), tags.end());
  info.place = options.place;
  return info;
}

// Shorter than any that somebody meant to teach.
constexpr double kLeastRoute_m = 0.2;
// Two to five thousand are usual.
constexpr double kManyBytes_per_m = 10'000.0;

// What the control loop counts.
struct Drive {
  int frames = 0;
  std::size_t features = 0;  // in finished segments
  bool has_odometry = false;
  bool dark = false;
  teach::ViewWeakness weakness = teach::ViewWeakness::kNone;  // the last frame had too few features
};

// Hands a finished segment over; never waits for it.
Result<void> HandOver(route::Segment segment, ScoutLink& link, Drive& drive, TeachingNow& now) {
  drive.features += segment.features.size();
  drive.has_odometry = segment.has_odometry;
  now.speed_mps = segment.speed_mps();
  if (link.Offer(std::move(segment))) return {};
  return Fail(ErrorCode::kUnavailable, "the store does not keep up with teaching");
}

void TellDarkness(const TeachStep& step, Drive& drive) {
  if (step.too_few_features && !drive.dark) {
    spdlog::warn("frame {}: too few features to teach from (dark, blank or out of focus?)",
                 drive.frames);
  }
  drive.dark = step.too_few_features;
}

// At once, while the path can still be driven again.
void TellWeakness(const TeachStep& step, Drive& drive) {
  if (step.weakness == drive.weakness) return;
  drive.weakness = step.weakness;
  switch (step.weakness) {
    case teach::ViewWeakness::kNone:
      break;
    case teach::ViewWeakness::kBland:
      spdlog::warn(
          "frame {}: followers will not recognise this place: too little to hold on to (dark, "
          "blank "
          "or out of focus?)",
          drive.frames);
      break;
    case teach::ViewWeakness::kUnrelated:
      spdlog::warn(
          "frame {}: next to nothing of the last picture is in this one (too fast for the frame "
          "rate, or blurred?): drive slower here",
          drive.frames);
      break;
  }
}

// The control loop: frame, step, hand over. Ends with the drive, a signal or an error.
Result<void> TeachLoop(RobotDevice& device, Observation first, const ScoutOptions& options,
                       ScoutLink& link, Drive& drive) {
  const Standstill standstill(device);
  TeachSession session;
  TeachingNow now;
  std::optional<Observation> observation = std::move(first);
  Result<void> result;
  while (result && observation && !options.link.stop()) {
    auto step = session.Observe(*observation);
    if (!step) {
      result = Wrap(step.error(), fmt::format("frame {}", drive.frames));
      break;
    }
    if (step->finished) result = HandOver(std::move(*step->finished), link, drive, now);
    TellDarkness(*step, drive);
    TellWeakness(*step, drive);
    ++drive.frames;
    now.features = step->features;
    now.drive_progress = device.drive_progress();
    link.Report(now);
    if (!result) break;
    auto next = device.Next();
    if (!next) {
      result = tl::unexpected(next.error());
    } else {
      observation = std::move(*next);
    }
  }
  standstill.Stop();
  auto last = session.Finish();
  if (last && !link.failed()) {
    auto handed = HandOver(std::move(*last), link, drive, now);
    if (result) result = handed;
  }
  return result;
}

Summary Summarize(const ScoutLink::Outcome& outcome, const Drive& drive) {
  const route::RouteInfo& route = *outcome.route;
  Summary summary;
  summary.AddRoute(route);
  summary.Add("bytes_per_m", route.length_m > 0.0
                                 ? fmt::format("{:.0f}", route.bytes / route.length_m)
                                 : "unknown");
  summary.Add("features", std::to_string(drive.features));
  summary.Add("frames", std::to_string(drive.frames));
  summary.Add("unreceipted", std::to_string(outcome.unreceipted));
  return summary;
}

// Which revision robots follow from now on.
void TellStanding(const ScoutLink::Outcome& outcome) {
  if (!outcome.standing) return;
  const route::RouteInfo& route = *outcome.route;
  if (*outcome.standing == route::Standing::kActive) {
    spdlog::info("robots follow {} from now on", route::Describe(route));
  } else if (*outcome.standing == route::Standing::kStaged) {
    spdlog::info(
        "{} is staged: robots go on with the active one until 'trailcast routes activate {} "
        "--revision {}'",
        route::Describe(route), route.name, route.revision.value());
  }
}

Error NotReceipted(const ScoutLink::Outcome& outcome, const std::string& store_file) {
  return {ErrorCode::kUnavailable,
          fmt::format("{} segments not receipted, kept in {}: send them with 'trailcast-agent "
                      "deliver --store {}' when {}{}",
                      outcome.unreceipted, store_file, store_file,
                      outcome.refusal ? "that is mended: " : "a server is there",
                      outcome.refusal.value_or(""))};
}

// What is wrong with a route that was taught, if anything.
Result<void> Judge(const Result<void>& driven, const ScoutLink::Outcome& outcome, bool sent,
                   const ScoutOptions& options) {
  if (!driven && outcome.route) {
    return Fail(driven.error().code,
                "{} (the {} segments taught before are kept in {}, cut off: no robot follows them "
                "unless an operator activates them)",
                driven.error().message, outcome.route->segment_count, options.link.store_file);
  }
  if (!driven) return driven;
  if (!outcome.route) {
    return Fail(ErrorCode::kInvalidArgument,
                "nothing was taught: no segment had enough features or was long enough");
  }
  if (outcome.standing == route::Standing::kDeleted) {
    return Fail(ErrorCode::kConflict,
                "{} was deleted by an operator while it was taught: no robot follows it; this "
                "agent's copy stays in {}",
                route::Describe(*outcome.route), options.link.store_file);
  }
  if (sent && !outcome.delivered) {
    return tl::unexpected(NotReceipted(outcome, options.link.store_file));
  }
  return {};
}

}  // namespace

Result<Summary> Teach(RobotDevice& device, const ScoutOptions& options,
                      std::unique_ptr<store::RouteStore> store,
                      std::unique_ptr<exchange::RouteExchange> exchange) {
  const Standstill standstill(device);
  const bool send = exchange != nullptr;
  if (!send) {
    spdlog::info("no --server: the route is kept in {} only", options.link.store_file);
  }
  ScoutLink link(options.link, std::move(store), std::move(exchange));
  if (auto opened = link.Open(); !opened) return tl::unexpected(opened.error());
  auto first = device.Next();
  if (!first) return tl::unexpected(first.error());
  if (!*first) return Fail(ErrorCode::kInvalidArgument, "there is no frame to teach from");
  if (auto started = link.Start(NewRoute(options, device, (*first)->image)); !started) {
    return tl::unexpected(started.error());
  }
  spdlog::info("teaching route '{}' with camera {}", options.route, device.camera());
  Drive drive;
  const auto driven = TeachLoop(device, std::move(**first), options, link, drive);
  auto outcome = link.Finish(/*cut_off=*/!driven);
  if (!outcome) return tl::unexpected(outcome.error());
  const auto judged = Judge(driven, *outcome, send, options);
  using exchange::AgentMode;
  const bool interrupted = options.link.stop();
  link.Close(!judged       ? AgentMode::kFault
             : interrupted ? AgentMode::kStopped
                           : AgentMode::kArrived,
             judged ? "" : judged.error().message);
  if (!judged) return tl::unexpected(judged.error());
  if (drive.has_odometry && outcome->route->length_m < kLeastRoute_m) {
    spdlog::warn(
        "the route is {:.2f} m long: was the robot driven? ('trailcast robot' drives itself with "
        "--scout)",
        outcome->route->length_m);
  } else if (drive.has_odometry &&
             outcome->route->bytes > kManyBytes_per_m * outcome->route->length_m) {
    spdlog::warn(
        "the route takes {:.0f} kB a metre, where 2 to 5 are usual: features are soon lost, so "
        "followers will find few; is what the camera sees bland, blurred, or odometry in other "
        "units than metres?",
        1e-3 * outcome->route->bytes / outcome->route->length_m);
  }
  TellStanding(*outcome);
  return Summarize(*outcome, drive);
}

Result<Summary> DeliverBacklog(const ScoutLinkOptions& options,
                               std::unique_ptr<store::RouteStore> store,
                               std::unique_ptr<exchange::RouteExchange> exchange) {
  ScoutLink link(options, std::move(store), std::move(exchange));
  if (auto opened = link.Open(); !opened) return tl::unexpected(opened.error());
  if (auto started = link.Start(std::nullopt); !started) return tl::unexpected(started.error());
  auto outcome = link.Finish();
  if (!outcome) return tl::unexpected(outcome.error());
  using exchange::AgentMode;
  link.Close(outcome->delivered ? AgentMode::kArrived : AgentMode::kFault, "");
  if (!outcome->delivered) {
    return tl::unexpected(NotReceipted(*outcome, options.store_file));
  }
  Summary summary;
  summary.Add("unreceipted", "0");
  return summary;
}

}  // namespace trailcast::agent
