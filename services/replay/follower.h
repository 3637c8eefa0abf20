#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "services/motion/motion.h"
#include "services/replay/camera_place.h"
#include "services/replay/focal_length.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

struct FollowInput {
  // These are the present places of the segment's features, in pixels of the follower's own camera
  // from its image centre. The id is the position in Segment::features.
  std::vector<route::TrackedFeature> features;
  // This is since the last step. Robots without odometry have none.
  std::optional<motion::OdometryIncrement> odometry;
  // The robot may have driven and turned this far beside that, in either direction.
  motion::OdometryIncrement unknown{};
  // Methods that estimate where the taught path is drive this far to its left, rather than on it.
  double aside_m = 0.0;
};

// This is where the robot is beside the path as it was taught.
struct PathOffset {
  double left_m = 0.0;       // e: to the left of the path
  double heading_rad = 0.0;  // alpha: to the left of the taught heading
  double along_m = 0.0;      // s: driven of the segment
  double left_sigma_m = 0.0;
  double along_sigma_m = 0.0;  // of the camera's place
};

// This is how roughly a robot's place is known where it begins. Features look larger from further
// along, and equally so to a camera that magnifies more.
struct RoughPlace {
  double along_sigma_m = 0.0;
  // This is of the robot's own camera. It is empty if unknown, and then it is most likely the
  // scout's.
  std::optional<FocalLength> focal{};
};

// If fewer features agree, all of them may be mismatches, and they tell nothing.
inline constexpr int kFewestAgreeing = 4;

// This is how the features in view fit the route.
struct Agreement {
  int agreeing = 0;
  int rejected = 0;             // too far from where they should be: mismatches or drift
  double rejected_by_px = 0.0;  // mean distance, in the scout's pixels
  // The features show that the robot is this far to the left of its estimated place, so it was
  // carried there.
  std::optional<double> carried_left_m;
};

struct FollowStep {
  motion::VelocityCommand command;
  // This is the desired heading change in radians, positive to the right, with the two halves that
  // the paper's method fuses, if the method has them.
  double turn_rad = 0.0;
  double vision_turn_rad = 0.0;
  double odometry_turn_rad = 0.0;
  double roll_rad = 0.0;
  double delta = 0.0;  // equation (2), if the method has it
  double delta_minus = 0.0;
  std::optional<PathOffset> offset;      // if the method estimates it
  double mount_yaw_rad = 0.0;            // of this robot's camera against the scout's
  int agreeing = 0;                      // features that fit the route
  int rejected = 0;                      // features that do not, if the method tells them apart
  double rejected_by_px = 0.0;           // see Agreement
  std::optional<double> carried_left_m;  // see Agreement
  double fraction = 0.0;                 // share of the segment, 0..1
  bool ended = false;                    // the milestone has been passed
  // Few of this segment's features are left in view, so the next one's may be used if they are
  // there.
  bool wants_next = false;
};

// This follows a route segment by segment. It has no clock, no camera and no thread.
class Follower {
 public:
  virtual ~Follower() = default;
  Follower& operator=(const Follower&) = delete;

  // Takes a segment of the route that is known before it is driven. Segments come in any order,
  // each once.
  virtual void Learn(const route::Segment& segment) = 0;
  // Returns a follower that has learnt and begun the same.
  [[nodiscard]] virtual std::unique_ptr<Follower> Clone() const = 0;
  // Begins the first segment, the next one after Step said `ended`, or, for a robot that found its
  // place again, any segment.
  virtual void Begin(const route::Segment& segment) = 0;
  // Begins any segment, for a robot that is found to be at that fraction of it.
  virtual void BeginAt(const route::Segment& segment, double fraction) = 0;
  // Does the same for a robot that knows it roughly.
  virtual void BeginAbout(const route::Segment& segment, double fraction,
                          const RoughPlace& rough) = 0;
  // Changes to an earlier segment, for a robot whose place is known by the one begun: about
  // `along_m` of the earlier one. `there` is that place of the path, with its heading, in the frame
  // of the beginning of the one begun, ahead and to the left. Both are driven forwards.
  virtual void CountAlong(const route::Segment& earlier, double along_m,
                          const motion::Pose2& there) = 0;
  // Returns where the segment's features should be in the picture now (FollowInput's coordinates).
  [[nodiscard]] virtual std::vector<route::TrackedFeature> Expect() const = 0;
  // Returns where they will be at the segment's end for a robot that gets there as it was taught.
  [[nodiscard]] virtual std::vector<route::TrackedFeature> ExpectAtMilestone() const = 0;
  // Returns how far along u they may be from where Expect predicts them, in scout's pixels of a
  // picture 320 px wide. Along v it is half as far.
  [[nodiscard]] virtual double expected_within_px_at_320() const = 0;
  // A feature that is further from where it should be, in the scout's pixels, is not trusted.
  [[nodiscard]] virtual double outlier_px() const = 0;
  // These are the follower's pixels for each of the scout's, and its estimate by the matches at a
  // hand-over.
  [[nodiscard]] virtual double magnification() const = 0;
  virtual void SetMagnification(double magnification) = 0;

  // Tells that it turns on the spot, as the scout did before this segment. The features come into
  // view afterwards.
  [[nodiscard]] virtual bool turning() const { return false; }
  // Tells that such a turn is nearly complete, so that the features should be coming into view.
  [[nodiscard]] virtual bool turn_is_in_view() const { return false; }

  [[nodiscard]] virtual FollowStep Step(const FollowInput& input) = 0;

  [[nodiscard]] virtual const route::Segment& segment() const = 0;

  // Returns where its camera is, as of the last Step, or nothing if the method does not estimate
  // it.
  [[nodiscard]] virtual std::optional<CameraPlace> camera_place() const { return std::nullopt; }
  // Returns its focal length, if the method estimates it, from how it shows things and from the
  // route's knowledge of the scout's camera.
  [[nodiscard]] virtual std::optional<FocalLength> focal() const { return std::nullopt; }
  // Returns the inverse depths of a segment's features, if the method estimates them.
  [[nodiscard]] virtual std::vector<InverseDepth> Depths(const route::Segment& /*segment*/) const {
    return {};
  }

 protected:
  Follower() = default;
  Follower(const Follower&) = default;  // for Clone
};

}  // namespace trailcast::replay
