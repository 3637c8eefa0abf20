#pragma once

#include <optional>
#include <vector>

#include "agent/session/frame_check.h"
#include "agent/session/observation.h"
#include "agent/session/src/mount_watch.h"
#include "agent/session/src/told_motion.h"
#include "services/base/result.h"
#include "services/base/time.h"
#include "services/image/image.h"
#include "services/motion/motion.h"
#include "services/route/tracked_feature.h"
#include "services/view/view_table.h"
#include "services/vision/feature_tracker.h"
#include "services/vision/picture_intake.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {

// What one frame shows.
struct Seen {
  const image::GrayImage* frame = nullptr;  // as the intake makes it; until the next
  // The same as its features are followed in it; the frame itself, or reduced.
  const image::GrayImage* followed_in = nullptr;
  std::vector<route::TrackedFeature> features;  // those that are followed, where they are now there
  // How far most moved, as a share of the width; 1 where they are too few to tell.
  double flow = 0.0;
  double usual_flow = 0.0;  // the same, lately, as far as it could be told
  bool frozen = false;      // odometry tells that it stands, and what it sees moves all the while
  // Since the last frame, by odometry, and by what the base was told; nothing: there is none.
  std::optional<motion::OdometryIncrement> measured;
  std::optional<motion::OdometryIncrement> told;
  // The better one of these,
  std::optional<motion::OdometryIncrement> driven;
  motion::OdometryIncrement unknown{};                   // and besides, as in Observation
  const std::vector<Eigen::Vector2d>* stands = nullptr;  // as in Observation; until the next
  double dt_s = 0.0;                                     // the same
  double looked_s = 0.0;  // the same, and no longer than kLongestFrame_s
};

// What features are followed for.
enum class FollowedFor {
  kPlace,  // they are a segment's, and tell where the robot is
  kFlow,   // any, in a reduced picture: they tell whether it moves
};

// A picture's first station: checked, taken in, its features tracked.
class Eyes {
 public:
  // `by_commands`: what the base is told counts as motion.
  Eyes(const vision::IntakeOptions& intake, bool by_commands)
      : options_(intake), intake_(intake), by_commands_(by_commands) {}

  // From the next frame on pictures are taken in so; what was tracked is lost.
  void Turn(const vision::IntakeOptions& intake);

  // All but the features and what they tell, which come by Track, of each frame. Errors: those of
  // FrameCheck.
  [[nodiscard]] Result<Seen> See(const Observation& observation);
  void Track(Seen& seen, FollowedFor what);
  // Goes on with features of a view of the last frame, strong ones that are spread over it.
  void FollowSomeOf(const view::ViewTable& view);

  // The same frame without a look; valid as Seen::frame.
  [[nodiscard]] const image::GrayImage* Pass(const Observation& observation);

  [[nodiscard]] vision::FeatureTracker& tracker() { return tracker_; }
  [[nodiscard]] const vision::FeatureTracker& tracker() const { return tracker_; }
  // How pictures are taken in, and whether the robot's turns agree with that.
  [[nodiscard]] const vision::IntakeOptions& intake() const { return options_; }
  [[nodiscard]] const MountWatch& mount() const { return mount_; }
  [[nodiscard]] bool has_odometry() const { return last_odometry_.has_value(); }
  // The base does what it is told: whatever is believed moves a robot.
  [[nodiscard]] bool drives() const { return is_told_; }
  // It is known how the robot moves, if only by what it is told.
  [[nodiscard]] bool knows_motion() const { return has_odometry() || is_told_; }

 private:
  [[nodiscard]] std::optional<motion::OdometryIncrement> Driven(const Observation& observation);
  [[nodiscard]] bool IsFrozen(const Seen& seen);

  FrameCheck check_;
  vision::IntakeOptions options_;
  vision::PictureIntake intake_;
  vision::FeatureTracker tracker_;
  std::optional<motion::Pose2> last_odometry_;
  bool by_commands_;
  ToldMotion told_;
  MountWatch mount_;
  vision::ViewPicture reduced_;
  FollowedFor followed_for_ = FollowedFor::kPlace;
  int followed_width_px_ = 0;                           // of the picture they are followed in
  std::optional<motion::OdometryIncrement> told_step_;  // since the last frame
  double usual_flow_ = 0.0;
  double frozen_s_ = 0.0;
  bool is_told_ = false;
  std::optional<SensorTime> last_stamp_;
};

}  // namespace trailcast::agent
