#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "services/motion/motion.h"
#include "services/replay/camera_place.h"
#include "services/replay/follower.h"
#include "services/replay/taught_flow.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

struct PathEstimatorOptions {
  TaughtFlowOptions flow;
  // This is how much further ahead of the turning axle its camera is than the scout's. It is learnt
  // in bends of the path if it is not given. The filter's state is the camera's place; offset() is
  // the axle's, which steering uses.
  std::optional<double> camera_ahead_m;
  double told_ahead_m = 0.02;     // standard deviation of a given one
  double untold_ahead_m = 0.2;    // standard deviation if none is given
  double least_bend_per_m = 0.1;  // curvature of the path above which a bend tells of it
  // This is the noise of a feature's place. It is larger than a tracker's, because it does not
  // change from frame to frame: it is parallax that the model leaves out, a patch seen from
  // elsewhere, or drift.
  double feature_noise_px = 3.0;
  double cauchy_px = 3.0;  // above this a residual counts less and less
  double outlier_px = 12.0;
  // If all features are about equally far away, that looks much like a camera further back that
  // magnifies more. So all looks over this distance count for the magnification as one of them
  // does.
  double magnification_every_m = 0.3;
  // These hold at the route's start.
  double start_left_m = 0.10;
  double start_heading_rad = 0.08;
  double start_along_m = 0.15;
  double start_magnification = 0.05;  // relative
  // This holds if its place is only known roughly, and its camera is unknown.
  double found_magnification = 0.4;
  double same_camera = 0.03;  // the spread of magnifications over most robots of a fleet
  double distortion = 0.1;
  double mount_yaw_rad = 0.035;           // between the scout's camera mount and this robot's
  double mount_height_m = 0.15;           // between them too
  double heading_bias_rad_per_m = 0.008;  // of this robot's odometry against the scout's
  // How many of the route's metres each of the odometry's is, and how many of its radians, as
  // logarithms: their doubt, and the first one's random walk per root metre.
  double way_log = 0.01;
  double way_log_noise = 0.001;
  double turn_log = 0.01;
  // These are the odometry's noise, per root metre, and further changes.
  double along_noise = 0.05;
  double left_noise_m = 0.01;
  // This is a share of the offset itself, since the depths that tell it have a relative error.
  double left_noise_share = 0.4;
  double heading_noise_rad = 0.02;
  double turn_noise_share = 0.03;  // share of a turn on the spot: wheel bases differ, and slip
  double magnification_noise = 0.001;
  double roll_rad = 0.05;  // of each frame alone, as for pitch
  double pitch_rad = 0.05;
  // The camera was knocked if all features are turned by more than this, and by this many times
  // what is believed possible, all alike but for a share of them, while this share of the usual
  // features is still seen. A robot that is carried aside loses sight of all that is near.
  double knock_least_rad = 0.03;
  double knock_sigmas = 3.0;
  double knock_spread = 0.25;
  double knock_seen = 0.7;
  double knock_apart_m = 0.5;  // if it turns again within this distance, it is the robot
  // These are for a robot that was carried off, and bound how far. That is the rarest of
  // explanations, and one view on rough ground may say anything. So a place to one side, at least
  // this far from the believed one, has to explain the features this much better (in nats; 9 is
  // eight thousand times as likely), look by look, each counting at most this much, over this
  // distance. The test runs every so many looks, since it costs as much as a few of them.
  double carried_left_m = 2.0;
  double carried_heading_rad = 0.15;
  double carried_along_m = 0.5;
  double carried_least_m = 0.4;
  double carried_gain = 9.0;
  double carried_gain_a_look = 3.0;
  int carried_every_looks = 5;
  double carried_after_m = 0.2;
};

// This is the widened funnel: the funnel lane's inequality made an equation. With its taught flow
// known, each feature tells not only on which side the robot is but how far: near ones tell the
// offset, far ones the heading. It is an iterated Kalman filter over (offset, heading, progress),
// the differences between the two cameras and their mounts, the odometry's bias, and each frame's
// own roll and pitch. Pixels are those of the follower's own camera, from its image centre.
class PathEstimator {
 public:
  PathEstimator(int scout_width_px, double magnification, const PathEstimatorOptions& options = {});

  // Here and below, a segment that was driven backwards is given as if it had been driven forwards
  // (src/as_forward.h). The robot enters it at its length and leaves it at 0.

  // Takes a segment of the route before it is driven, to learn the scout's camera.
  void Learn(const route::Segment& segment) { flow_.Learn(segment); }
  // Begins the next segment where the last one ends. Its features are seen from here on, also while
  // its start is still ahead (`along_m` is negative until then, or above its length if driven
  // backwards).
  void Begin(const route::Segment& segment);
  // Begins a segment with the camera this far along it, wherever the robot was estimated to be
  // before.
  void Restart(const route::Segment& segment, double along_m);
  // Says that its new place is known roughly, and how large its camera shows things no better than
  // given.
  void BeUnsureWhereAlong(const RoughPlace& rough);
  // Begins a segment with the axle at its entry, and the camera ahead of that.
  void StartAt(const route::Segment& segment);

  // The path turns on the spot where the segment is entered, counter-clockwise positive, and the
  // robot has not turned yet. From now on its place is along and beside the path after the turn.
  void TurnPath(double turn_rad);

  // Changes to another segment, on which the same robot is at about `along_m`. `there` is that
  // place of the path, with its heading, in the frame of the beginning of the present segment,
  // ahead and to the left. Both are driven forwards.
  void CountAlong(const route::Segment& segment, double along_m, const motion::Pose2& there);

  // Takes a motion of the robot.
  void Predict(const motion::OdometryIncrement& moved);

  // The robot may have driven and turned this far beside that, in either direction.
  void Widen(const motion::OdometryIncrement& unknown);

  // Takes a look, and returns how it agrees with the taught path. However long a robot stands and
  // looks, its uncertainty falls only as by one look. If fewer than kFewestAgreeing features agree,
  // odometry alone decides.
  Agreement Update(const std::vector<route::TrackedFeature>& seen);

  [[nodiscard]] PathOffset offset() const;  // of the axle
  [[nodiscard]] double camera_along_m() const { return state_[kAlong]; }
  [[nodiscard]] double offset_sigma_m() const;  // of the axle
  // Returns the taught change of heading between two places of the segment. Before its start it is
  // the last segment's.
  [[nodiscard]] double TaughtTurn(double from_m, double to_m) const;
  [[nodiscard]] double magnification() const { return state_[kMagnification]; }
  void SetMagnification(double magnification) {
    state_[kMagnification] = magnification;
    last_look_.reset();
    known_.reset();
  }
  // How many of the route's metres each of the odometry's is, and how many of its radians.
  [[nodiscard]] double WayScale() const;
  [[nodiscard]] double TurnScale() const;
  [[nodiscard]] FocalLength focal() const;  // of its own camera
  [[nodiscard]] double distortion() const { return state_[kDistortion]; }
  [[nodiscard]] double mount_yaw_rad() const { return state_[kMountYaw]; }
  [[nodiscard]] double camera_ahead_m() const { return state_[kAhead]; }
  // Tells that it was given, or learnt to half of its size.
  [[nodiscard]] bool KnowsAhead() const;
  [[nodiscard]] double roll_rad() const { return state_[kRoll]; }
  [[nodiscard]] CameraPlace camera_place() const;
  // Returns the inverse depths of a segment's features by what the route tells of the scout's
  // camera.
  [[nodiscard]] std::vector<InverseDepth> Depths(const route::Segment& segment) const {
    return flow_.Depths(segment);
  }
  // Returns where each of the segment's features should be now.
  [[nodiscard]] std::vector<route::TrackedFeature> Expect() const { return ExpectIn(state_); }
  // Returns where they should be at the segment's end, for this camera on the path itself.
  [[nodiscard]] std::vector<route::TrackedFeature> ExpectAtMilestone() const;

 private:
  enum Index {
    kLeft,
    kHeading,
    kAlong,
    kMagnification,
    kDistortion,
    kMountYaw,
    kHeight,
    kBias,
    kWay,
    kTurn,
    kAhead,
    kCarried,
    kRoll = kCarried,
    kPitch,
    kSize
  };
  using State = Eigen::Matrix<double, kSize, 1>;
  using Covariance = Eigen::Matrix<double, kSize, kSize>;
  using Row = Eigen::Matrix<double, 1, kSize>;

  struct Prediction {
    double u_px = 0.0;
    double v_px = 0.0;
    Row du = Row::Zero();
    Row dv = Row::Zero();
    double depth_sigma_px = 0.0;  // caused by the uncertain depth
  };
  // This counts features; a handful can be explained from anywhere.
  static constexpr std::size_t kFewestToFind = 10;
  static constexpr std::size_t kFewestByKnownCamera = 5;

  // This is what is believed before a look.
  struct Prior {
    Prior(const State& state, const Covariance& uncertainty);
    State mean;
    Covariance covariance;
    Covariance information;
  };
  // This is how sure it was before the last look, and how far the robot has come since.
  struct LastLook {
    Covariance before;
    double moved_m = 0.0;
    double turned_rad = 0.0;
  };
  // This is the belief in the magnification where it was last learnt, for a robot that began
  // somewhere on a segment and assumes the scout's camera: it knows its place along the segment
  // from how large features appear.
  struct KnownMagnification {
    double mean = 0.0;
    double variance = 0.0;
    double at_m = 0.0;  // distance driven
  };
  // These are the normal equations of a look, around one state.
  struct Equations {
    Covariance information;
    State gradient;
    Agreement agreement;
  };
  // This is the direction in which the features say that the robot was carried.
  struct CarriedTo {
    bool to_the_right = false;
    double driven_m = 0.0;  // distance driven when they first did
    double gain = 0.0;      // how much better that explains them, in nats
  };
  void BeUnsure();
  // Turns the axes of the state by this angle, counter-clockwise positive.
  void TurnAxes(double turn_rad);
  // Returns what is believed before a look. A robot that began somewhere leaves out what its last
  // looks have told of the magnification, so that the rest is believed for each magnification.
  [[nodiscard]] Prior BeforeLook();
  // Allows for features that all turn at once by more than odometry can have missed: the robot was
  // turned on its wheels, or its camera on its mount. Only driving on tells which: a robot that was
  // turned gets off the path. Until then either is as likely, but if the turning continues, it is
  // the robot, whose wheels slip.
  void AllowForKnock(const std::vector<route::TrackedFeature>& seen);
  [[nodiscard]] bool WasTurnedLately() const;
  // Returns how large a camera of that focal length shows things, by what the route tells of the
  // scout's.
  [[nodiscard]] double MagnificationBy(const FocalLength& own) const {
    return own.px / flow_.camera().focal_px;
  }
  [[nodiscard]] Equations Linearise(const State& state, const Prior& prior,
                                    const std::vector<route::TrackedFeature>& seen,
                                    double cauchy_px) const;
  // Returns how badly a state explains a look, in nats: the negative logarithm of its likelihood.
  [[nodiscard]] double Surprise(const State& state, const Prior& prior,
                                const std::vector<route::TrackedFeature>& seen) const;
  // Returns the state around a place, displaced along one of its directions, that explains a look
  // best, and how badly it does.
  [[nodiscard]] std::pair<State, double> LeastSurprising(
      Index index, double furthest_m, const State& about, const Prior& prior,
      const std::vector<route::TrackedFeature>& seen) const;
  // Puts the state where a look says that it is, and returns what is believed before that look.
  // Place and magnification are nearly one unknown in one picture. So the camera is assumed to be
  // like the scout's, if it may be, unless another explains the look better by more than it is less
  // likely.
  [[nodiscard]] Prior FindWhereAlong(const Prior& before,
                                     const std::vector<route::TrackedFeature>& seen);
  [[nodiscard]] State FromFarAway(State start, const Prior& prior,
                                  const std::vector<route::TrackedFeature>& seen) const;
  // Looks for a sign that the robot was carried off, which no odometry feels and which a filter
  // that is sure of its place takes for mismatches: a place far from the present one explains the
  // looks far better, again and again. It then goes on from there, and returns how far to the left
  // that is.
  std::optional<double> FindIfCarriedOff(const Prior& before,
                                         const std::vector<route::TrackedFeature>& seen);
  [[nodiscard]] std::vector<route::TrackedFeature> ExpectIn(const State& state) const;
  [[nodiscard]] double TaughtHeading(double along_m) const;
  [[nodiscard]] route::TrackKnot TaughtPlaceAt(std::size_t index, double along_m) const;
  [[nodiscard]] Prediction PredictFeature(std::size_t index, const State& state) const;

  PathEstimatorOptions options_;
  double scout_width_px_;
  double own_magnification_;  // for a camera like the scout's
  TaughtFlow flow_;
  route::Segment segment_;
  route::HeadingPolynomial last_heading_;  // of the previous segment
  double last_length_m_ = 0.0;
  std::vector<InverseDepth> depths_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
  std::optional<LastLook> last_look_;        // empty after other changes of the belief
  std::optional<KnownMagnification> known_;  // also empty if it did not begin so
  int looks_ = 0;
  double driven_m_ = 0.0;
  double looked_at_m_ = 0.0;   // distance driven at the last look
  double usually_seen_ = 0.0;  // features in a look, over the last knock_apart_m
  std::optional<CarriedTo> carried_;
  std::optional<RoughPlace> rough_;    // until a look has told its place along the segment
  std::optional<double> turned_at_m_;  // distance driven when all features turned at once
};

}  // namespace trailcast::replay
