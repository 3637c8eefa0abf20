#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "services/base/time.h"
#include "services/motion/motion.h"
#include "services/route/tracked_feature.h"
#include "services/teach/heading_fit.h"
#include "services/teach/spot_turn.h"
#include "services/teach/visual_odometry.h"

namespace trailcast::teach {

struct SegmentRecorderOptions {
  // A segment ends when fewer than this share of its first features survive (III).
  double survival_share = 0.5;
  // It also ends at this length. If all features are far away, half of them survive for long, and
  // the few that come near on the way would never be stored. The paper has no such limit.
  double longest_m = 2.0;
  // It does not end before this length, whatever becomes of its features: a robot that stands, or
  // sets off, teaches no path. The second limit is for robots without odometry, in time of motion.
  double shortest_m = 0.05;
  double shortest_s = 0.1;
  // A robot without odometry stands if half of its features move less than this between two frames,
  // in pixels of a picture 320 px wide.
  double still_px_at_320 = 0.12;
  // Short segments (in turns, or with clutter close by) have features that tell much the same. For
  // each metre only so many of a segment's survivors are kept, the strongest, but never fewer than
  // the second figure. This keeps a route under 5 kB a metre, one of sharp turns only just.
  double features_per_metre = 40.0;
  std::size_t fewest_kept = 11;
  // So many knots of each feature's track are kept, including the first and the last, which are all
  // that the paper needs. They are no closer together than the second figure, but there are at
  // least three.
  int knots = 4;
  double knot_spacing_m = 0.15;
  // A robot that drives the other way, backwards or forwards, no further than this is regarded as
  // standing, and nothing of it is taught.
  double shunt_m = 0.05;
  SegmentIndex first_index{0};  // for a teaching that is resumed: the number of segments so far
};

// This turns the tracked features of one segment after the other into what the route stores of it.
// Begin a segment, add frames until Add says that it ends, take it with Finish, and begin the next
// with the same frame. A turn on the spot belongs to no segment: the next one begins with it. Where
// the robot changes between backwards and forwards, a segment ends. As that is clear only a little
// later, what it drove beyond that place and back again belongs to none.
class SegmentRecorder {
 public:
  enum class Event {
    kGoesOn,
    kEnds,   // the segment, or the turn on the spot, ends with this image
    kTurns,  // turns on the spot; with the first such image the segment has ended, before the turn
  };

  // `width_px` is the width of the scout's frames.
  explicit SegmentRecorder(int width_px, const SegmentRecorderOptions& options = {})
      : options_(options),
        width_px_(width_px),
        still_px_(options.still_px_at_320 * width_px / 320.0),
        next_index_(options.first_index),
        visual_odometry_(width_px) {}

  // Takes the segment's first image: its features, the strongest first, and the odometry pose at
  // that moment, if any.
  void Begin(SensorTime stamp, std::vector<route::DescribedFeature> features,
             const std::optional<motion::Pose2>& odometry);

  // Takes the next image: the features that are still there.
  [[nodiscard]] Event Add(SensorTime stamp, const std::vector<route::TrackedFeature>& tracked,
                          const std::optional<motion::Pose2>& odometry);

  // Makes the last image given to Begin or Add a key view.
  void Keep(const route::View& view);

  // Returns the segment from Begin to the last Add, or to where the robot began to turn on the
  // spot, with the features that were tracked throughout. Returns nothing if the robot has not
  // moved since Begin.
  [[nodiscard]] std::optional<route::Segment> Finish();

  // Returns whether the robot has gone back a little from where it has been. Nothing of that is
  // taught so far.
  [[nodiscard]] bool behind() const { return furthest_.has_value(); }
  // Returns whether the last image given to Add was taken further on than the one before.
  [[nodiscard]] bool advanced() const { return advanced_; }
  // Returns whether the segment is driven backwards.
  [[nodiscard]] bool reverse() const { return way_ < 0.0; }
  // Returns how far the robot turned on the spot since the last segment, counter-clockwise
  // positive. Nothing else tells this if a route ends with a turn.
  [[nodiscard]] double turned_rad() const {
    return turn_before_rad_ + (turning_ ? turn_.turned_rad() : 0.0);
  }

  [[nodiscard]] double distance_m() const {
    return moments_.empty() ? 0.0 : moments_.back().distance_m;
  }

 private:
  using Features = std::unordered_map<int, route::TrackedFeature>;

  // This is one image of the segment. All but its features is since the segment's start.
  struct Moment {
    Features features;
    double distance_m = 0.0;
    double heading_rad = 0.0;  // without odometry, by how far the picture turned
    SensorTime moving{0};      // time driven, so that a robot that waits does not teach a slow pace
    std::vector<route::View> key_views;
  };

  [[nodiscard]] bool Moved(const Features& tracked,
                           const std::optional<motion::OdometryIncrement>& step) const;
  [[nodiscard]] double SeenTurn(const std::vector<route::TrackedFeature>& tracked) const;
  [[nodiscard]] bool LongEnough() const;
  [[nodiscard]] Event TurnOnTheSpot(SpotTurnWatch::State before);
  enum class Way { kOn, kBehind, kOther };
  [[nodiscard]] Way Follow(const motion::Pose2& from, const motion::Pose2& now,
                           motion::OdometryIncrement& step);
  void DriveBySight();
  [[nodiscard]] std::vector<HeadingSample> Headings() const;
  [[nodiscard]] std::size_t End() const;
  [[nodiscard]] Moment PlaceOf(const motion::Pose2& back) const;
  void PutBefore(std::vector<route::View> views);
  [[nodiscard]] std::size_t MostFeatures(const route::Segment& segment) const;
  [[nodiscard]] int KnotsFor(double length_m) const;
  [[nodiscard]] route::Feature Store(const route::DescribedFeature& feature, int knots) const;
  [[nodiscard]] std::vector<route::KeyView> TakeKeyViews();
  [[nodiscard]] double FractionAt(const Moment& moment) const;

  SegmentRecorderOptions options_;
  int width_px_;
  double still_px_;
  SegmentIndex next_index_;
  std::vector<route::DescribedFeature> first_;
  std::vector<Moment> moments_;
  SensorTime last_stamp_{0};
  bool advanced_ = false;
  // These are from when the robot last moved.
  std::optional<motion::Pose2> moved_odometry_;
  Features moved_features_;

  double way_ = 1.0;  // -1 if the segment is driven backwards
  // This is where the robot was before it went back a little, until it is there again.
  std::optional<motion::Pose2> furthest_;
  std::optional<Moment> other_way_from_;  // the place of this segment at which the next begins

  VisualOdometry visual_odometry_;  // for robots without odometry

  SpotTurnWatch turn_;
  bool turning_ = false;       // the segment has ended, too
  std::size_t turn_from_ = 0;  // position of the moment at which the turn may have begun
  // These come before the next segment to be finished.
  double turn_before_rad_ = 0.0;
  std::vector<route::View> views_before_;
};

}  // namespace trailcast::teach
