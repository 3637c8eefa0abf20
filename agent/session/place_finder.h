#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "agent/session/hand_over.h"
#include "services/image/image.h"
#include "services/route/route.h"
#include "services/vision/feature_finder.h"

namespace trailcast::agent {

// Where an earlier run has left the robot, or where somebody says that it stands.
struct LeftAt {
  double along_m = 0.0;  // of the route
  // This robot's pixels per scout's, as that run knew it; nothing: nobody knows it.
  std::optional<double> magnification{};
};

// Tells whether a robot that stands is where it was left, or up to a metre and a half further, or
// else back at the route's start, by the features that were taught there. One place a frame, by
// turns, and of those that are in view the likest. Of one that is told where it stands: the first
// place about there, and no other; where the magnification is not known, which a place further on
// would explain as well as another camera, at any.
class PlaceFinder {
 public:
  struct Found {
    SegmentIndex segment;
    double fraction = 0.0;  // of the segment
    vision::FindResult seen;
  };

  explicit PlaceFinder(const LeftAt& left) : told_(!left.magnification), left_(left) {}

  // Before it looks: what this robot's lens says of it, which it was not told.
  void KnowMagnification(double magnification) { left_.magnification = magnification; }

  // `segments`: from the route's first on, as far as they are known. `recognised_m`: where along
  // the route the view as a whole is recognised: there, fewer features are proof enough.
  [[nodiscard]] std::optional<Found> Look(const image::GrayImage& frame,
                                          std::span<const route::Segment> segments,
                                          const HandOver& hand_over,
                                          std::optional<double> recognised_m = std::nullopt);

  // It has looked often enough: the robot is at neither.
  [[nodiscard]] bool given_up() const { return rounds_ >= kRounds; }
  // For people: the most that it found of any of these places.
  [[nodiscard]] std::string MostSeen() const;
  // Somebody says that it stands there, rather than an earlier run.
  [[nodiscard]] bool told() const { return told_; }
  [[nodiscard]] const LeftAt& left() const { return left_; }

 private:
  static constexpr int kRounds = 3;

  // What is seen of that place, if it is on the route.
  [[nodiscard]] std::optional<Found> LookFrom(const image::GrayImage& frame,
                                              std::span<const route::Segment> segments,
                                              const HandOver& hand_over, double along_m);
  [[nodiscard]] double Likeness(const Found& found) const;

  bool told_;
  LeftAt left_;
  std::size_t turn_ = 0;
  int rounds_ = 0;
  std::optional<Found> likest_;     // of this round
  std::optional<Found> most_seen_;  // ever
};

}  // namespace trailcast::agent
