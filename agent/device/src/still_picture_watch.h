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

// What StillWatch tells by odometry, told by the pictures of a robot that has none. Each is held
// against one from about a second before, and what the picture moved by is added up since the robot
// last drove: a slow drive shows in the end, and whoever walks through the picture hides what is
// behind him for as long as he is before it. Where too little is seen to measure a drive by, a
// robot is not called standing. Pictures of which half shows the robot itself do not tell.
class StillPictureWatch {
 public:
  // 0: it never is over.
  explicit StillPictureWatch(std::chrono::milliseconds limit) : limit_(limit) {}

  // At each frame. One of another size than the first tells nothing.
  [[nodiscard]] bool Over(SensorTime stamp, const image::GrayImage& camera);

 private:
  enum class Verdict { kStands, kMoves, kUnclear };
  struct Look {
    Verdict verdict = Verdict::kUnclear;
    double seen = 0.0;        // of the kept picture: the share that moved as one
    teach::PictureFlow flow;  // since the kept picture
    double growth2 = 0.0;     // how sure its growth is: a variance
  };
  // The tracker's last frame is the kept picture before it, and this one after.
  [[nodiscard]] Look Compare(const image::GrayImage& picture);
  // Of the tracker's last frame, from now on.
  void Keep(const image::GrayImage& picture, SensorTime stamp);

  std::chrono::milliseconds limit_;
  vision::PictureIntake intake_;
  vision::FeatureTracker tracker_;
  vision::PictureSize camera_;  // of its pictures
  image::GrayImage kept_;       // that the others are held against
  SensorTime kept_at_{};
  std::vector<route::TrackedFeature> features_;  // in it
  SensorTime since_{};                           // when the robot last moved
  teach::PictureFlow came_;                      // from that picture to the kept one
  double came_growth2_ = 0.0;                    // how sure its growth is: a variance
  SensorTime stood_at_{};                        // when the kept picture was last seen again
  std::optional<SensorTime> looked_at_;
  bool moved_ = false;
};

}  // namespace trailcast::agent
