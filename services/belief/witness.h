#pragma once

#include <vector>

#include "services/belief/moved_grid.h"

namespace trailcast::belief {

// This is one witness's account of how the robot moved since the last call, along the route, in the
// route's units.
struct Motion {
  double along = 0.0;
  double sigma = 0.0;
  // It was not measured: the robot went about this far forward, but standing, or several times as
  // far, is as likely. `sigma` is not used then.
  bool guessed = false;
  bool sensed = false;  // by the robot's own sensors, as odometry is
};

// This is one of several hypotheses of how the robot moves, with the part of the belief that holds
// if this witness is right. Pictures weigh all parts alike, so a witness that contradicts them
// loses its mass to the others (interacting multiple models: Blom & Bar-Shalom, IEEE Transactions
// on Automatic Control 33(8), 1988, over a histogram instead of Kalman filters).
class Witness {
 public:
  explicit Witness(double cell) : grid_(cell) {}

  [[nodiscard]] MovedGrid& grid() { return grid_; }
  [[nodiscard]] const MovedGrid& grid() const { return grid_; }

  // `diffusion` is of the place, per root unit along, beside the motion's own sigma.
  void Move(const Motion& motion, double diffusion);
  // Notes that the place was held at the last look and at this one, and moved by `come` between
  // them. `trust` says how far this witness is believed.
  void NoteWay(double come, bool drives_backwards, double trust);
  // Notes that the place was held at only one of them, or at neither, or jumped.
  void NoteGap(bool held);

  // Returns how far the robot comes for each unit that this witness tells.
  [[nodiscard]] double scale() const { return scale_; }

 private:
  void LearnPace(double come, double moved, bool drives_backwards);
  void LearnScale(double come, double moved, double trust);

  MovedGrid grid_;
  bool guesses_ = false;
  double scale_ = 1.0;
  double scale_sigma_ = 0.2;  // of a measured motion
  double moved_ = 0.0;        // by the witness, since the last look
  // These count since the scale was last measured: by the witness, and along the route.
  double told_ = 0.0;
  double came_ = 0.0;
  std::vector<double> doubted_scales_;  // the last ones, measured while it was not trusted
};

}  // namespace trailcast::belief
