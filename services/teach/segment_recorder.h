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
  // ... or at this length. Where all features are far away half of them survive for long, and the
  // few that come near on the way would never be stored. The paper has no such limit.
  double longest_m = 2.0;
  // But not before this length, whatever becomes of its features: a robot that stands, or sets off,
  // teaches no way. The second is for robots without odometry: time in motion.
  double shortest_m = 0.05;
  double shortest_s = 0.1;
  // Without odometry a robot stands whose features, half of them, move less between two frames; in
  // pixels of a picture 320 px wide.
  double still_px_at_320 = 0.12;
  // Where segments are short (turns, clutter close by) their features overlap in what they say: of
  // a segment's survivors only so many a metre are kept, the strongest, but never fewer than the
  // second figure. Holds a route under 5 kB a metre, one of sharp turns only just.
  double features_per_metre = 40.0;
  std::size_t fewest_kept = 11;
  // Knots kept of each feature's track, first and last included; the paper needs those two. No
  // closer together than the second figure, but three at least.
  int knots = 4;
  double knot_spacing_m = 0.15;
  // Driven the other way no further than this, backwards or forwards, a robot only stands uneasily,
  // and nothing of it is taught.
  double shunt_m = 0.05;
  SegmentIndex first_index{0};  // of a teaching that goes on: as many segments as there are already
};

// Turns the tracked features of one segment after the other into what the route stores of it.
// Begin a segment, add frames until Add says it ends, take it with Finish, begin the next with the
// same frame. A turn on the spot belongs to no segment: it is what the next one begins with. Where
// the robot goes on the other way, backwards or forwards, a segment ends; as that is clear only a
// little later, what it drove to there and back again by then belongs to none.
class SegmentRecorder {
 public:
  enum class Event {
    kGoesOn,
    kEnds,   // with this image, the segment or the turn on the spot
    kTurns,  // on the spot; with the first such image the segment has ended, before the turn
  };

  // `width_px`: of the scout's frames.
  explicit SegmentRecorder(int width_px, const SegmentRecorderOptions& options = {})
      : options_(options),
        width_px_(width_px),
        still_px_(options.still_px_at_320 * width_px / 320.0),
        next_index_(options.first_index),
        visual_odometry_(width_px) {}

  // The segment's first image: its features, the strongest first, and the odometry pose at that
  // moment, if any.
  void Begin(SensorTime stamp, std::vector<route::DescribedFeature> features,
             const std::optional<motion::Pose2>& odometry);

  // The next image: which of the features are still there.
  [[nodiscard]] Event Add(SensorTime stamp, const std::vector<route::TrackedFeature>& tracked,
                          const std::optional<motion::Pose2>& odometry);

  // The last image given to Begin or Add is a key view.
  void Keep(const route::View& view);

  // The segment from Begin to the last Add, or to where the robot began to turn on the spot, with
  // the features that were tracked throughout. Nothing if the robot has not moved since Begin.
  [[nodiscard]] std::optional<route::Segment> Finish();

  // The robot has gone back a little from where it has been, of which nothing is taught so far.
  [[nodiscard]] bool behind() const { return furthest_.has_value(); }
  // The last image given to Add was taken further on than the one before.
  [[nodiscard]] bool advanced() const { return advanced_; }
  // It is driven backwards.
  [[nodiscard]] bool reverse() const { return way_ < 0.0; }
  // Turned on the spot since the last segment, counter-clockwise positive: of a route that ends so,
  // nothing else tells it.
  [[nodiscard]] double turned_rad() const {
    return turn_before_rad_ + (turning_ ? turn_.turned_rad() : 0.0);
  }

  [[nodiscard]] double distance_m() const {
    return moments_.empty() ? 0.0 : moments_.back().distance_m;
  }

 private:
  using Features = std::unordered_map<int, route::TrackedFeature>;

  // One image of the segment; the rest is since the segment's start.
  struct Moment {
    Features features;
    double distance_m = 0.0;
    double heading_rad = 0.0;  // without odometry, as far as the picture turned
    SensorTime moving{0};      // time driven; a robot that waits does not teach slowness
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
  // When the robot last moved.
  std::optional<motion::Pose2> moved_odometry_;
  Features moved_features_;

  double way_ = 1.0;  // -1: the segment is driven backwards
  // Where the robot was before it went back a little, until it is there again.
  std::optional<motion::Pose2> furthest_;
  std::optional<Moment> other_way_from_;  // the next segment goes, beside this place of this one

  VisualOdometry visual_odometry_;  // without odometry

  SpotTurnWatch turn_;
  bool turning_ = false;       // and the segment has ended
  std::size_t turn_from_ = 0;  // position of the moment with which it may have begun to
  // What comes before the next segment to be finished.
  double turn_before_rad_ = 0.0;
  std::vector<route::View> views_before_;
};

}  // namespace trailcast::teach
