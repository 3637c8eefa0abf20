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

// This is what one frame shows.
struct FrameInput {
  const image::GrayImage* frame = nullptr;  // as the intake makes it; valid until the next
  // This is the picture in which features are followed: the frame itself, or a reduced one.
  const image::GrayImage* followed_in = nullptr;
  std::vector<route::TrackedFeature> features;  // the followed ones, at their present places there
  // This is how far most features moved, as a share of the width, or 1 if they are too few.
  double flow = 0.0;
  double usual_flow = 0.0;  // lately, as far as it was known
  bool frozen = false;      // odometry stands still while the picture keeps moving
  // These are since the last frame, by odometry and by the commands to the base, as far as there
  // are any.
  std::optional<motion::OdometryIncrement> measured;
  std::optional<motion::OdometryIncrement> told;
  // This is the better one of these.
  std::optional<motion::OdometryIncrement> driven;
  motion::OdometryIncrement unknown{};  // see Observation::unknown
  // See Observation::stands. It is valid until the next frame.
  const std::vector<Eigen::Vector2d>* stands = nullptr;
  double dt_s = 0.0;      // since the last frame
  double looked_s = 0.0;  // dt_s, but no longer than kLongestFrame_s
};

// This is why features are followed.
enum class FollowedFor {
  kPlace,  // they are a segment's, and tell where the robot is
  kFlow,   // any features of a reduced picture tell whether the robot moves
};

// This is the front end, a picture's first station: it checks the picture, takes it in, and tracks
// its features.
class FrontEnd {
 public:
  // With `by_commands` the commands to the base count as motion.
  FrontEnd(const vision::IntakeOptions& intake, bool by_commands)
      : options_(intake), intake_(intake), by_commands_(by_commands) {}

  // Changes how pictures are taken in, from the next frame on. Tracked features are lost.
  void Turn(const vision::IntakeOptions& intake);

  // Returns all but the features and what they tell, which Track adds. It has to be called for each
  // frame. Its errors are those of FrameCheck.
  [[nodiscard]] Result<FrameInput> See(const Observation& observation);
  void Track(FrameInput& seen, FollowedFor what);
  // Goes on with strong features of a view of the last frame that are spread over it.
  void FollowSomeOf(const view::ViewTable& view);

  // Takes in a frame without examining it. The result is valid as FrameInput::frame is.
  [[nodiscard]] const image::GrayImage* Pass(const Observation& observation);

  [[nodiscard]] vision::FeatureTracker& tracker() { return tracker_; }
  [[nodiscard]] const vision::FeatureTracker& tracker() const { return tracker_; }
  // These are how pictures are taken in, and whether the robot's turns agree with that.
  [[nodiscard]] const vision::IntakeOptions& intake() const { return options_; }
  [[nodiscard]] const MountWatch& mount() const { return mount_; }
  [[nodiscard]] bool has_odometry() const { return last_odometry_.has_value(); }
  // Tells that the base carries out commands, so that whatever is believed moves a robot.
  [[nodiscard]] bool drives() const { return is_told_; }
  // Tells that the robot's motion is known, if only by its commands.
  [[nodiscard]] bool knows_motion() const { return has_odometry() || is_told_; }

 private:
  [[nodiscard]] std::optional<motion::OdometryIncrement> Driven(const Observation& observation);
  [[nodiscard]] bool IsFrozen(const FrameInput& seen);

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
  int followed_width_px_ = 0;  // width of the picture in which they are followed
  std::optional<motion::OdometryIncrement> told_step_;  // since the last frame
  double usual_flow_ = 0.0;
  double frozen_s_ = 0.0;
  bool is_told_ = false;
  std::optional<SensorTime> last_stamp_;
};

}  // namespace trailcast::agent
