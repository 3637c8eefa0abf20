#include "agent/device/bag_device.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "agent/device/recorded_clock.h"
#include "agent/device/recorded_poses.h"
#include "agent/device/src/recorded/bag_topics.h"
#include "services/bag/ros_messages.h"
#include "services/image/files.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {
namespace {

using std::chrono::nanoseconds;

// Pictures further from any odometry are left out.
constexpr std::chrono::milliseconds kOdometryNear{500};
// Stamps whose difference from the recorder's clock varies by more are of different clocks.
constexpr std::chrono::seconds kRecordersSameClock{2};

// A base may no longer obey a command that is older than this.
constexpr std::chrono::seconds kCommandHolds{1};
// No message waits so long to be recorded.
constexpr std::chrono::seconds kStampsStep{1};

struct Commanded {
  nanoseconds logged_at{};
  motion::VelocityCommand velocity;
};

// Detects steps of a topic's stamps against the recorder's clock.
class StampSteps {
 public:
  // Returns how far the stamps have just stepped, or nothing if they did not or there are none.
  [[nodiscard]] std::optional<nanoseconds> Add(const RecordedTimes& times) {
    if (times.stamp == SensorTime(0)) return std::nullopt;
    const nanoseconds ahead = times.stamp - times.logged_at;
    const auto step = ahead - std::exchange(ahead_, ahead).value_or(ahead);
    return std::chrono::abs(step) > kStampsStep ? std::optional(step) : std::nullopt;
  }

 private:
  std::optional<nanoseconds> ahead_;
};

// The distance driven until a moment.
struct Driven {
  SensorTime at{};
  double length_m = 0.0;
};

double LengthUntil(const std::vector<Driven>& driven, SensorTime then) {
  const auto after =
      std::upper_bound(driven.begin(), driven.end(), then,
                       [](SensorTime time, const Driven& each) { return time < each.at; });
  return after == driven.begin() ? 0.0 : std::prev(after)->length_m;
}

struct LeftOut {
  image::LeftOutPictures unreadable;
  int late = 0;
  int without_odometry = 0;
  double length_m = 0.0;  // of the drive between pictures that were left out

  [[nodiscard]] std::string Text() const {
    std::vector<std::string> parts;
    if (unreadable.count() > 0) {
      parts.push_back(
          fmt::format("{} that cannot be read ({})", unreadable.count(), unreadable.why()));
    }
    if (late > 0) parts.push_back(fmt::format("{} that come after later ones", late));
    if (without_odometry > 0) {
      parts.push_back(fmt::format("{} taken more than {:g} s from any odometry", without_odometry,
                                  Seconds(kOdometryNear)));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
  }
};

}  // namespace

struct BagDevice::State {
  [[nodiscard]] Result<void> ReadOdometry();
  [[nodiscard]] Result<void> ReadCommands();
  [[nodiscard]] std::optional<motion::VelocityCommand> HeardAt(nanoseconds logged_at) const;
  [[nodiscard]] Result<void> ReadPictureTimes();
  [[nodiscard]] Result<void> ChooseClock();
  [[nodiscard]] SensorTime TimeOf(const RecordedClock::Message& message) const;
  [[nodiscard]] Result<RecordedTimes> TimesOf(const bag::Message& message) const;
  [[nodiscard]] Result<image::GrayImage> Gray(const bag::Message& message);
  [[nodiscard]] Result<std::optional<Observation>> Next();
  [[nodiscard]] Result<std::optional<Observation>> Look(const bag::Message& message);
  void Tell(std::string what);
  void TellStep(const std::string& topic, const RecordedTimes& times, StampSteps& steps);
  void TellDamage();
  void NoteGap(SensorTime until);
  void TellEnd();

  std::filesystem::path name;
  std::unique_ptr<bag::Bag> bag;
  BagTopics topics;
  RecordedClock odometry;
  std::vector<motion::Pose2> raw_poses;  // of these samples
  std::vector<Driven> driven;
  std::vector<Commanded> commands;
  std::optional<RecordedPoses> poses;
  image::PictureRun run{vision::kEnoughPx};
  bool has_stamps = false;
  RecordedClock pictures_clock;
  std::vector<std::optional<std::size_t>>
      in_clock;                      // each picture's index there, if it can be read
  bool by_stamps = true;             // otherwise by recording times
  std::optional<Observation> first;  // until Next returns it
  std::optional<SensorTime> begun;   // when the first picture was taken
  std::optional<SensorTime> last;
  std::uint64_t pictures = 0;          // that were read
  std::optional<SensorTime> gap_from;  // pictures are left out since then
  LeftOut left_out;
  std::size_t damage_told = 0;
  std::optional<nanoseconds> recorded_from;  // when the first message was recorded
  StampSteps picture_steps;
  std::vector<std::string> news;
  int width_px = 0;
  int height_px = 0;
};

void BagDevice::State::Tell(std::string what) {
  spdlog::warn("{}", what);
  news.push_back(std::move(what));
}

void BagDevice::State::TellStep(const std::string& topic, const RecordedTimes& times,
                                StampSteps& steps) {
  if (!recorded_from) recorded_from = times.logged_at;
  const auto step = steps.Add(times);
  if (!step) return;
  Tell(
      fmt::format("the stamps of {} step by {:+.2f} s against the recorder's clock, {:.2f} s into "
                  "the recording",
                  topic, Seconds(*step), Seconds(times.logged_at - *recorded_from)));
}

Result<void> BagDevice::State::ReadOdometry() {
  if (!topics.odometry) return {};
  bag->Begin(*topics.odometry);
  int unfit = 0;
  std::string why;  // of the first one
  StampSteps steps;
  std::vector<RecordedTimes> times;
  while (true) {
    const auto message = bag->Next();
    if (!message) return tl::unexpected(message.error());
    if (!*message) break;
    if (const auto read = bag::ReadOdometry((*message)->bytes)) {
      times.push_back({read->stamp, (*message)->logged_at});
      raw_poses.push_back(read->pose);
      TellStep(topics.odometry->name, times.back(), steps);
    } else if (unfit++ == 0) {
      why = read.error().message;
    }
  }
  if (times.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "{}: none of {} messages of {} can be read as odometry{}; --odom-topic '' does "
                "without",
                name.string(), unfit, topics.odometry->name, why.empty() ? "" : " (" + why + ")");
  }
  if (unfit > 0) {
    Tell(fmt::format("{} of {} messages of {} are left out: {}", unfit,
                     times.size() + static_cast<std::size_t>(unfit), topics.odometry->name, why));
  }
  odometry = FollowClocks(times);
  return {};
}

// A damaged command counts as missing.
Result<void> BagDevice::State::ReadCommands() {
  if (!topics.commands) return {};
  const bool stamped = bag::PlainType(topics.commands->type) == bag::kTwistStampedType;
  bag->Begin(*topics.commands);
  while (true) {
    const auto message = bag->Next();
    if (!message) return tl::unexpected(message.error());
    if (!*message) return {};
    const auto velocity = bag::ReadTwist((*message)->bytes, stamped);
    if (velocity) commands.push_back({(*message)->logged_at, *velocity});
  }
}

std::optional<motion::VelocityCommand> BagDevice::State::HeardAt(nanoseconds logged_at) const {
  const auto after = std::upper_bound(
      commands.begin(), commands.end(), logged_at,
      [](nanoseconds time, const Commanded& command) { return time < command.logged_at; });
  if (after == commands.begin()) return std::nullopt;
  const Commanded& newest = *std::prev(after);
  if (logged_at - newest.logged_at > kCommandHolds) return std::nullopt;
  return newest.velocity;
}

Result<RecordedTimes> BagDevice::State::TimesOf(const bag::Message& message) const {
  const auto stamp =
      topics.compressed
          ? bag::ReadCompressedImage(message.bytes).map([](const auto& image) {
              return image.stamp;
            })
          : bag::ReadImage(message.bytes).map([](const auto& image) { return image.stamp; });
  if (!stamp) return tl::unexpected(stamp.error());
  return RecordedTimes{*stamp, message.logged_at};
}

// A clock's behaviour shows only in all of a topic's times.
Result<void> BagDevice::State::ReadPictureTimes() {
  bag->Begin(topics.image);
  std::vector<RecordedTimes> all;
  while (true) {
    const auto message = bag->Next();
    if (!message) return tl::unexpected(message.error());
    if (!*message) break;
    const auto times = TimesOf(**message);
    in_clock.push_back(times ? std::optional(all.size()) : std::nullopt);
    if (times) all.push_back(*times);
  }
  has_stamps = !all.empty() && all.front().stamp != SensorTime(0);
  pictures_clock = FollowClocks(all);
  return {};
}

// Stamps count if pictures have them and odometry's are of the same clock.
Result<void> BagDevice::State::ChooseClock() {
  by_stamps = has_stamps;
  const auto apart = Apart(pictures_clock, odometry);
  if (by_stamps && apart && std::chrono::abs(*apart) > kRecordersSameClock) {
    Tell(
        "stamps of pictures and odometry are of different clocks: taking the times at which they "
        "were recorded");
    by_stamps = false;
  }
  std::vector<RecordedPoses::Sample> samples;
  for (std::size_t i = 0; i < raw_poses.size(); ++i) {
    if (!odometry.messages[i].taken) continue;
    samples.push_back({TimeOf(odometry.messages[i]), raw_poses[i]});
  }
  if (auto slow = CheckSpeed(samples); !slow) return Wrap(slow.error(), topics.odometry->name);
  poses.emplace(samples);
  double length_m = 0.0;
  std::optional<motion::Pose2> before;
  for (const RecordedPoses::Sample& sample : samples) {
    const motion::Pose2 pose = poses->history().At(sample.taken);
    if (before) length_m += motion::Position(motion::Between(*before, pose)).norm();
    before = pose;
    driven.push_back({sample.taken, length_m});
  }
  return {};
}

SensorTime BagDevice::State::TimeOf(const RecordedClock::Message& message) const {
  return by_stamps ? *message.taken : message.came;
}

Result<image::GrayImage> BagDevice::State::Gray(const bag::Message& message) {
  if (topics.compressed) {
    const auto image = bag::ReadCompressedImage(message.bytes);
    if (!image) return tl::unexpected(image.error());
    return image::DecodeGray(image->bytes, topics.image.name, run);
  }
  const auto image = bag::ReadImage(message.bytes);
  if (!image) return tl::unexpected(image.error());
  return image::GrayFromRaw(image->picture, run);
}

// Returns nothing for a picture that is left out.
Result<std::optional<Observation>> BagDevice::State::Look(const bag::Message& message) {
  ++pictures;
  const auto unreadable = [&](const Error& error) -> Result<std::optional<Observation>> {
    if (error.code != ErrorCode::kCorrupt) return Wrap(error, topics.image.name);
    if (auto few = left_out.unreadable.LeaveOut(error); !few) {
      return Wrap(few.error(), topics.image.name);
    }
    return std::nullopt;
  };
  const auto times = TimesOf(message);
  if (!times) return unreadable(times.error());
  TellStep(topics.image.name, *times, picture_steps);
  const auto place = pictures <= in_clock.size() ? in_clock[pictures - 1] : std::nullopt;
  if (!place || !pictures_clock.messages[*place].taken) {
    ++left_out.late;
    return std::nullopt;
  }
  Observation observation;
  observation.stamp = TimeOf(pictures_clock.messages[*place]);
  if (topics.odometry) {
    if (poses->history().FromNearest(observation.stamp) > kOdometryNear) {
      ++left_out.without_odometry;
      return std::nullopt;
    }
    observation.odometry = poses->history().At(observation.stamp);
  }
  auto gray = Gray(message);
  if (!gray) return unreadable(gray.error());
  left_out.unreadable.Read();
  observation.image = std::move(*gray);
  observation.heard = HeardAt(times->logged_at);
  for (const std::string& each : run.TakeNews()) spdlog::warn("{}: {}", topics.image.name, each);
  if (!begun) begun = observation.stamp;
  if (topics.odometry) {
    std::vector<std::string> jumps;
    observation.unknown = poses->TakeUnknown(observation.stamp, jumps);
    for (const std::string& each : jumps) {
      spdlog::warn("{:.2f} s into the drive {}", Seconds(observation.stamp - *begun), each);
    }
  }
  if (gap_from) NoteGap(observation.stamp);
  last = observation.stamp;
  return observation;
}

Result<std::optional<Observation>> BagDevice::State::Next() {
  while (true) {
    const auto message = bag->Next();
    TellDamage();
    if (!message) return tl::unexpected(message.error());
    if (!*message) return std::nullopt;
    auto observation = Look(**message);
    if (!observation || *observation) return observation;
    if (!gap_from) gap_from = last.value_or(SensorTime::min());
  }
}

void BagDevice::State::TellDamage() {
  for (; damage_told < bag->damage().size(); ++damage_told) {
    spdlog::warn("{}", bag->damage()[damage_told]);
  }
}

void BagDevice::State::NoteGap(SensorTime until) {
  const SensorTime from = *std::exchange(gap_from, std::nullopt);
  left_out.length_m += LengthUntil(driven, until) - LengthUntil(driven, from);
}

void BagDevice::State::TellEnd() {
  if (gap_from) NoteGap(SensorTime::max());
  const LeftOut all = std::exchange(left_out, {});
  if (all.Text().empty()) return;
  Tell(fmt::format("of {} pictures are left out: {}{}", pictures, all.Text(),
                   driven.empty() ? ""
                                  : fmt::format("; nothing is seen of {:.1f} m of {:.1f} m driven",
                                                all.length_m, driven.back().length_m)));
}

BagDevice::BagDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}
BagDevice::~BagDevice() = default;

Result<std::unique_ptr<BagDevice>> BagDevice::Open(const BagRun& run) {
  auto state = std::make_unique<State>();
  state->name = run.bag;
  auto bag = bag::Bag::Open(run.bag, [](const std::string& what) { spdlog::info("{}", what); });
  if (!bag) return tl::unexpected(bag.error());
  state->bag = std::move(*bag);
  state->TellDamage();
  auto topics = ChooseTopics(state->bag->topics(), run);
  if (!topics) return Wrap(topics.error(), run.bag.string());
  state->topics = std::move(*topics);
  if (state->topics.compressed) {
    if (auto can = image::CanDecode(); !can) return Wrap(can.error(), state->topics.image.name);
  }
  if (auto read = state->ReadOdometry(); !read) return tl::unexpected(read.error());
  if (auto read = state->ReadCommands(); !read) return tl::unexpected(read.error());
  if (auto read = state->ReadPictureTimes(); !read) return tl::unexpected(read.error());
  if (auto chosen = state->ChooseClock(); !chosen) return Wrap(chosen.error(), run.bag.string());
  state->bag->Begin(state->topics.image);
  auto first = state->Next();
  if (!first) return Wrap(first.error(), run.bag.string());
  if (!*first) {
    return Fail(ErrorCode::kInvalidArgument, "{}: {} gives no picture; left out are {}",
                run.bag.string(), state->topics.image.name, state->left_out.Text());
  }
  state->width_px = state->run.reduced() * (*first)->image.width;
  state->height_px = state->run.reduced() * (*first)->image.height;
  state->first = std::move(*first);
  return std::unique_ptr<BagDevice>(new BagDevice(std::move(state)));
}

Result<std::optional<Observation>> BagDevice::Next() {
  if (state_->first) return std::exchange(state_->first, std::nullopt);
  auto next = state_->Next();
  if (next && !*next) state_->TellEnd();
  return next;
}

std::vector<std::string> BagDevice::TakeNews() { return std::exchange(state_->news, {}); }

std::string BagDevice::camera() const {
  return fmt::format("recorded {}x{}", state_->width_px, state_->height_px);
}

std::optional<double> BagDevice::drive_progress() const {
  const std::uint64_t all = state_->topics.image.messages;
  if (all == 0) return std::nullopt;
  return std::min(1.0, static_cast<double>(state_->pictures) / static_cast<double>(all));
}

std::string BagDevice::sources() const {
  const BagTopics& topics = state_->topics;
  return fmt::format(
      "pictures of {}, {}", topics.image.name,
      topics.odometry ? "odometry of " + topics.odometry->name : "no odometry: vision only");
}

}  // namespace trailcast::agent
