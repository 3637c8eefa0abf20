#pragma once

#include <optional>
#include <string>

#include "agent/session/src/front_end.h"
#include "agent/session/src/place/localiser.h"

namespace trailcast::agent {

// This tells that a robot's camera is mounted upside down, or on its side, relative to the scout's:
// its pictures are not recognised as they are, and clearly are once they are turned. A robot that
// has recognised the route upright is no longer examined. No clock.
class UprightWatch {
 public:
  // Returns for the next frame, at the believed place, by how many degrees clockwise pictures have
  // to be turned to be like the scout's, or nothing if by none, as far as is known.
  [[nodiscard]] std::optional<double> Look(const FrameInput& seen, const Localiser& place);
  // Returns what was seen, in one line for people, after Look has told.
  [[nodiscard]] std::string Text() const;
  // Tells that it was recognised, as it is or once it was turned.
  [[nodiscard]] bool upright() const { return upright_; }

 private:
  bool upright_ = false;
  int frames_ = 0;
  double watched_s_ = 0.0;
  // These are of the last frame examined: the turn by which it was recognised, 0 if by none, how
  // many features agreed then, and how many without a turn.
  double turn_deg_ = 0.0;
  int agreed_ = 0;
  int as_it_is_ = 0;
};

}  // namespace trailcast::agent
