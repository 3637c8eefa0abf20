#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "services/base/time.h"
#include "services/image/image.h"
#include "services/route/tracked_feature.h"
#include "services/teach/picture_turn.h"
#include "services/vision/feature_tracker.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

// Does what StillWatch does, with the pictures of a robot that has no odometry. Each picture is
// compared with one from about a second before, and the motion since the robot last drove is added
// up. A slow drive therefore shows in the end, and somebody who walks through the picture only
// hides what is behind him meanwhile. If too little is visible to measure a drive, the robot does
// not count as standing. Pictures of which half shows the robot itself tell nothing.
class StillPictureWatch {
 public:
  // With a `limit` of 0 it is never over.
  explicit StillPictureWatch(std::chrono::milliseconds limit) : limit_(limit) {}

  // Takes each frame. One whose size differs from the first tells nothing.
  [[nodiscard]] bool Over(SensorTime stamp, const image::GrayImage& camera);

 private:
  enum class Verdict { kStands, kMoves, kUnclear };
  struct Look {
    Verdict verdict = Verdict::kUnclear;
    double seen = 0.0;        // share of the kept picture that moved as one
    teach::PictureFlow flow;  // since the kept picture
    double growth2 = 0.0;     // variance of its growth
  };
  // The tracker's last frame is the kept picture before this, and `picture` after it.
  [[nodiscard]] Look Compare(const image::GrayImage& picture);
  // Keeps the tracker's last frame.
  void Keep(const image::GrayImage& picture, SensorTime stamp);

  std::chrono::milliseconds limit_;
  vision::PictureIntake intake_;
  vision::FeatureTracker tracker_;
  vision::PictureSize camera_;  // its pictures' size
  image::GrayImage kept_;       // the picture to compare with
  SensorTime kept_at_{};
  std::vector<route::TrackedFeature> features_;  // in it
  SensorTime since_{};                           // when the robot last moved
  teach::PictureFlow came_;                      // from that picture to the kept one
  double came_growth2_ = 0.0;                    // variance of its growth
  SensorTime stood_at_{};                        // when the kept picture was last seen again
  std::optional<SensorTime> looked_at_;
  bool moved_ = false;
};

}  // namespace trailcast::agent
