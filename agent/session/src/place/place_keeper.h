#pragma once

#include <optional>
#include <vector>

#include "agent/session/src/place/recogniser.h"
#include "agent/session/src/place/route_place.h"
#include "services/image/image.h"
#include "services/motion/motion.h"
#include "services/route/route.h"
#include "services/vision/view_fit.h"

namespace trailcast::agent {

// How a robot moved since the last frame.
struct FrameMotion {
  // Along the route, by odometry, and by what the base was told; nothing: there is none.
  std::optional<motion::OdometryIncrement> odometry;
  std::optional<motion::OdometryIncrement> told;
  double flow = 0.0;  // of most features in the picture, as a share of its width
  double dt_s = 0.0;
  double unknown_m = 0.0;  // besides, one way or the other
  bool frozen = false;     // odometry tells that it stands, against what it sees
};

// Keeps the belief in a robot's place on a route (route_belief.h) up to date with how it moves and
// which of the route's key views its camera shows. No clock.
class PlaceKeeper {
 public:
  explicit PlaceKeeper(int scout_width_px) : recogniser_(scout_width_px) {}

  // In order from the route's first on.
  void Learn(const route::Segment& segment);
  [[nodiscard]] bool known() const { return place_.known(); }

  // About there, in the route's units (RoutePlace::metric), or anywhere.
  void StartAt(double along, double sigma);
  void StartAnywhere();
  // This camera's pixels per scout's, as an earlier run knew it.
  void KnowMagnification(double magnification, int width_px);

  void Move(const FrameMotion& moved);
  // By so many features that are tracked the robot is there; nothing: they do not tell. Counts in
  // the next look.
  void SetTracked(const std::optional<RoutePoint>& point, int agreed);
  // Compares a frame with the key views that are worth it; `width_px` as Recogniser::LookAt has it.
  // The next frame's look says more the more the picture has changed until then.
  void LookAt(const image::GrayImage& picture, int width_px);
  [[nodiscard]] const Look& look() const { return look_; }  // the last one
  // The features that agree in this frame with the view that is recognised best about the place; 0
  // where it was not looked at.
  [[nodiscard]] int agreed_now() const;
  // Once the robot has come some way since the last, and always while the place is not held.
  [[nodiscard]] bool LookIsDue() const;

  // The picture has moved so far since the last look that another one tells more.
  [[nodiscard]] bool HasMoved() const { return new_since_look_ >= kLeastNew; }

  // Of any picture: the features that agree in it with one of the views about the place. Moves no
  // belief.
  [[nodiscard]] int AgreedIn(const image::GrayImage& picture) const;

  // How the scout's picture at that point maps onto this frame; nothing: it is not recognised.
  [[nodiscard]] std::optional<vision::ViewFit> Recognise(const image::GrayImage& frame,
                                                         const RoutePoint& point);

  [[nodiscard]] const belief::RouteBelief& belief() const { return place_.belief(); }
  [[nodiscard]] const belief::RouteBelief::Place& where() const { return belief().place(); }
  [[nodiscard]] RoutePoint point() const { return place_.PointAt(where().along); }
  [[nodiscard]] RoutePoint PointAt(double along) const { return place_.PointAt(along); }
  [[nodiscard]] double AlongOf(const RoutePoint& point) const { return place_.AlongOf(point); }
  [[nodiscard]] bool metric() const { return place_.metric(); }
  // How far odometry is believed against what else tells how the robot moves, 0 to 1; nothing: it
  // has none.
  [[nodiscard]] std::optional<double> TrustInOdometry() const;
  // Metres of the route for each that the robot is measured or told to come.
  [[nodiscard]] double ScaleOfWay() const { return belief().ScaleOf(0); }
  // How far the scout came in so long a time where the robot is.
  [[nodiscard]] double PaceAt_m(double dt_s) const;
  [[nodiscard]] const Recogniser& recogniser() const { return recogniser_; }
  // This camera's pixels per scout's; nothing before it was seen.
  [[nodiscard]] std::optional<double> Magnification(int width_px) const;

 private:
  static constexpr double kLeastNew = 0.08;  // of a new look

  Recogniser recogniser_;
  RoutePlace place_;
  std::optional<belief::TrackedPlace> tracked_;
  Look look_;
  double new_since_look_ = 1.0;  // how much of a new look the next one is
  bool looked_ = false;          // since the last Move
  bool by_odometry_ = false;     // the belief's first witness is odometry
};

}  // namespace trailcast::agent
