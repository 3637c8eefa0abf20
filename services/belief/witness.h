#pragma once

#include <vector>

#include "services/belief/moved_grid.h"

namespace trailcast::belief {

// How the robot moved since the last call, along the route, in the route's units, as one witness
// tells it.
struct Motion {
  double along = 0.0;
  double sigma = 0.0;
  // Nobody measured it: about this far forward, but standing or up to some times as much is as
  // likely. `sigma` is then of no interest.
  bool guessed = false;
};

// One of several hypotheses of how the robot moves, with the part of the belief that holds if this
// witness is right. What the pictures show weighs all parts alike, so a witness that contradicts
// them loses its mass to the others (interacting multiple models: Blom & Bar-Shalom, IEEE
// Transactions on Automatic Control 33(8), 1988, over a histogram instead of Kalman filters).
class Witness {
 public:
  explicit Witness(double cell) : grid_(cell) {}

  [[nodiscard]] MovedGrid& grid() { return grid_; }
  [[nodiscard]] const MovedGrid& grid() const { return grid_; }

  // `diffusion`: of the place, per root unit along, besides the motion's own sigma.
  void Move(const Motion& motion, double diffusion);
  // The place was held at the last look and at this one, and came so far between them. `trust`: how
  // far this witness is believed.
  void NoteWay(double come, bool drives_backwards, double trust);
  // It was held at one of them only, or not at all, or jumped.
  void NoteGap(bool held);

  // How far the robot comes for each unit that this witness tells.
  [[nodiscard]] double scale() const { return scale_; }

 private:
  void LearnPace(double come, double moved, bool drives_backwards);
  void LearnScale(double come, double moved, double trust);

  MovedGrid grid_;
  bool guesses_ = false;
  double scale_ = 1.0;
  double scale_sigma_ = 0.2;  // of a measured way
  double moved_ = 0.0;        // as it was told, since the last look
  // Since the scale was last measured: as it was told, and along the route.
  double told_ = 0.0;
  double came_ = 0.0;
  std::vector<double> doubted_scales_;  // the last ones measured while it was not believed
};

}  // namespace trailcast::belief
