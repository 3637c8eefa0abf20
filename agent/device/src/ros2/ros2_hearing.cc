// This part of the device hears a ROS 2 robot, and stops it when in doubt.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "agent/device/src/ros2/ros2_state.h"
#include "agent/device/src/ros2/ros2_trouble.h"

namespace trailcast::agent {
namespace {

using std::chrono::steady_clock;

// A stop is repeated for so long, because a base may miss a single command.
constexpr std::chrono::seconds kSayAgain{1};
// A command older than this has reached the base or is lost.
constexpr double kLongestRamp_s = 0.1;
// A base that stood in spite of its commands is tried this gently.
constexpr double kTrySpeed_mps = 0.15;
constexpr double kTryTurn_radps = 0.3;
// The most IMU samples between two frames: a second of a fast one.
constexpr std::size_t kMostImu = 1000;

}  // namespace

void Ros2Device::State::Hear() {
  while (true) {
    auto sensed = driver->Take(kListen);
    const std::lock_guard guard(lock);
    if (ending) return;
    const auto now = run.clock();
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
  if (const auto* scan = std::get_if<dds::Ros2Scan>(&sensed)) {
    KeepScan(*scan, now);
    return;
  }
  if (const auto* range = std::get_if<dds::Ros2Range>(&sensed)) {
    KeepRange(*range, now);
    return;
  }
  if (const auto* inertia = std::get_if<dds::Ros2Imu>(&sensed)) {
    KeepImu(inertia->felt);
    return;
  }
  if (const auto* battery = std::get_if<dds::Ros2Battery>(&sensed)) {
    KeepBattery(*battery, now);
    return;
  }
  if (const auto* command = std::get_if<dds::Ros2Command>(&sensed)) {
    heard = command->velocity;
    heard_at = now;
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
    // In lockstep, the robot did not get the answer, or does not have it yet.
    if (run.lockstep && answered && given == last_stamp) (void)driver->Publish({*given, told});
    return;
  }
  const auto taken = poses.AddFrame(StampOf(picture), now);
  if (!taken) return;
  watch.SawFrame(now, changed);
  last_stamp = StampOf(picture);
  last_bytes = bytes;
  if (!newest) unserved_since = now;
  newest = Ros2Frame{now, *taken, std::move(picture)};
}

void Ros2Device::State::KeepBattery(const dds::Ros2Battery& battery, steady_clock::time_point now) {
  battery_percent = gauge.Read(battery.percentage, battery.charge_ah, battery.capacity_ah);
  battery_heard_at = now;
}

void Ros2Device::State::KeepImu(const motion::ImuSample& felt) {
  if (imu.size() < kMostImu) imu.push_back(felt);
}

void Ros2Device::State::KeepScan(const dds::Ros2Scan& scan, steady_clock::time_point now) {
  watch.SawScan(now);
  obstacles->See(run.lockstep ? AsTime(scan.stamp) : now, scan.scan);
  SlowDown();
}

void Ros2Device::State::KeepRange(const dds::Ros2Range& range, steady_clock::time_point now) {
  watch.SawRange(now, range.sensor);
  obstacles->See(run.lockstep ? AsTime(range.stamp) : now, range.sensor, range.range);
  SlowDown();
}

// Somebody may step in the way between two pictures.
void Ros2Device::State::SlowDown() {
  if (told == motion::VelocityCommand{}) return;
  const motion::VelocityCommand slower = obstacles->Want(told);
  if (!obstacles->waits() && slower != told) (void)Say(slower);
}

// This also works if the loop that drives does not come back: a command holds for sensor_timeout.
void Ros2Device::State::StopIfInDoubt(steady_clock::time_point now) {
  trouble = watch.Check(now);
  NoteRoom();
  if (const std::string topic = driver->crowded(); !topic.empty()) {
    trouble = {
        RobotWatch::Trouble::Part::kCrowd,
        fmt::format("several publish {}, and which is this robot's cannot be told: two "
                    "robots in one namespace, or a driver that was left over; end the other, "
                    "or give each robot a namespace of its own",
                    topic)};
  }
  if (!trouble && drove && driver->peers().bases == 0) {
    trouble = {RobotWatch::Trouble::Part::kBase, NobodyListens(run.topics, driver->peers())};
  }
  const bool waits = obstacles && obstacles->waits();
  if (!trouble && waits && !by_hand) {
    trouble = {RobotWatch::Trouble::Part::kObstacle, *obstacles->waits()};
  }
  if (run.lockstep && trouble && trouble->part == RobotWatch::Trouble::Part::kObstacle) {
    AnswerByStanding();
  }
  const bool stale = !run.lockstep && now - told_at > run.sensor_timeout;
  if (!trouble && !stale && !waits) return;
  if (told != motion::VelocityCommand{}) stop_said_until = now + kSayAgain;
  // A stop that could not be sent is repeated as well.
  if (now <= stop_said_until) (void)Tell({});
}

void Ros2Device::State::NoteRoom() {
  if (!trouble || trouble->part != RobotWatch::Trouble::Part::kCamera) {
    no_room.clear();
    return;
  }
  if (no_room.empty()) no_room = NoRoomText(ReadPacketPieces());
  trouble->what += no_room;
}

// The time of a robot in lockstep advances only when its frames are answered, even while it waits
// for an obstacle.
void Ros2Device::State::AnswerByStanding() {
  if (!newest) return;
  given_before = std::exchange(given, newest->stamp());
  answered = true;
  newest.reset();
  (void)Tell({});
}

Result<void> Ros2Device::State::Tell(const motion::VelocityCommand& command) {
  told_at = run.clock();
  return Say(command);
}

// Sends the command, without extending the time for which the last one holds.
Result<void> Ros2Device::State::Say(const motion::VelocityCommand& command) {
  told = command;
  drove = drove || command != motion::VelocityCommand{};
  watch.Told(command);
  return driver->Publish({CommandStamp(), command});
}

// A base in real time judges a command's age by its own clock, which is its odometry's. A robot in
// lockstep waits for the answer to its frame.
SensorTime Ros2Device::State::CommandStamp() const {
  if (!run.lockstep && poses.has_odometry()) return poses.newest_stamp();
  return given.value_or(SensorTime{});
}

// A robot that had to be stopped speeds up from standing again.
motion::VelocityCommand Ros2Device::State::Shaped(const motion::VelocityCommand& wanted) const {
  motion::DriveLimits limits = run.limits;
  if (watch.base_stands_since()) {
    limits.speed_mps = std::min(limits.speed_mps, kTrySpeed_mps);
    limits.turn_rate_radps = std::min(limits.turn_rate_radps, kTryTurn_radps);
  }
  double since_s = kLongestRamp_s;
  if (!run.lockstep) since_s = Seconds(run.clock() - told_at);
  if (run.lockstep && given_before) since_s = Seconds(*given - *given_before);
  return motion::Shape(wanted, told, std::clamp(since_s, 0.0, kLongestRamp_s), limits);
}

motion::VelocityCommand Ros2Device::State::Within(const motion::VelocityCommand& wanted) {
  const motion::VelocityCommand shaped = Shaped(wanted);
  if (!obstacles) return shaped;
  const motion::VelocityCommand allowed = obstacles->Want(shaped);
  if (obstacles->backs_unseen() && !backs_unseen) {
    spdlog::warn(
        "the robot drives backwards, where no scanner and no range sensor looks: it does not see "
        "what stands there, and goes no faster than {:g} m/s",
        ObstacleWatch::kUnseen_mps);
  }
  backs_unseen = obstacles->backs_unseen();
  if (obstacles->waits()) stop_said_until = run.clock() + kSayAgain;
  return allowed;
}

}  // namespace trailcast::agent
