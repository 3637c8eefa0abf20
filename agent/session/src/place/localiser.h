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

// This is how a robot moved since the last frame.
struct FrameMotion {
  // These are along the route, by odometry and by the commands to the base, as far as there are
  // any.
  std::optional<motion::OdometryIncrement> odometry;
  std::optional<motion::OdometryIncrement> told;
  double flow = 0.0;  // of most features in the picture, as a share of its width
  double dt_s = 0.0;
  double unknown_m = 0.0;  // in either direction, beside the rest
  bool frozen = false;     // odometry stands still while the picture moves
};

// This keeps the belief in a robot's place on a route (route_belief.h) up to date with its motion
// and with the route's key views that its camera shows. No clock.
class Localiser {
 public:
  explicit Localiser(int scout_width_px) : recogniser_(scout_width_px) {}

  // Takes segments in order from the route's first on.
  void Learn(const route::Segment& segment);
  [[nodiscard]] bool known() const { return place_.known(); }

  // Starts around that place, in the route's units (RoutePlace::metric), or anywhere.
  void StartAt(double along, double sigma);
  void StartAnywhere();
  // Sets this camera's pixels for each of the scout's, as an earlier run knew it.
  void KnowMagnification(double magnification, int width_px);

  void Move(const FrameMotion& moved);
  // Sets that so many tracked features put the robot there, or that they do not tell. It counts in
  // the next look.
  void SetTracked(const std::optional<RoutePoint>& point, int agreed);
  // Compares a frame with the key views that are worth it. `width_px` is as for Recogniser::LookAt.
  // The next frame's look tells more the more the picture has changed until then.
  void LookAt(const image::GrayImage& picture, int width_px);
  [[nodiscard]] const Look& look() const { return look_; }  // the last one
  // Returns how many features agree in this frame with the view that is recognised best around the
  // place, or 0 without a look.
  [[nodiscard]] int agreed_now() const;
  // Tells that the robot has come some distance since the last look, or that the place is not held.
  [[nodiscard]] bool LookIsDue() const;

  // Tells that the picture has moved far enough since the last look that another one tells more.
  [[nodiscard]] bool HasMoved() const { return new_since_look_ >= kLeastNew; }

  // Returns how many features of any picture agree with one of the views around the place. It moves
  // no belief.
  [[nodiscard]] int AgreedIn(const image::GrayImage& picture) const;

  // Returns how the scout's picture at that point maps onto this frame, or nothing if it is not
  // recognised.
  [[nodiscard]] std::optional<vision::ViewFit> Recognise(const image::GrayImage& frame,
                                                         const RoutePoint& point);

  [[nodiscard]] const belief::RouteBelief& belief() const { return place_.belief(); }
  [[nodiscard]] const belief::RouteBelief::Place& where() const { return belief().place(); }
  [[nodiscard]] RoutePoint point() const { return place_.PointAt(where().along); }
  [[nodiscard]] RoutePoint PointAt(double along) const { return place_.PointAt(along); }
  [[nodiscard]] double AlongOf(const RoutePoint& point) const { return place_.AlongOf(point); }
  [[nodiscard]] bool metric() const { return place_.metric(); }
  // Returns how far odometry is trusted, 0 to 1, against other evidence of the motion, or nothing
  // without odometry.
  [[nodiscard]] std::optional<double> TrustInOdometry() const;
  // Returns metres of the route for each metre that the robot measures or is commanded.
  [[nodiscard]] double ScaleOfWay() const { return belief().ScaleOf(0); }
  // Returns how far the scout came in this time at the robot's place.
  [[nodiscard]] double PaceAt_m(double dt_s) const;
  [[nodiscard]] const Recogniser& recogniser() const { return recogniser_; }
  // Returns this camera's pixels for each of the scout's, or nothing before it was seen.
  [[nodiscard]] std::optional<double> Magnification(int width_px) const;

 private:
  static constexpr double kLeastNew = 0.08;  // share of a new look

  Recogniser recogniser_;
  RoutePlace place_;
  std::optional<belief::TrackedPlace> tracked_;
  Look look_;
  double new_since_look_ = 1.0;  // how much of a new look the next one is
  bool looked_ = false;          // since the last Move
  bool by_odometry_ = false;     // odometry is the belief's first witness
};

}  // namespace trailcast::agent
