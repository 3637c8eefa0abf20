#include "agent/teach/scout.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <deque>
#include <set>
#include <utility>

#include "agent/camera_view/snapshots.h"
#include "agent/device/fault_subscription.h"
#include "agent/device/standstill.h"
#include "agent/session/teach_session.h"
#include "agent/teach/src/going_on.h"
#include "agent/teach/src/scout_words.h"
#include "services/base/unix_time.h"

namespace trailcast::agent {
namespace {

using exchange::AgentMode;

route::RouteInfo NewRoute(const ScoutOptions& options, const RobotDevice& device,
                          const image::GrayImage& frame) {
  route::RouteInfo info;
  info.name = options.route;
  info.scout = options.link.agent;
  info.camera = device.camera();
  const auto size = vision::WorkingSize({frame.width, frame.height}, options.intake);
  info.image_width_px = size.width;
  info.image_height_px = size.height;
  info.taught_unix_ms = NowUnixMs();
  const std::set<std::string> tags(options.tags.begin(), options.tags.end());
  info.tags.assign(tags.begin(), tags.end());
  info.place = options.place;
  info.to_review = options.review;
  return info;
}

// The control loop's counts.
struct Drive {
  int frames = 0;
  std::size_t features = 0;  // in finished segments
  double handed_m = 0.0;     // in segments that were passed on
  bool has_odometry = false;
  bool dark = false;
  bool reverse = false;                                       // it drives backwards
  double turned_rad = 0.0;                                    // on the spot, at the end
  teach::ViewWeakness weakness = teach::ViewWeakness::kNone;  // the last frame had too few features
  Result<void> driven;  // up to its end, or why it did not get there
};

// Measures the robot's speed by its odometry. From picture to picture the speed would jump.
class Pace {
 public:
  // Returns the speed, positive forwards, or 0 without odometry.
  double Measure(const Observation& now) {
    if (!now.odometry) return 0.0;
    places_.emplace_back(now.stamp, *now.odometry);
    while (places_.size() > 2 && now.stamp - places_[1].first >= kOver) places_.pop_front();
    const auto& [since, from] = places_.front();
    if (now.stamp <= since) return 0.0;
    return motion::IncrementBetween(from, *now.odometry).distance_m / Seconds(now.stamp - since);
  }

 private:
  static constexpr std::chrono::milliseconds kOver{300};
  std::deque<std::pair<SensorTime, motion::Pose2>> places_;
};

// Passes a finished segment on without waiting.
Result<void> PassOn(route::Segment segment, ScoutLink& link, Drive& drive) {
  drive.features += segment.features.size();
  drive.has_odometry = segment.has_odometry;
  drive.handed_m += segment.length_m;
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

// It is told at once, while the path can still be driven again.
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

// Takes back the results of the drive so far, which come again.
Result<void> BeginAnew(const TaughtAnew& anew, const Observation& observation, ScoutLink& link,
                       Drive& drive) {
  spdlog::warn(
      "frame {}: {}. Pictures are turned by {:g} degrees, and what was driven is taught anew from "
      "its beginning; --camera-roll {:g} has it so at once",
      drive.frames, anew.text, anew.intake.roll_deg, anew.intake.roll_deg);
  drive.features = 0;
  drive.handed_m = 0.0;
  const auto size =
      vision::WorkingSize({observation.image.width, observation.image.height}, anew.intake);
  if (link.BeginAnew(size.width, size.height)) return {};
  return Fail(ErrorCode::kUnavailable, "the store does not keep up with teaching");
}

// Only for a drive that is over.
void TellMount(const TeachSession& session, const Drive& drive) {
  if (session.turns_told() || !drive.has_odometry) return;
  spdlog::info(
      "no turn of this drive told whether the camera hangs upright: it is taken to hang as it was "
      "said to (--camera-roll)");
}

void TellReverse(const TeachStep& step, Drive& drive) {
  if (step.reverse == drive.reverse) return;
  drive.reverse = step.reverse;
  if (drive.reverse) {
    spdlog::info(
        "frame {}: the robot is driven backwards: so will those be that follow, which takes "
        "odometry and the method 'default'",
        drive.frames);
  } else {
    spdlog::info("frame {}: the robot is driven forwards again", drive.frames);
  }
}

// Returns false if the drive is over. `told` is the base's last command.
Result<bool> Steer(RobotDevice& device, Teleoperation* teleoperation,
                   motion::VelocityCommand& told) {
  if (teleoperation == nullptr) return true;
  teleoperation->Take();
  if (teleoperation->hold().cancelled || teleoperation->hold().ended) return false;
  const auto wanted = teleoperation->Wanted(std::chrono::steady_clock::now());
  if (!wanted) return true;
  const auto driven = device.Drive(*wanted);
  if (!driven) return tl::unexpected(driven.error());
  told = *wanted;
  return true;
}

// Teaches one more of the frames that are to be taught again, if there are any.
Result<void> CatchUp(TeachSession& session, ScoutLink& link, Drive& drive) {
  auto step = session.CatchUp();
  if (!step || !step->finished) return {};
  return PassOn(std::move(*step->finished), link, drive);
}

// The control loop: frame, step, hand over. It ends with the drive, a signal or an error.
Result<void> TeachLoop(RobotDevice& device, Observation first, const ScoutOptions& options,
                       Teleoperation* teleoperation, ScoutLink& link, Drive& drive) {
  const Standstill standstill(device);
  TeachOptions teach;
  teach.intake = options.intake;
  teach.recorder.first_index = link.first_index();
  if (teach.recorder.first_index != SegmentIndex(0)) teach.most_kept_bytes = 0;
  TeachSession session(teach);
  TeachingNow now;
  Pace pace;
  const FaultSubscription subscription(device, [&](const RobotDevice::Halt& halt) {
    now.stands = halt.what;
    link.Report(now);
  });
  std::optional<Observation> observation = std::move(first);
  motion::VelocityCommand told;
  Result<void> result;
  while (result && observation && !options.link.stop()) {
    auto step = session.Observe(*observation);
    if (!step) {
      result = Wrap(step.error(), fmt::format("frame {}", drive.frames));
      break;
    }
    if (step->anew) result = BeginAnew(*step->anew, *observation, link, drive);
    if (step->finished) result = PassOn(std::move(*step->finished), link, drive);
    if (result) result = CatchUp(session, link, drive);
    TellDarkness(*step, drive);
    TellWeakness(*step, drive);
    TellReverse(*step, drive);
    ++drive.frames;
    now.features = step->features;
    now.along_m = drive.handed_m + step->ahead_m;
    now.speed_mps = pace.Measure(*observation);
    now.drive_progress = device.drive_progress();
    link.Report(now);
    if (options.snapshots != nullptr && options.snapshots->wanted()) {
      options.snapshots->Show({.picture = observation->image});
    }
    if (!result) break;
    const auto goes_on = Steer(device, teleoperation, told);
    if (!goes_on) result = tl::unexpected(goes_on.error());
    if (!goes_on || !*goes_on) break;
    auto next = device.Next();
    if (!next) {
      result = tl::unexpected(next.error());
    } else {
      observation = std::move(*next);
      if (observation && teleoperation != nullptr) observation->told = told;
    }
  }
  standstill.Stop();
  while (result && !link.failed() && session.catching_up()) {
    result = CatchUp(session, link, drive);
  }
  TellMount(session, drive);
  auto last = session.Finish();
  drive.turned_rad = session.turned_rad();
  if (last && !link.failed()) {
    auto handed = PassOn(std::move(*last), link, drive);
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

// Returns the description of a teaching that continues, with this run's additions.
route::RouteInfo GoingOn(route::RouteInfo cut_off, const ScoutOptions& options) {
  std::set<std::string> tags(cut_off.tags.begin(), cut_off.tags.end());
  tags.insert(options.tags.begin(), options.tags.end());
  cut_off.tags.assign(tags.begin(), tags.end());
  if (options.place) cut_off.place = options.place;
  cut_off.to_review |= options.review;
  return cut_off;
}

// Decides what becomes of an earlier teaching that was cut off, and returns it if it continues.
Result<std::optional<route::RouteInfo>> SettleUnfinished(const ScoutOptions& options,
                                                         ScoutLink& link) {
  const auto cut_off = link.FindCutOff(options.route);
  if (!cut_off) return tl::unexpected(cut_off.error());
  if (!*cut_off && options.unfinished == Unfinished::kGoOn) {
    return Fail(ErrorCode::kNotFound,
                "there is nothing to go on with: the newest teaching of route '{}' by '{}' in {} "
                "was not cut off, or there is none; without --unfinished go-on it is taught anew",
                options.route, options.link.agent.value(), options.link.store_file);
  }
  if (!*cut_off) return std::nullopt;
  Unfinished becomes = options.unfinished;
  if (becomes == Unfinished::kAsk) becomes = AskOnTerminal(**cut_off, options.link.stop);
  if (becomes == Unfinished::kGoOn) {
    link.Spare(**cut_off);
    return GoingOn(**cut_off, options);
  }
  if (becomes == Unfinished::kDiscard) {
    if (auto discarded = link.Discard(**cut_off); !discarded) {
      return tl::unexpected(discarded.error());
    }
    return std::nullopt;
  }
  spdlog::warn(
      "{}: it is kept as it is, and the route taught anew ('--unfinished go-on' would go on with "
      "it, '--unfinished discard' drop it)",
      DescribeUnfinished(**cut_off));
  return std::nullopt;
}

// Starts the link with the route to be taught, and returns the first observation.
Result<Observation> Begin(RobotDevice& device, const ScoutOptions& options, ScoutLink& link,
                          const std::optional<route::RouteInfo>& cut_off) {
  auto first = device.Next();
  if (!first) return tl::unexpected(first.error());
  if (!*first) return Fail(ErrorCode::kInvalidArgument, "there is no frame to teach from");
  if (!cut_off) {
    if (auto started = link.Start(NewRoute(options, device, (*first)->image)); !started) {
      return tl::unexpected(started.error());
    }
    spdlog::info("teaching route '{}' with camera {}", options.route, device.camera());
    return std::move(**first);
  }
  const auto last = link.LastSegment(*cut_off);
  if (!last) return tl::unexpected(last.error());
  auto there = FindWhereItEnded(device, std::move(**first), *cut_off, *last, options.intake,
                                options.link.stop);
  if (!there) return there;
  if (auto started = link.StartFrom(*cut_off); !started) return tl::unexpected(started.error());
  return there;
}

// Drives to the drive's end, whatever that is. The error is that it did not begin.
Result<void> BeginAndDrive(RobotDevice& device, const ScoutOptions& options,
                           Teleoperation* teleoperation, ScoutLink& link, Drive& drive) {
  const auto cut_off = SettleUnfinished(options, link);
  if (!cut_off) return tl::unexpected(cut_off.error());
  if (auto opened = link.Open(); !opened) return tl::unexpected(opened.error());
  auto first = Begin(device, options, link, *cut_off);
  if (!first) return tl::unexpected(first.error());
  drive.driven = TeachLoop(device, std::move(*first), options, teleoperation, link, drive);
  return {};
}

// Marks the robot as driven by a person for its own lifetime.
class DrivenByHand {
 public:
  explicit DrivenByHand(RobotDevice& device) : device_(device) { device_.ByHand(true); }
  ~DrivenByHand() { device_.ByHand(false); }
  DrivenByHand(const DrivenByHand&) = delete;
  DrivenByHand& operator=(const DrivenByHand&) = delete;

 private:
  RobotDevice& device_;
};

void Close(ScoutLink& link, const Result<void>& judged, AgentMode mode) {
  link.Close(judged ? mode : AgentMode::kFault, judged ? "" : judged.error().message);
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
  Drive drive;
  if (auto begun = BeginAndDrive(device, options, nullptr, link, drive); !begun) {
    return tl::unexpected(begun.error());
  }
  auto outcome =
      link.Finish(drive.driven ? ScoutLink::Ending::kComplete : ScoutLink::Ending::kCutOff);
  if (!outcome) return tl::unexpected(outcome.error());
  const auto judged = Judge(drive.driven, *outcome, send, options.link.store_file);
  const bool interrupted = options.link.stop();
  Close(link, judged, interrupted ? AgentMode::kStopped : AgentMode::kArrived);
  if (!judged) return tl::unexpected(judged.error());
  TellEarlier(*outcome);
  TellTaught(*outcome, drive.has_odometry, send);
  TellNotTaught(drive.turned_rad);
  return Summarize(*outcome, drive);
}

Result<Taught> TeachByHand(RobotDevice& device, const ScoutOptions& options,
                           Teleoperation& teleoperation, std::unique_ptr<store::RouteStore> store,
                           std::unique_ptr<exchange::RouteExchange> exchange) {
  const Standstill standstill(device);
  const DrivenByHand by_hand(device);
  ScoutLink link(options.link, std::move(store), std::move(exchange));
  Drive drive;
  if (auto begun = BeginAndDrive(device, options, &teleoperation, link, drive); !begun) {
    return tl::unexpected(begun.error());
  }
  using End = Taught::End;
  using Ending = ScoutLink::Ending;
  const End end = teleoperation.hold().cancelled ? End::kDiscarded
                  : options.link.stop()          ? End::kInterrupted
                                                 : End::kComplete;
  auto outcome = link.Finish(!drive.driven              ? Ending::kCutOff
                             : end == End::kDiscarded   ? Ending::kDiscard
                             : end == End::kInterrupted ? Ending::kCutOff
                                                        : Ending::kComplete);
  if (!outcome) return tl::unexpected(outcome.error());
  if (drive.driven && end == End::kDiscarded) {
    Close(link, {}, AgentMode::kStopped);
    return Taught{end, outcome->delivered,
                  "what was taught is discarded: no robot follows it, and a server lists what it "
                  "has of it as cut off"};
  }
  const auto judged = Judge(drive.driven, *outcome, /*sent=*/false, options.link.store_file);
  Close(link, judged, end == End::kComplete ? AgentMode::kArrived : AgentMode::kStopped);
  if (!judged) return tl::unexpected(judged.error());
  TellEarlier(*outcome);
  TellTaught(*outcome, drive.has_odometry, /*sent=*/true);
  TellNotTaught(drive.turned_rad);
  return Taught{end, outcome->delivered, TaughtText(*outcome, end == End::kInterrupted)};
}

Result<Summary> DeliverBacklog(const ScoutLinkOptions& options,
                               std::unique_ptr<store::RouteStore> store,
                               std::unique_ptr<exchange::RouteExchange> exchange) {
  ScoutLink link(options, std::move(store), std::move(exchange));
  if (auto opened = link.Open(); !opened) return tl::unexpected(opened.error());
  if (auto started = link.Start(std::nullopt); !started) return tl::unexpected(started.error());
  auto outcome = link.Finish();
  if (!outcome) return tl::unexpected(outcome.error());
  link.Close(outcome->delivered ? AgentMode::kArrived : AgentMode::kFault, "");
  if (!outcome->delivered) {
    return tl::unexpected(NotReceipted(*outcome, options.store_file));
  }
  TellEarlier(*outcome);
  Summary summary;
  summary.Add("unreceipted", "0");
  return summary;
}

}  // namespace trailcast::agent
