#include "agent/device/ros2_device.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "agent/device/src/ros2/ros2_state.h"
#include "agent/device/src/ros2/ros2_trouble.h"
#include "services/base/guarded.h"
#include "services/image/files.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// A robot in lockstep waits for its answer, so only one that is gone is silent for so long.
constexpr std::chrono::hours kLockstepTimeout{24};
// Odometry of a frame's moment may arrive a little after the frame.
constexpr milliseconds kOdometryLate{60};
// A base may no longer obey a command that is older than this.
constexpr std::chrono::seconds kCommandHolds{1};
// An older charge counts as unknown. Slow batteries report twice a minute.
constexpr std::chrono::minutes kBatteryCounts{2};
// No base that obeys our commands or a person exceeds these, except one with higher limits.
constexpr double kLeastGate_mps = 3.0;
constexpr double kLeastGate_radps = 6.0;

GateOptions GateOf(const motion::DriveLimits& limits) {
  return {std::max(kLeastGate_mps, 2.0 * limits.speed_mps),
          std::max(kLeastGate_radps, 2.0 * limits.turn_rate_radps)};
}

}  // namespace

Ros2Device::State::State(const Ros2Run& device, std::unique_ptr<dds::Ros2Driver> link)
    : run(device),
      driver(std::move(link)),
      watch(device.lockstep ? std::chrono::duration_cast<milliseconds>(kLockstepTimeout)
                            : device.sensor_timeout,
            has_odometry(), has_scan(), device.topics.ranges.size()),
      poses(GateOf(device.limits),
            device.lockstep ? SensedPoses::Clocks::kOne : SensedPoses::Clocks::kMayDiffer),
      still(device.still_at_end),
      still_by_sight(has_odometry() ? milliseconds(0) : device.still_at_end) {
  // The topics decide.
  run.obstacles.range_mounts.resize(run.topics.ranges.size());
  if (has_scan() || !run.topics.ranges.empty()) obstacles.emplace(run.obstacles, has_scan());
}

bool Ros2Device::State::ready(steady_clock::time_point now) const {
  if (!newest || trouble || (obstacles && !obstacles->has_seen_all())) return false;
  if (run.lockstep && obstacles && !obstacles->Reaches(AsTime(newest->stamp()))) return false;
  if (!has_odometry()) return true;
  if (!poses.has_odometry()) return false;
  return poses.Reaches(newest->taken) || now - unserved_since > kOdometryLate;
}

Error Ros2Device::State::Failure(const RobotWatch::Trouble& what) const {
  return {ErrorCode::kUnavailable, TroubleText(run.topics, driver->peers(), what, odometry_stands)};
}

std::optional<Error> Ros2Device::State::GiveUp(steady_clock::time_point now) {
  if (deaf) return deaf;
  // An obstacle may stay as long as it likes.
  if (trouble && trouble->part == RobotWatch::Trouble::Part::kObstacle) {
    waiting_since = now;
    return std::nullopt;
  }
  const auto stands_since = watch.base_stands_since();
  if (trouble && stands_since && now - *stands_since > run.base_patience) {
    return Error{ErrorCode::kUnavailable, fmt::format("{}, for {:g} s", Failure(*trouble).message,
                                                      Seconds(run.base_patience))};
  }
  if (stands_since && trouble && trouble->part == RobotWatch::Trouble::Part::kBase)
    return std::nullopt;
  // Without trouble, Next waits for the next frame, which takes its time.
  const auto patience =
      trouble ? run.patience : std::max(run.patience, run.sensor_timeout + kOdometryLate);
  if (now - waiting_since <= patience) return std::nullopt;
  const auto waited_s = Seconds(patience);
  if (trouble) {
    Error error = Failure(*trouble);
    error.message += fmt::format(", and not within {:g} s after", waited_s);
    return error;
  }
  if (!why_unreadable.empty()) {
    return Error{ErrorCode::kUnavailable,
                 fmt::format("no picture could be read for {:g} s: {}", waited_s, why_unreadable)};
  }
  return Error{ErrorCode::kUnavailable,
               fmt::format("the robot says nothing for {:g} s: {}", waited_s, Missing())};
}

std::string Ros2Device::State::Missing() const {
  Came came;
  came.pictures = newest.has_value();
  came.odometry = poses.has_odometry();
  if (obstacles) {
    came.scan = obstacles->has_scanned();
    came.silent_range = obstacles->silent_range();
  }
  return WhoIsMissing(run.topics, driver->peers(), came);
}

std::string Ros2Device::State::Ailment() const {
  if (deaf) return deaf->message;
  // An obstacle is no failure.
  if (trouble && trouble->part != RobotWatch::Trouble::Part::kObstacle) {
    return Failure(*trouble).message;
  }
  const bool all_came = last_stamp && (!has_odometry() || poses.has_odometry()) &&
                        (!obstacles || obstacles->has_seen_all());
  return all_came ? std::string() : Missing();
}

// Returns why the robot stands in spite of its commands.
RobotDevice::Halt Ros2Device::State::Halted() const {
  if (trouble) {
    return {Failure(*trouble).message, trouble->part != RobotWatch::Trouble::Part::kObstacle};
  }
  if (by_hand && obstacles && obstacles->waits()) return {*obstacles->waits(), false};
  return {};
}

// Reports the beginning and the end of trouble. A standing base stays reported while it is tried.
void Ros2Device::State::ShareTrouble() {
  if (!trouble && watch.base_stands_since()) return;
  const Halt now = Halted();
  if (now.what == shared.what) return;
  if (!now.what.empty() && !now.fault) {
    spdlog::info("WAITING: {}", now.what);
  } else if (!now.what.empty()) {
    spdlog::warn("the robot is stopped; {}", now.what);
  } else if (shared.fault) {
    spdlog::info("over: {}", shared.what);
  } else {
    spdlog::info("the way is free: the robot goes on");
  }
  shared = now;
  tell(now);
}

void Ros2Device::State::ShareNews() {
  constexpr std::size_t kMostKept = 100;
  for (std::string& line : poses.TakeNews()) {
    spdlog::warn("{}", line);
    if (told_news.size() < kMostKept) told_news.push_back(std::move(line));
  }
}

// A silent IMU is no failure, but whoever asked for it should know.
std::vector<motion::ImuSample> Ros2Device::State::TakeImu() {
  constexpr int kTellAfter = 60;
  if (has_imu() && frames_without_imu >= 0) {
    frames_without_imu = imu.empty() ? frames_without_imu + 1 : -1;
    if (frames_without_imu == kTellAfter) {
      spdlog::warn("nothing comes from the IMU {} ({}): neither slope nor roughness is known by it",
                   run.topics.ImuTopic(),
                   driver->peers().imus > 0 ? "somebody publishes it" : "nobody publishes it");
    }
  }
  return std::exchange(imu, {});
}

Ros2Device::Ros2Device(const Ros2Run& run, std::unique_ptr<dds::Ros2Driver> driver)
    : state_(std::make_unique<State>(run, std::move(driver))) {
  state_->hearing = std::thread([s = state_.get()] {
    auto heard = Guarded("the thread that hears the robot", [s] { s->Hear(); });
    if (heard) return;
    const std::lock_guard guard(s->lock);
    s->deaf = std::move(heard.error());
    // Nobody else stops it until the loop that drives is back, and that stops it again.
    (void)Guarded("stopping the robot", [s] { return s->Tell({}); });
    s->news.notify_one();
  });
}

Ros2Device::~Ros2Device() {
  {
    const std::lock_guard guard(state_->lock);
    state_->ending = true;
  }
  state_->hearing.join();
}

Result<std::unique_ptr<Ros2Device>> Ros2Device::Open(const Ros2Run& run) {
  if (run.topics.image_is_compressed()) {
    if (auto can = image::CanDecode(); !can) return Wrap(can.error(), run.topics.ImageTopic());
  }
  auto driver = dds::Ros2Driver::Open(run.topics);
  if (!driver) return Wrap(driver.error(), "the robot's topics");
  return std::make_unique<Ros2Device>(run, *std::move(driver));
}

// Returns the next frame, with odometry if there is any, or nothing when it is over.
Result<std::optional<Ros2Frame>> Ros2Device::State::Await(std::unique_lock<std::mutex>& guard) {
  if (run.lockstep && !answered) {
    answered = true;
    if (auto said = Tell({}); !said) return tl::unexpected(said.error());
  }
  while (deaf || !ready(run.clock())) {
    ShareTrouble();
    if (run.stop()) return std::nullopt;
    if (auto error = GiveUp(run.clock())) return tl::unexpected(*error);
    news.wait_for(guard, kListen);
  }
  ShareTrouble();
  Ros2Frame frame = *std::exchange(newest, std::nullopt);
  ShareNews();
  given_before = std::exchange(given, frame.stamp());
  given_came_at = frame.came_at;
  answered = false;
  return frame;
}

// A damaged picture is left out.
void Ros2Device::State::Leave(const Error& damage) {
  why_unreadable = damage.message;
  if (++unreadable == 1) spdlog::warn("a picture is left out: {}", damage.message);
}

Result<std::optional<Observation>> Ros2Device::Next() {
  State& s = *state_;
  std::unique_lock guard(s.lock);
  s.waiting_since = s.run.clock();
  s.why_unreadable.clear();
  while (true) {
    const auto awaited = s.Await(guard);
    if (!awaited) return tl::unexpected(awaited.error());
    if (!*awaited) return std::nullopt;
    const Ros2Frame& frame = **awaited;
    Observation observation;
    observation.stamp = frame.taken;
    if (s.obstacles) observation.stands = s.obstacles->scanned();
    if (s.has_odometry()) {
      observation.odometry = s.poses.At(frame.taken);
      observation.unknown = s.poses.TakeUnknown();
      if (s.still.Over(frame.taken, *observation.odometry)) return std::nullopt;
    }
    observation.imu = s.TakeImu();
    if (s.run.clock() - s.heard_at < kCommandHolds) observation.heard = s.heard;
    guard.unlock();
    auto gray = Gray(frame.picture, s.run.topics.ImageTopic(), s.pictures);
    for (const std::string& each : s.pictures.TakeNews()) spdlog::warn("camera: {}", each);
    const bool over = gray && s.still_by_sight.Over(frame.taken, *gray);
    guard.lock();
    if (over) return std::nullopt;
    if (gray) {
      observation.image = std::move(*gray);
      s.width_px = s.pictures.reduced() * observation.image.width;
      s.height_px = s.pictures.reduced() * observation.image.height;
      return observation;
    }
    if (gray.error().code != ErrorCode::kCorrupt) return tl::unexpected(gray.error());
    s.Leave(gray.error());
  }
}

Result<void> Ros2Device::Drive(const motion::VelocityCommand& command) {
  State& s = *state_;
  const std::lock_guard guard(s.lock);
  s.answered = true;
  // A command that follows from an old picture is not obeyed.
  const bool old = !s.run.lockstep && s.run.clock() - s.given_came_at > s.run.sensor_timeout;
  return s.Tell(s.deaf || s.trouble || old ? motion::VelocityCommand{} : s.Within(command));
}

std::string Ros2Device::camera() const {
  const State& s = *state_;
  if (s.width_px == 0) return s.run.camera;
  return fmt::format("{} {}x{}", s.run.camera, s.width_px, s.height_px);
}

std::optional<std::uint8_t> Ros2Device::battery_percent() const {
  State& s = *state_;
  const std::lock_guard guard(s.lock);
  const bool old = s.run.clock() > s.battery_heard_at + kBatteryCounts;
  return old ? std::nullopt : s.battery_percent;
}

std::vector<std::string> Ros2Device::TakeNews() {
  const std::lock_guard guard(state_->lock);
  std::vector<std::string> news = std::exchange(state_->told_news, {});
  if (const auto unusable = state_->driver->peers().unusable_odometry; unusable > 0) {
    news.push_back(fmt::format(
        "{} messages of {} so far are left out: numbers that are none, or an orientation of length "
        "0",
        unusable, state_->run.topics.OdometryTopic()));
  }
  return news;
}

void Ros2Device::ByHand(bool begins) {
  const std::lock_guard guard(state_->lock);
  state_->by_hand = begins;
}

Result<image::GrayImage> Ros2Device::Look() {
  State& s = *state_;
  std::unique_lock guard(s.lock);
  if (std::string ailment = s.Ailment(); !ailment.empty() || !s.newest) {
    if (ailment.empty()) ailment = "its next picture has not come yet";
    return Fail(ErrorCode::kUnavailable, "{}", ailment);
  }
  const Ros2Picture picture = s.newest->picture;
  guard.unlock();
  return Gray(picture, s.run.topics.ImageTopic(), s.pictures);
}

std::string Ros2Device::Ailment() {
  const std::lock_guard guard(state_->lock);
  return state_->Ailment();
}

void Ros2Device::OnTrouble(const Trouble& tell) { state_->tell = tell; }

}  // namespace trailcast::agent
