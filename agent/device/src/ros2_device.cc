#include "agent/device/ros2_device.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "agent/device/src/robot_watch.h"
#include "agent/device/src/ros2_picture.h"
#include "agent/device/src/ros2_trouble.h"
#include "agent/device/src/sensed_poses.h"
#include "agent/device/src/still_watch.h"
#include "services/image/files.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kListen{20};
// A robot in lockstep stands until it is answered: only one that is gone is silent for so long.
constexpr std::chrono::hours kLockstepTimeout{24};
// Odometry of a frame's own moment may arrive a little after the frame.
constexpr milliseconds kOdometryLate{60};
// That the robot shall stand is said so long: a base may miss what is said once.
constexpr std::chrono::seconds kSayAgain{1};
// A command that was given longer ago than a base needs to reach it is no more on its way.
constexpr double kLongestRamp_s = 0.1;
// So gently a base is tried that stood against its commands.
constexpr double kTrySpeed_mps = 0.15;
constexpr double kTryTurn_radps = 0.3;
// No base that is driven by our commands or by a person does more; those told to be faster do.
constexpr double kLeastGate_mps = 3.0;
constexpr double kLeastGate_radps = 6.0;

struct Frame {
  [[nodiscard]] SensorTime stamp() const { return StampOf(picture); }

  steady_clock::time_point came_at;
  SensorTime taken{};
  Ros2Picture picture;
};

GateOptions GateOf(const motion::DriveLimits& limits) {
  return {std::max(kLeastGate_mps, 2.0 * limits.speed_mps),
          std::max(kLeastGate_radps, 2.0 * limits.turn_rate_radps)};
}

}  // namespace

struct Ros2Device::State {
  State(const Ros2Run& device, std::unique_ptr<dds::Ros2Driver> link)
      : run(device),
        driver(std::move(link)),
        watch(device.lockstep ? std::chrono::duration_cast<milliseconds>(kLockstepTimeout)
                              : device.sensor_timeout,
              has_odometry()),
        poses(GateOf(device.limits),
              device.lockstep ? SensedPoses::Clocks::kOne : SensedPoses::Clocks::kMayDiffer),
        still(device.still_at_end) {}

  [[nodiscard]] bool has_odometry() const { return !run.topics.odometry.empty(); }

  // The hearing thread's.
  void Hear();
  void Keep(dds::Ros2Sensed sensed, steady_clock::time_point now);
  void KeepFrame(Ros2Picture picture, steady_clock::time_point now);
  void StopIfInDoubt(steady_clock::time_point now);

  // Any thread, with the lock.
  Result<void> Tell(const motion::VelocityCommand& command);
  [[nodiscard]] SensorTime CommandStamp() const;
  [[nodiscard]] motion::VelocityCommand Within(const motion::VelocityCommand& wanted) const;

  // The driving thread's, with the lock.
  [[nodiscard]] bool ready(steady_clock::time_point now) const;
  [[nodiscard]] std::optional<Error> GiveUp(steady_clock::time_point now) const;
  [[nodiscard]] Error Failure(const RobotWatch::Trouble& trouble) const;
  Result<std::optional<Frame>> Await(std::unique_lock<std::mutex>& guard);
  void Leave(const Error& damage);
  void ShareTrouble();
  void ShareNews();

  Ros2Run run;
  std::unique_ptr<dds::Ros2Driver> driver;
  Trouble tell = [](const std::string&) {};

  std::mutex lock;  // of all below
  std::condition_variable news;
  bool ending = false;
  RobotWatch watch;
  SensedPoses poses;
  bool odometry_stands = false;  // it comes, with stamps that do not advance
  std::optional<Frame> newest;
  steady_clock::time_point unserved_since;  // since when there has been a newest frame
  std::optional<SensorTime> last_stamp;     // of the frame before, handed out or not
  std::vector<std::uint8_t> last_bytes;     // of the frame before
  std::optional<SensorTime> given;          // the last frame that Next took, by its stamp
  std::optional<SensorTime> given_before;
  steady_clock::time_point given_came_at;
  bool answered = true;  // with a command
  int unreadable = 0;    // pictures that were left out
  std::string why_unreadable;
  motion::VelocityCommand told;  // what the base does
  bool drove = false;            // it was told to move before
  steady_clock::time_point told_at;
  steady_clock::time_point stop_said_until;
  std::optional<RobotWatch::Trouble> trouble;
  steady_clock::time_point waiting_since;  // for a frame
  std::string shared_trouble;
  StillWatch still;
  int width_px = 0;
  int height_px = 0;

  std::thread hearing;
};

void Ros2Device::State::Hear() {
  while (true) {
    auto sensed = driver->Take(kListen);
    const std::lock_guard guard(lock);
    if (ending) return;
    const auto now = steady_clock::now();
    for (dds::Ros2Sensed& one : sensed) Keep(std::move(one), now);
    StopIfInDoubt(now);
    news.notify_one();
  }
}

void Ros2Device::State::Keep(dds::Ros2Sensed sensed, steady_clock::time_point now) {
  if (const auto* odometry = std::get_if<dds::Ros2Odometry>(&sensed)) {
    odometry_stands = !poses.AddOdometry(odometry->stamp, odometry->pose, now, told);
    if (!odometry_stands) watch.SawOdometry(now, poses.newest(), poses.newest_pose());
    return;
  }
  if (auto* jpeg = std::get_if<dds::Ros2CompressedImage>(&sensed)) {
    KeepFrame(std::move(*jpeg), now);
  } else {
    KeepFrame(std::get<dds::Ros2Image>(std::move(sensed)), now);
  }
}

void Ros2Device::State::KeepFrame(Ros2Picture picture, steady_clock::time_point now) {
  const std::vector<std::uint8_t>& bytes = BytesOf(picture);
  const bool changed = bytes != last_bytes;
  if (last_stamp == StampOf(picture) && (run.lockstep || !changed)) {
    // In lockstep: the robot did not get the answer, or does not yet have it.
    if (run.lockstep && answered && given == last_stamp) (void)driver->Publish({*given, told});
    return;
  }
  const auto taken = poses.AddFrame(StampOf(picture), now);
  if (!taken) return;
  watch.SawFrame(now, changed);
  last_stamp = StampOf(picture);
  last_bytes = bytes;
  if (!newest) unserved_since = now;
  newest = Frame{now, *taken, std::move(picture)};
}

// Also when the loop that drives does not come back: a command is good for sensor_timeout.
void Ros2Device::State::StopIfInDoubt(steady_clock::time_point now) {
  trouble = watch.Check(now);
  if (!trouble && drove && driver->peers().bases == 0) {
    trouble = {RobotWatch::Trouble::Part::kBase, NobodyListens(run.topics, driver->peers())};
  }
  const bool stale = !run.lockstep && now - told_at > run.sensor_timeout;
  if (!trouble && !stale) return;
  if (told != motion::VelocityCommand{}) stop_said_until = now + kSayAgain;
  // What cannot be handed over is said again, too.
  if (now <= stop_said_until) (void)Tell({});
}

Result<void> Ros2Device::State::Tell(const motion::VelocityCommand& command) {
  told = command;
  told_at = steady_clock::now();
  drove = drove || command != motion::VelocityCommand{};
  watch.Told(command);
  return driver->Publish({CommandStamp(), command});
}

// A base in real time brakes at what is old by its own clock, which is its odometry's; a robot in
// lockstep waits for the answer to its frame.
SensorTime Ros2Device::State::CommandStamp() const {
  if (!run.lockstep && poses.has_odometry()) return poses.newest_stamp();
  return given.value_or(SensorTime{});
}

// Whoever had to be stopped speeds up again from standing.
motion::VelocityCommand Ros2Device::State::Within(const motion::VelocityCommand& wanted) const {
  motion::DriveLimits limits = run.limits;
  if (watch.base_stands_since()) {
    limits.speed_mps = std::min(limits.speed_mps, kTrySpeed_mps);
    limits.turn_rate_radps = std::min(limits.turn_rate_radps, kTryTurn_radps);
  }
  double since_s = kLongestRamp_s;
  if (!run.lockstep) since_s = Seconds(steady_clock::now() - told_at);
  if (run.lockstep && given_before) since_s = Seconds(*given - *given_before);
  return motion::Shape(wanted, told, std::clamp(since_s, 0.0, kLongestRamp_s), limits);
}

bool Ros2Device::State::ready(steady_clock::time_point now) const {
  if (!newest || trouble) return false;
  if (!has_odometry()) return true;
  if (!poses.has_odometry()) return false;
  return poses.Reaches(newest->taken) || now - unserved_since > kOdometryLate;
}

Error Ros2Device::State::Failure(const RobotWatch::Trouble& what) const {
  return {ErrorCode::kUnavailable, TroubleText(run.topics, what, odometry_stands)};
}

std::optional<Error> Ros2Device::State::GiveUp(steady_clock::time_point now) const {
  const auto stands_since = watch.base_stands_since();
  if (trouble && stands_since && now - *stands_since > run.base_patience) {
    return Error{ErrorCode::kUnavailable, fmt::format("{}, for {:g} s", Failure(*trouble).message,
                                                      Seconds(run.base_patience))};
  }
  if (stands_since && trouble && trouble->part == RobotWatch::Trouble::Part::kBase)
    return std::nullopt;
  // Without trouble it is the next frame that is waited for, which takes its time.
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
               fmt::format("the robot says nothing for {:g} s: {}", waited_s,
                           WhoIsMissing(run.topics, driver->peers(), newest.has_value()))};
}

// Tells who asked for it when trouble begins and ends: that a base stands, while it is tried, too.
void Ros2Device::State::ShareTrouble() {
  if (!trouble && watch.base_stands_since()) return;
  const std::string now = trouble ? Failure(*trouble).message : std::string();
  if (now == shared_trouble) return;
  if (now.empty()) {
    spdlog::info("over: {}", shared_trouble);
  } else {
    spdlog::warn("the robot is stopped; {}", now);
  }
  shared_trouble = now;
  tell(now);
}

void Ros2Device::State::ShareNews() {
  for (const std::string& line : poses.TakeNews()) spdlog::warn("{}", line);
}

Ros2Device::Ros2Device(std::unique_ptr<State> state) : state_(std::move(state)) {
  state_->hearing = std::thread([s = state_.get()] { s->Hear(); });
}

Ros2Device::~Ros2Device() {
  {
    const std::lock_guard guard(state_->lock);
    state_->ending = true;
  }
  state_->hearing.join();
}

Result<std::unique_ptr<Ros2Device>> Ros2Device::Open(const Ros2Run& run) {
  if (run.still_at_end > milliseconds(0) && run.topics.odometry.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "that a robot stands is known by its odometry, of which there is none");
  }
  if (run.topics.image_is_compressed()) {
    if (auto can = image::CanDecode(); !can) return Wrap(can.error(), run.topics.ImageTopic());
  }
  auto driver = dds::Ros2Driver::Open(run.topics);
  if (!driver) return Wrap(driver.error(), "the robot's topics");
  return std::unique_ptr<Ros2Device>(
      new Ros2Device(std::make_unique<State>(run, std::move(*driver))));
}

// The next frame, with odometry if there is any; nothing when it is over.
Result<std::optional<Frame>> Ros2Device::State::Await(std::unique_lock<std::mutex>& guard) {
  if (run.lockstep && !answered) {
    answered = true;
    if (auto said = Tell({}); !said) return tl::unexpected(said.error());
  }
  while (!ready(steady_clock::now())) {
    ShareTrouble();
    if (run.stop()) return std::nullopt;
    if (auto error = GiveUp(steady_clock::now())) return tl::unexpected(*error);
    news.wait_for(guard, kListen);
  }
  ShareTrouble();
  Frame frame = *std::exchange(newest, std::nullopt);
  ShareNews();
  given_before = std::exchange(given, frame.stamp());
  given_came_at = frame.came_at;
  answered = false;
  return frame;
}

// A damaged picture is one less.
void Ros2Device::State::Leave(const Error& damage) {
  why_unreadable = damage.message;
  if (++unreadable == 1) spdlog::warn("a picture is left out: {}", damage.message);
}

Result<std::optional<Observation>> Ros2Device::Next() {
  State& s = *state_;
  std::unique_lock guard(s.lock);
  s.waiting_since = steady_clock::now();
  s.why_unreadable.clear();
  while (true) {
    const auto awaited = s.Await(guard);
    if (!awaited) return tl::unexpected(awaited.error());
    if (!*awaited) return std::nullopt;
    const Frame& frame = **awaited;
    Observation observation;
    observation.stamp = frame.taken;
    if (s.has_odometry()) {
      observation.odometry = s.poses.At(frame.taken);
      observation.unknown = s.poses.TakeUnknown();
      if (s.still.Over(frame.taken, *observation.odometry)) return std::nullopt;
    }
    guard.unlock();
    auto gray = Gray(frame.picture, s.run.topics.ImageTopic());
    guard.lock();
    if (gray) {
      observation.image = std::move(*gray);
      s.width_px = observation.image.width;
      s.height_px = observation.image.height;
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
  // What an old picture led to is no more to be done.
  const bool old = !s.run.lockstep && steady_clock::now() - s.given_came_at > s.run.sensor_timeout;
  return s.Tell(s.trouble || old ? motion::VelocityCommand{} : s.Within(command));
}

std::string Ros2Device::camera() const {
  const State& s = *state_;
  if (s.width_px == 0) return s.run.camera;
  return fmt::format("{} {}x{}", s.run.camera, s.width_px, s.height_px);
}

void Ros2Device::OnTrouble(const Trouble& tell) { state_->tell = tell; }

}  // namespace trailcast::agent
