#include "agent/device/robot_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "agent/device/src/picture_steps.h"
#include "agent/device/src/ros2/ros2_picture.h"
#include "agent/device/src/scan_measures.h"
#include "agent/device/stamp_clock.h"
#include "services/base/angles.h"
#include "services/odometry/turn_series.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kMeasureListen{10};
constexpr milliseconds kAppear{5000};  // how long a robot may take to be discovered
constexpr milliseconds kTurn{1500};    // each way
constexpr milliseconds kSettle{500};
constexpr double kTurns_rad = 0.02;  // more than odometry's noise

double SecondsOf(steady_clock::time_point time) { return Seconds(time.time_since_epoch()); }

// Returns how many came a second.
double Rate(int count, double first_s, double last_s) {
  return count > 1 && last_s > first_s ? (count - 1) / (last_s - first_s) : 0.0;
}

// Sums how far the features have moved to the right, and down, as a share of the width.
class PictureShift {
 public:
  explicit PictureShift(const vision::IntakeOptions& intake) : steps_(intake) {}

  void Add(const image::GrayImage& frame) {
    const auto step = steps_.Add(frame);
    if (!step) return;
    right_ += step->turn_rad * steps_.focal_share();
    down_ += step->down_share;
  }
  [[nodiscard]] double right() const { return right_; }
  [[nodiscard]] double down() const { return down_; }

 private:
  PictureSteps steps_;
  double right_ = 0.0;
  double down_ = 0.0;
};

class Measuring {
 public:
  Measuring(dds::Ros2Driver& driver, const MeasureOptions& options)
      : driver_(driver),
        options_(options),
        shift_(options.intake),
        ranges_come_(options.topics.ranges.size()) {
    measures_.ranges.resize(options.topics.ranges.size());
  }

  [[nodiscard]] RobotMeasures Run();

 private:
  void Listen(milliseconds duration, const std::optional<motion::VelocityCommand>& command);
  void Note(const dds::Ros2Odometry& odometry, steady_clock::time_point now);
  void Note(const Ros2Picture& picture, steady_clock::time_point now);
  void Note(const dds::Ros2Scan& scan, steady_clock::time_point now);
  void Note(const dds::Ros2Range& range, steady_clock::time_point now);
  [[nodiscard]] TurnMeasures Turn();

  dds::Ros2Driver& driver_;
  const MeasureOptions& options_;
  RobotMeasures measures_;
  StampClock frame_clock_;
  StampClock odometry_clock_;
  SensorTime odometry_stamp_{};
  PictureShift shift_;
  Coming scans_come_;
  std::vector<Coming> ranges_come_;
  std::vector<double> came_s_;  // pictures
  image::PictureRun pictures_;
  // By stamps; odometry is also kept by arrival.
  std::vector<odometry::TimedValue> shifts_;
  std::vector<odometry::TimedValue> headings_;
  std::vector<odometry::TimedValue> headings_came_;
};

void Measuring::Note(const dds::Ros2Odometry& odometry, steady_clock::time_point now) {
  const auto taken = odometry_clock_.Follow(odometry.stamp, now);
  if (!taken) return;
  odometry_stamp_ = odometry.stamp;
  const double before = headings_.empty() ? odometry.pose.heading_rad : headings_.back().value;
  const double heading_rad = before + WrapAngle(odometry.pose.heading_rad - before);
  headings_.push_back({Seconds(*taken), heading_rad});
  headings_came_.push_back({SecondsOf(now), heading_rad});
}

void Measuring::Note(const Ros2Picture& picture, steady_clock::time_point now) {
  const auto taken = frame_clock_.Follow(StampOf(picture), now);
  if (!taken) return;
  came_s_.push_back(SecondsOf(now));
  const auto gray = Gray(picture, options_.topics.ImageTopic(), pictures_);
  if (!gray) {
    measures_.unreadable = gray.error().message;
    return;
  }
  measures_.width_px = gray->width;
  measures_.height_px = gray->height;
  measures_.picture = MeasurePicture(*gray);
  shift_.Add(*gray);
  shifts_.push_back({Seconds(*taken), shift_.right()});
}

void Measuring::Note(const dds::Ros2Scan& scan, steady_clock::time_point now) {
  scans_come_.Note(now);
  measures_.scan = MeasureScan(scan.scan, options_.obstacles);
  measures_.scan.scans = scans_come_.count();
  measures_.scan.rate_hz = scans_come_.rate_hz();
}

void Measuring::Note(const dds::Ros2Range& range, steady_clock::time_point now) {
  Coming& coming = ranges_come_[range.sensor];
  coming.Note(now);
  measures_.ranges[range.sensor] = {coming.count(), coming.rate_hz(), range.range};
}

void Measuring::Listen(milliseconds duration,
                       const std::optional<motion::VelocityCommand>& command) {
  const auto until = steady_clock::now() + duration;
  auto said_at = steady_clock::time_point{};
  while (steady_clock::now() < until && !options_.stop()) {
    if (command && steady_clock::now() - said_at > milliseconds(50)) {
      said_at = steady_clock::now();
      (void)driver_.Publish({odometry_stamp_, *command});
    }
    for (dds::Ros2Sensed& sensed : driver_.Take(kMeasureListen)) {
      const auto now = steady_clock::now();
      if (const auto* odometry = std::get_if<dds::Ros2Odometry>(&sensed)) {
        Note(*odometry, now);
      } else if (const auto* scan = std::get_if<dds::Ros2Scan>(&sensed)) {
        Note(*scan, now);
      } else if (const auto* range = std::get_if<dds::Ros2Range>(&sensed)) {
        Note(*range, now);
      } else if (std::holds_alternative<dds::Ros2Command>(sensed)) {
        continue;  // somebody else's command meanwhile
      } else if (auto* jpeg = std::get_if<dds::Ros2CompressedImage>(&sensed)) {
        Note(Ros2Picture(std::move(*jpeg)), now);
      } else {
        Note(Ros2Picture(std::get<dds::Ros2Image>(std::move(sensed))), now);
      }
    }
  }
}

// Turns to the left and back.
TurnMeasures Measuring::Turn() {
  const motion::VelocityCommand left = options_.turn_command;
  TurnMeasures turn;
  turn.told_rad = left.angular_radps * Seconds(kTurn);
  const double heading_rad = headings_.back().value;
  const double shift = shifts_.back().value;
  const double down = shift_.down();
  const double told_s = SecondsOf(steady_clock::now());
  Listen(kTurn, left);
  Listen(kSettle, motion::VelocityCommand{});
  turn.odometry_rad = headings_.back().value - heading_rad;
  turn.picture_share = shifts_.back().value - shift;
  turn.picture_down_share = shift_.down() - down;
  for (const odometry::TimedValue& each : headings_came_) {
    if (each.t_s < told_s || std::abs(each.value - heading_rad) < kTurns_rad) continue;
    turn.base_delay_s = each.t_s - told_s;
    break;
  }
  Listen(kTurn, motion::VelocityCommand{-left.linear_mps, -left.angular_radps});
  Listen(kSettle, motion::VelocityCommand{});
  if (const auto lag = odometry::LagOf(shifts_, headings_)) turn.stamps_late_s = lag->s;
  return turn;
}

RobotMeasures Measuring::Run() {
  const auto until = steady_clock::now() + kAppear;
  while (steady_clock::now() < until && !options_.stop() &&
         (came_s_.empty() || headings_.empty())) {
    Listen(kMeasureListen, std::nullopt);
  }
  (void)frame_clock_.TakeBehind();
  (void)odometry_clock_.TakeBehind();
  Listen(options_.look, std::nullopt);
  const auto frames_behind = frame_clock_.TakeBehind();
  const auto odometry_behind = odometry_clock_.TakeBehind();
  if (frames_behind && odometry_behind) {
    measures_.clocks_apart_s = Seconds(*odometry_behind - *frames_behind);
  }
  measures_.peers = driver_.peers();
  if (options_.turn && !shifts_.empty() && !headings_.empty()) measures_.turn = Turn();
  measures_.pictures = static_cast<int>(came_s_.size());
  measures_.odometry = static_cast<int>(headings_.size());
  if (!came_s_.empty()) {
    measures_.picture_rate_hz = Rate(measures_.pictures, came_s_.front(), came_s_.back());
  }
  if (!headings_.empty()) {
    measures_.odometry_rate_hz =
        Rate(measures_.odometry, headings_came_.front().t_s, headings_came_.back().t_s);
  }
  measures_.picture_stamps_stand = frame_clock_.stands();
  measures_.odometry_stamps_stand = odometry_clock_.stands();
  return measures_;
}

}  // namespace

PictureMeasures MeasurePicture(const image::GrayImage& picture) {
  constexpr int kWide = 4;
  double sum = 0.0;
  double squares = 0.0;
  double steep = 0.0;
  double wide = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int here = picture.at(x, y);
      sum += here;
      squares += here * here;
      if (x + kWide >= picture.width) continue;
      steep += std::abs(picture.at(x + 1, y) - here);
      wide += std::abs(picture.at(x + kWide, y) - here);
    }
  }
  const double pixels = std::max(1.0, static_cast<double>(picture.pixels.size()));
  const double mean = sum / pixels;
  return {mean, std::sqrt(std::max(0.0, squares / pixels - mean * mean)),
          wide > 0.0 ? std::min(1.0, steep / wide) : 0.0};
}

Result<RobotMeasures> MeasureRobot(const MeasureOptions& options) {
  auto driver = dds::Ros2Driver::Open(options.topics);
  if (!driver) return Wrap(driver.error(), "the robot's topics");
  return Measuring(**driver, options).Run();
}

}  // namespace trailcast::agent
