#pragma once

#include <optional>

#include "services/image/image.h"
#include "services/odometry/drive_step.h"
#include "services/route/usual_camera.h"
#include "services/vision/feature_tracker.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

// Measures how a camera's picture moves from frame to frame.
class PictureSteps {
 public:
  // `focal_share` is the camera's focal length as a share of its picture's width.
  explicit PictureSteps(const vision::IntakeOptions& intake,
                        double focal_share = route::kUsualFocalShare)
      : intake_(intake), focal_share_(focal_share) {}

  // Returns the step since the frame before, or nothing if the two have too little in common.
  [[nodiscard]] std::optional<odometry::PictureStep> Add(const image::GrayImage& frame);

  // Returns the last picture as the intake made it. Needs one.
  [[nodiscard]] const image::GrayImage& picture() const { return *picture_; }
  [[nodiscard]] double focal_share() const { return focal_share_; }

 private:
  vision::PictureIntake intake_;
  vision::FeatureTracker tracker_;
  double focal_share_;
  const image::GrayImage* picture_ = nullptr;
};

}  // namespace trailcast::agent
