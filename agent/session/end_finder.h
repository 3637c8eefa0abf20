#pragma once

#include <string>

#include "agent/session/hand_over.h"
#include "services/image/image.h"
#include "services/route/route.h"
#include "services/vision/picture_intake.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {

// This tells when a scout's robot is where an earlier teaching by the same camera ended: its last
// segment's features are where they were last seen, as large as they were, and the view as a whole
// is recognised. It uses no clock, socket, lock or disk.
class EndFinder {
 public:
  // `last` is the last segment of the teaching. Without features its end is never found. `width_px`
  // is the route's.
  EndFinder(route::Segment last, int width_px, const vision::IntakeOptions& intake = {});

  // Returns true if this picture was taken there, as far as pictures can show.
  [[nodiscard]] bool Look(const image::GrayImage& picture);
  // Returns for people the most features that one picture had.
  [[nodiscard]] std::string MostSeen() const;

 private:
  route::Segment last_;
  HandOver hand_over_;
  vision::PictureIntake intake_;
  vision::ViewDescriber describer_;
  vision::FindResult most_seen_;
};

}  // namespace trailcast::agent
