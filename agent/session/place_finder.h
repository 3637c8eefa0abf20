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

// This is where an earlier run has left the robot, or where an operator says that it stands.
struct LeftAt {
  double along_m = 0.0;  // along the route
  // This is the robot's pixels for each of the scout's, as that run knew it. It is empty if
  // unknown.
  std::optional<double> magnification{};
};

// This tells whether a robot that stands is where it was left, or up to a metre and a half further,
// or back at the route's start, by the features that were taught there. It looks at one place a
// frame, by turns, and takes the likeliest of those that are in view. If an operator told the
// place, it takes the first place around there and no other. If the magnification is not known,
// which a place further on would explain as well as another camera, it tries all.
class PlaceFinder {
 public:
  struct Found {
    SegmentIndex segment;
    double fraction = 0.0;  // share of the segment
    vision::FindResult seen;
  };

  explicit PlaceFinder(const LeftAt& left) : told_(!left.magnification), left_(left) {}

  // Sets what the robot's own lens implies, before it looks.
  void KnowMagnification(double magnification) { left_.magnification = magnification; }

  // `segments` begin with the route's first, as far as they are known. `recognised_m` is where
  // along the route the view as a whole is recognised: there, fewer features are proof enough.
  [[nodiscard]] std::optional<Found> Look(const image::GrayImage& frame,
                                          std::span<const route::Segment> segments,
                                          const HandOver& hand_over,
                                          std::optional<double> recognised_m = std::nullopt);

  // Tells that it has looked often enough: the robot is at neither.
  [[nodiscard]] bool given_up() const { return rounds_ >= kRounds; }
  // Returns for people the most that it found of any of these places.
  [[nodiscard]] std::string MostSeen() const;
  // Tells that an operator said that it stands there, rather than an earlier run.
  [[nodiscard]] bool told() const { return told_; }
  [[nodiscard]] const LeftAt& left() const { return left_; }

 private:
  static constexpr int kRounds = 3;

  // Returns what is seen of that place, if it is on the route.
  [[nodiscard]] std::optional<Found> LookFrom(const image::GrayImage& frame,
                                              std::span<const route::Segment> segments,
                                              const HandOver& hand_over, double along_m);
  [[nodiscard]] double Likeness(const Found& found) const;

  bool told_;
  LeftAt left_;
  std::size_t turn_ = 0;
  int rounds_ = 0;
  std::optional<Found> likest_;     // in this round
  std::optional<Found> most_seen_;  // in all rounds
};

}  // namespace trailcast::agent
