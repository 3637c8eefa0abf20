#include "agent/device/drive_look.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/device/src/picture_steps.h"
#include "services/view/view_table.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {
namespace {

constexpr int kLookEvery = 5;  // frames
constexpr std::size_t kFewestOfFirst = 20;
constexpr int kGoneAgreed = 5;  // any two views of one building share this many
// Other places in one hall, which look much alike, shared up to 15.
constexpr int kBackAgreed = 30;
constexpr double kBackScale = 0.08;  // in its logarithm, so close to the place
constexpr double kBackShift = 0.4;   // half widths

// Says whether the robot comes back to its first place with the same heading.
class FirstView {
 public:
  void Look(const PictureSteps& pictures, double t_s) {
    const image::GrayImage& picture = pictures.picture();
    const auto seen = view::Tabulate(describer_.Describe(picture), picture.width);
    if (!first_) {
      first_ = seen;
      return;
    }
    if (first_->size() < kFewestOfFirst) return;
    const view::Comparison both = view::Compare(*first_, seen);
    gone_ = gone_ || both.agreed() <= kGoneAgreed;
    if (!gone_ || both.agreed() < std::max(kBackAgreed, best_) ||
        std::abs(std::log(both.scale)) > kBackScale || std::abs(both.shift_u) > kBackShift) {
      return;
    }
    if (came_back_ && t_s - came_back_->t_s > kOneComing_s) return;
    best_ = both.agreed();
    came_back_ = odometry::CameBack{t_s, std::atan(0.5 * both.shift_u / pictures.focal_share())};
  }
  [[nodiscard]] const std::optional<odometry::CameBack>& came_back() const { return came_back_; }

 private:
  static constexpr double kOneComing_s = 3.0;  // a later match is another round

  vision::ViewDescriber describer_;
  std::optional<view::ViewTable> first_;
  bool gone_ = false;
  int best_ = 0;
  std::optional<odometry::CameBack> came_back_;
};

}  // namespace

Result<DriveLook> LookAtDrive(RobotDevice& device, const DriveLookOptions& options) {
  DriveLook look;
  PictureSteps pictures(options.intake, options.focal_share);
  FirstView first;
  std::optional<motion::Pose2> pose;
  std::optional<double> last_s;
  while (true) {
    const auto next = device.Next();
    if (!next) return tl::unexpected(next.error());
    if (!*next) break;
    const Observation& observation = **next;
    const double t_s = Seconds(observation.stamp);
    odometry::DriveStep step;
    step.t_s = t_s;
    step.picture = pictures.Add(observation.image);
    if (look.pictures++ % kLookEvery == 0) first.Look(pictures, t_s);
    look.has_odometry = look.has_odometry || observation.odometry;
    if (pose && observation.odometry) {
      step.moved = motion::IncrementBetween(*pose, *observation.odometry);
    }
    step.odometry_broke =
        observation.unknown.distance_m > 0.0 || observation.unknown.heading_change_rad > 0.0;
    step.told = observation.heard;
    pose = observation.odometry;
    if (last_s) {
      step.dt_s = t_s - *last_s;
      look.steps.push_back(step);
    } else {
      look.begins_s = t_s;
    }
    last_s = t_s;
    if (options.enough(t_s - look.begins_s)) break;
  }
  look.came_back = first.came_back();
  look.news = device.TakeNews();
  return look;
}

}  // namespace trailcast::agent
