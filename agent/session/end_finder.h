#pragma once

#include <string>

#include "agent/session/hand_over.h"
#include "services/image/image.h"
#include "services/route/route.h"
#include "services/vision/picture_intake.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {

// Tells when a scout's robot is where an earlier teaching by the same camera ended: its last
// segment's features are where they were last seen, as large as they were, and the view as a whole
// is recognised. No clock, socket, lock or disk.
class EndFinder {
 public:
  // `last`: of the teaching; with features, or its end is never found. `width_px`: the route's.
  EndFinder(route::Segment last, int width_px, const vision::IntakeOptions& intake = {});

  // True: this picture was taken there, give or take what shows in no picture.
  [[nodiscard]] bool Look(const image::GrayImage& picture);
  // For people: the most that was found of them in one picture.
  [[nodiscard]] std::string MostSeen() const;

 private:
  route::Segment last_;
  HandOver hand_over_;
  vision::PictureIntake intake_;
  vision::ViewDescriber describer_;
  vision::FindResult most_seen_;
};

}  // namespace trailcast::agent
