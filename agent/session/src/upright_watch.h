#pragma once

#include <string>

#include "agent/session/src/eyes.h"
#include "agent/session/src/place/place_keeper.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

// Tells that a robot's camera is mounted upside down, or on its side, against the one that taught:
// its pictures are not recognised as they are, and clearly are once they are turned. A robot that
// has recognised the route upright is looked at no more. No clock.
class UprightWatch {
 public:
  // `told`: how the camera is said to be mounted.
  explicit UprightWatch(const vision::IntakeOptions& told) : told_(told) {}

  // Of the next frame, at the place that is believed. True, once and for all: it is mounted
  // otherwise.
  [[nodiscard]] bool Look(const Seen& seen, const PlaceKeeper& place);
  [[nodiscard]] bool misturned() const { return misturned_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }  // one line for people

 private:
  vision::IntakeOptions told_;
  bool upright_ = false;
  bool misturned_ = false;
  int frames_ = 0;
  double watched_s_ = 0.0;
  double turn_deg_ = 0.0;  // by which the last frame looked at was recognised; 0: by none
  std::string reason_;
};

}  // namespace trailcast::agent
