#pragma once

#include <optional>
#include <string>

#include "agent/session/src/eyes.h"
#include "agent/session/src/place/place_keeper.h"

namespace trailcast::agent {

// Tells that a robot's camera is mounted upside down, or on its side, against the one that taught:
// its pictures are not recognised as they are, and clearly are once they are turned. A robot that
// has recognised the route upright is looked at no more. No clock.
class UprightWatch {
 public:
  // Of the next frame, at the place that is believed: by how many degrees clockwise its pictures
  // are to be turned to be as the scout's. Nothing: by none, as far as is known.
  [[nodiscard]] std::optional<double> Look(const Seen& seen, const PlaceKeeper& place);
  // After Look has told: what was seen, one line for people.
  [[nodiscard]] std::string Text() const;
  // It was recognised, as it is or once it was turned.
  [[nodiscard]] bool upright() const { return upright_; }

 private:
  bool upright_ = false;
  int frames_ = 0;
  double watched_s_ = 0.0;
  // Of the last frame looked at: the turn by which it was recognised, 0 if by none, how many
  // features agreed then, and as it was.
  double turn_deg_ = 0.0;
  int agreed_ = 0;
  int as_it_is_ = 0;
};

}  // namespace trailcast::agent
