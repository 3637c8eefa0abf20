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
  // From the axle that the robot turns about ahead to its camera, more than on the scout; nothing:
  // not told, and learnt where the path bends. The filter's state is the camera's place; offset()
  // is the axle's, by which one steers.
  std::optional<double> camera_ahead_m;
  double told_ahead_m = 0.02;     // how sure that is when told,
  double untold_ahead_m = 0.2;    // and when not
  double least_bend_per_m = 0.1;  // curvature of the path from which on a bend tells of it
  // Noise of a feature's place. Larger than a tracker's, because it does not change from frame to
  // frame: it is parallax that the model leaves out, a patch seen from elsewhere, a drift.
  double feature_noise_px = 3.0;
  double cauchy_px = 3.0;  // beyond this a residual counts less and less
  double outlier_px = 12.0;
  // And where all features are about as far away, that looks much as a camera that magnifies more
  // further back does: the looks of so much of a way tell of the magnification what one of them
  // does.
  double magnification_every_m = 0.3;
  // At the route's start.
  double start_left_m = 0.10;
  double start_heading_rad = 0.08;
  double start_along_m = 0.15;
  double start_magnification = 0.05;  // relative
  double found_magnification = 0.4;   // where it begins roughly, and its camera is not known
  double same_camera = 0.03;          // of most robots of a fleet: their magnifications' spread
  double distortion = 0.1;
  double mount_yaw_rad = 0.035;           // between the scout's camera mount and this robot's
  double mount_height_m = 0.15;           // the same
  double heading_bias_rad_per_m = 0.008;  // of this robot's odometry against the scout's
  // Of the odometry, per root metre, and what may change besides.
  double along_noise = 0.05;
  double left_noise_m = 0.01;
  double left_noise_share = 0.4;  // of the offset itself: the depths that tell it err by a share
  double heading_noise_rad = 0.02;
  double turn_noise_share = 0.03;  // of a turn on the spot: what wheel bases differ by, and slip
  double magnification_noise = 0.001;
  double roll_rad = 0.05;  // of each frame alone, as pitch
  double pitch_rad = 0.05;
  // Knocked: all that is seen is turned by more than so much, and so many times what is believed
  // to be possible, and feature by feature by the same, but for a share of it; and so much of
  // what was usually seen still is. Who is carried aside loses sight of all that is near.
  double knock_least_rad = 0.03;
  double knock_sigmas = 3.0;
  double knock_spread = 0.25;
  double knock_seen = 0.7;
  double knock_apart_m = 0.5;  // what turns again within so much is the robot
  // Carried off: how far that may be. Being carried is the rarest of explanations, and one view on
  // rough ground may say anything: places to one side, at least so far from the believed one, have
  // to explain so much better what is seen (in nats; 9: eight thousand times as likely), look by
  // look and none of them by more than so much, over so much of a way. Asked every so many looks:
  // it costs as much as a few of them.
  double carried_left_m = 2.0;
  double carried_heading_rad = 0.15;
  double carried_along_m = 0.5;
  double carried_least_m = 0.4;
  double carried_gain = 9.0;
  double carried_gain_a_look = 3.0;
  int carried_every_looks = 5;
  double carried_after_m = 0.2;
};

// The widened funnel: the funnel lane's inequality made an equation. With its taught flow known,
// each feature says not only on which side the robot is but how far: near ones speak of the offset,
// far ones of the heading. An iterated Kalman filter over (offset, heading, progress), what differs
// between the two cameras and their mounts, the odometry's bias, and each frame's own roll and
// pitch. Pixels are those of the follower's own camera, from its image centre.
class PathEstimator {
 public:
  PathEstimator(int scout_width_px, double magnification, const PathEstimatorOptions& options = {});

  // Here and below a segment that was driven backwards is given as if it had been driven forwards
  // (src/as_forward.h); the robot enters it at its length and leaves it at 0.

  // A segment of the route, before it is driven: what it says of the scout's camera.
  void Learn(const route::Segment& segment) { flow_.Learn(segment); }
  // The next segment begins where the last one ends; its features are seen from here on, also while
  // its start is still ahead (`along_m` is negative until then; driven backwards, above its
  // length).
  void Begin(const route::Segment& segment);
  // Begins a segment with the camera so far along it, wherever the robot was thought to be before.
  void Restart(const route::Segment& segment, double along_m);
  // Where it has just been put is known roughly, and how large its camera shows things no better
  // than this says.
  void BeUnsureWhereAlong(const RoughPlace& rough);
  // Begins a segment with the axle where that is entered, and the camera as far ahead as it is.
  void StartAt(const route::Segment& segment);

  // The path turns on the spot where the segment is entered, counter-clockwise positive, the robot
  // not yet: where it stands is from now on counted along, and beside, what comes after the turn.
  void TurnPath(double turn_rad);

  // Counts from now on along another segment, where the same robot is about `along_m` of it.
  // `there`: that place of the path, and its heading, as seen from the beginning of the present
  // segment, ahead and to the left. Both are driven forwards.
  void CountAlong(const route::Segment& segment, double along_m, const motion::Pose2& there);

  // The robot moved.
  void Predict(const motion::OdometryIncrement& moved);

  // It may have driven and turned so far besides, one way or the other.
  void Widen(const motion::OdometryIncrement& unknown);

  // What it sees; returns how it agrees with the taught path. However long a robot stands and
  // looks, it becomes no surer than by one look; where fewer than kFewestAgreeing features
  // agree it stays where odometry says that it is.
  Agreement Update(const std::vector<route::TrackedFeature>& seen);

  [[nodiscard]] PathOffset offset() const;  // of the axle
  [[nodiscard]] double camera_along_m() const { return state_[kAlong]; }
  [[nodiscard]] double offset_sigma_m() const;  // the same
  // Taught change of heading between two places of the segment, before its start by the last one's.
  [[nodiscard]] double TaughtTurn(double from_m, double to_m) const;
  [[nodiscard]] double magnification() const { return state_[kMagnification]; }
  void SetMagnification(double magnification) {
    state_[kMagnification] = magnification;
    last_look_.reset();
    known_.reset();
  }
  [[nodiscard]] FocalLength focal() const;  // of its own camera
  [[nodiscard]] double distortion() const { return state_[kDistortion]; }
  [[nodiscard]] double mount_yaw_rad() const { return state_[kMountYaw]; }
  [[nodiscard]] double camera_ahead_m() const { return state_[kAhead]; }
  // Told, or learnt to half of what it is.
  [[nodiscard]] bool KnowsAhead() const;
  [[nodiscard]] double roll_rad() const { return state_[kRoll]; }
  [[nodiscard]] CameraPlace camera_place() const;
  // The inverse depths of a segment's features by what the route says of the scout's camera.
  [[nodiscard]] std::vector<InverseDepth> Depths(const route::Segment& segment) const {
    return flow_.Depths(segment);
  }
  // Where each of the segment's features should be now.
  [[nodiscard]] std::vector<route::TrackedFeature> Expect() const { return ExpectIn(state_); }
  // And at the segment's end, for this camera on the path itself.
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
    double depth_sigma_px = 0.0;  // what not knowing the depth makes of it
  };
  // Features; a handful can be explained from anywhere.
  static constexpr std::size_t kFewestToFind = 10;
  static constexpr std::size_t kFewestByKnownCamera = 5;

  // What is believed before a look.
  struct Prior {
    Prior(const State& state, const Covariance& uncertainty);
    State mean;
    Covariance covariance;
    Covariance information;
  };
  // How sure it was before the last look, and how far the robot has come since.
  struct LastLook {
    Covariance before;
    double moved_m = 0.0;
    double turned_rad = 0.0;
  };
  // What was believed of the magnification where it was last learnt, by a robot that began
  // somewhere on a segment and holds its camera to be as the scout's: where along it is it has from
  // how large that shows things.
  struct KnownMagnification {
    double mean = 0.0;
    double variance = 0.0;
    double at_m = 0.0;  // driven
  };
  // The normal equations of a look, about one state.
  struct Equations {
    Covariance information;
    State gradient;
    Agreement agreement;
  };
  // Which way what is seen says that it was carried.
  struct CarriedTo {
    bool to_the_right = false;
    double driven_m = 0.0;  // when it first did
    double gain = 0.0;      // by how much better that explains it, in nats
  };
  void BeUnsure();
  // Where it is is counted in axes turned by so much, counter-clockwise positive.
  void TurnAxes(double turn_rad);
  // What is believed before a look: by one that began so without what its last looks have said of
  // the magnification; of all else it is what is believed for each magnification.
  [[nodiscard]] Prior BeforeLook();
  // Whether all that is seen is turned at once by more than odometry can have missed: somebody has
  // turned the robot on its wheels, or its camera on its mount. Which of the two only driving on
  // tells: a robot that was turned gets off the path. Until then either is as likely; but what goes
  // on turning is the robot, whose wheels slip.
  void AllowForKnock(const std::vector<route::TrackedFeature>& seen);
  [[nodiscard]] bool WasTurnedLately() const;
  // By what the route says of the scout's camera: how large one of that focal length shows things.
  [[nodiscard]] double MagnificationBy(const FocalLength& own) const {
    return own.px / flow_.camera().focal_px;
  }
  [[nodiscard]] Equations Linearise(const State& state, const Prior& prior,
                                    const std::vector<route::TrackedFeature>& seen,
                                    double cauchy_px) const;
  // How badly a state explains a look, in nats: the negative logarithm of its likelihood.
  [[nodiscard]] double Surprise(const State& state, const Prior& prior,
                                const std::vector<route::TrackedFeature>& seen) const;
  // Of all about a place, so far along one of the state's directions, by how badly they explain a
  // look.
  [[nodiscard]] std::pair<State, double> LeastSurprising(
      Index index, double furthest_m, const State& about, const Prior& prior,
      const std::vector<route::TrackedFeature>& seen) const;
  // Puts the state where a look says that it is, and returns what is believed before that look: of
  // one picture, place and magnification are nearly one unknown, so the camera is held to be as the
  // scout's, where it may be, unless another explains the look better by more than its being rarer.
  [[nodiscard]] Prior FindWhereAlong(const Prior& before,
                                     const std::vector<route::TrackedFeature>& seen);
  [[nodiscard]] State FromFarAway(State start, const Prior& prior,
                                  const std::vector<route::TrackedFeature>& seen) const;
  // Whether somebody carried the robot off, which no odometry feels and which a filter sure of its
  // place takes for mismatches: is there a place far from the present one that explains the look
  // far better, time and again? Then goes on from there, and says how far to the left that is.
  std::optional<double> FindIfCarriedOff(const Prior& before,
                                         const std::vector<route::TrackedFeature>& seen);
  [[nodiscard]] std::vector<route::TrackedFeature> ExpectIn(const State& state) const;
  [[nodiscard]] double TaughtHeading(double along_m) const;
  [[nodiscard]] route::TrackKnot TaughtPlaceAt(std::size_t index, double along_m) const;
  [[nodiscard]] Prediction PredictFeature(std::size_t index, const State& state) const;

  PathEstimatorOptions options_;
  double scout_width_px_;
  double own_magnification_;  // if it has a camera like the scout's
  TaughtFlow flow_;
  route::Segment segment_;
  route::HeadingPolynomial last_heading_;  // of the segment before this one
  double last_length_m_ = 0.0;
  std::vector<InverseDepth> depths_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
  std::optional<LastLook> last_look_;  // nothing: what is believed has changed since otherwise
  std::optional<KnownMagnification> known_;  // the same, or it did not begin so
  int looks_ = 0;
  double driven_m_ = 0.0;
  double looked_at_m_ = 0.0;   // driven at the last look
  double usually_seen_ = 0.0;  // features in a look, over the last knock_apart_m
  std::optional<CarriedTo> carried_;
  std::optional<RoughPlace> rough_;    // until a look has told where along it is
  std::optional<double> turned_at_m_;  // driven when all was turned at once
};

}  // namespace trailcast::replay
