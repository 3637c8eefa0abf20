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
  // Where the segment's features are now: pixels of the follower's own camera from its image
  // centre; id is the position in Segment::features.
  std::vector<route::TrackedFeature> features;
  // Since the last step; nothing on robots without odometry.
  std::optional<motion::OdometryIncrement> odometry;
  // How far it may have driven and turned besides, one way or the other.
  motion::OdometryIncrement unknown{};
  // To the left of the taught path, where to drive rather than on it, for methods that estimate
  // where that is.
  double aside_m = 0.0;
};

// Where the robot is beside the path as it was taught.
struct PathOffset {
  double left_m = 0.0;       // e: to the left of the path
  double heading_rad = 0.0;  // alpha: to the left of the taught heading
  double along_m = 0.0;      // s: driven of the segment
  double left_sigma_m = 0.0;
  double along_sigma_m = 0.0;  // of the camera's place
};

// How roughly it is known where a robot begins. What is seen looks larger from further along, and
// just as much so to a camera that magnifies more.
struct RoughPlace {
  double along_sigma_m = 0.0;
  // Of the robot's own camera; nothing: it is not known, and most likely the scout's.
  std::optional<FocalLength> focal{};
};

// Fewer features that agree may all be mismatches, and tell nothing.
inline constexpr int kFewestAgreeing = 4;

// How the features in view fit what the route says.
struct Agreement {
  int agreeing = 0;
  int rejected = 0;             // too far from where they should be: a mismatch, or a drift
  double rejected_by_px = 0.0;  // how far, on average; in the scout's pixels
  // What is seen says that the robot is so far to the left of where it was thought to be: somebody
  // carried it there.
  std::optional<double> carried_left_m;
};

struct FollowStep {
  motion::VelocityCommand command;
  // Desired heading change, radians, positive to the right; the two halves that the paper's method
  // fuses, where the method has them.
  double turn_rad = 0.0;
  double vision_turn_rad = 0.0;
  double odometry_turn_rad = 0.0;
  double roll_rad = 0.0;
  double delta = 0.0;  // equation (2), where the method has it
  double delta_minus = 0.0;
  std::optional<PathOffset> offset;      // where the method estimates it
  double mount_yaw_rad = 0.0;            // of this robot's camera against the scout's, the same
  int agreeing = 0;                      // features that fit what the route says
  int rejected = 0;                      // that do not, where the method tells them apart
  double rejected_by_px = 0.0;           // and by how much, as in Agreement
  std::optional<double> carried_left_m;  // the same, of one that was carried off
  double fraction = 0.0;                 // of the segment, 0..1
  bool ended = false;                    // the milestone has been passed
  // Few of this segment's features are left in view: go on with the next one's, if they are there.
  bool wants_next = false;
};

// Follows a route segment by segment. No clock, no camera, no thread.
class Follower {
 public:
  virtual ~Follower() = default;
  Follower& operator=(const Follower&) = delete;

  // A segment of the route that is known before it is driven; in any order, each once.
  virtual void Learn(const route::Segment& segment) = 0;
  // One that has learnt and begun the same.
  [[nodiscard]] virtual std::unique_ptr<Follower> Clone() const = 0;
  // The first segment, the next one after Step said `ended`, or, for a robot that found itself
  // again, any.
  virtual void Begin(const route::Segment& segment) = 0;
  // Any segment, by a robot that is found to be that fraction along it.
  virtual void BeginAt(const route::Segment& segment, double fraction) = 0;
  // The same, by one that knows it roughly.
  virtual void BeginAbout(const route::Segment& segment, double fraction,
                          const RoughPlace& rough) = 0;
  // An earlier segment than the one begun, by a robot that is where it is known to be by that one:
  // about `along_m` of the earlier one. `there`: that place of the path, and its heading, as seen
  // from the beginning of the one begun, ahead and to the left. Both are driven forwards.
  virtual void CountAlong(const route::Segment& earlier, double along_m,
                          const motion::Pose2& there) = 0;
  // Where the segment's features should be in the picture now (FollowInput's coordinates).
  [[nodiscard]] virtual std::vector<route::TrackedFeature> Expect() const = 0;
  // Where they will be at the segment's end for a robot that gets there as it was taught.
  [[nodiscard]] virtual std::vector<route::TrackedFeature> ExpectAtMilestone() const = 0;
  // How far along u they may be from where Expect says, in scout's pixels of a picture 320 px wide;
  // along v half as far.
  [[nodiscard]] virtual double expected_within_px_at_320() const = 0;
  // A feature further from where it should be, in the scout's pixels, is not believed.
  [[nodiscard]] virtual double outlier_px() const = 0;
  // The follower's pixels per scout's pixel, and what the matches at a hand-over say it is.
  [[nodiscard]] virtual double magnification() const = 0;
  virtual void SetMagnification(double magnification) = 0;

  // It turns on the spot, as the scout did before this segment; the features come into view after.
  [[nodiscard]] virtual bool turning() const { return false; }
  // It does, and is nearly round: they should be coming.
  [[nodiscard]] virtual bool turn_is_in_view() const { return false; }

  [[nodiscard]] virtual FollowStep Step(const FollowInput& input) = 0;

  [[nodiscard]] virtual const route::Segment& segment() const = 0;

  // Where its camera is, as of the last Step; nothing: the method estimates no such thing.
  [[nodiscard]] virtual std::optional<CameraPlace> camera_place() const { return std::nullopt; }
  // Its focal length, by such a method: how it shows things, by what the route says of the scout's.
  [[nodiscard]] virtual std::optional<FocalLength> focal() const { return std::nullopt; }
  // The inverse depths of a segment's features, by such a method.
  [[nodiscard]] virtual std::vector<InverseDepth> Depths(const route::Segment& /*segment*/) const {
    return {};
  }

 protected:
  Follower() = default;
  Follower(const Follower&) = default;  // to Clone
};

}  // namespace trailcast::replay
