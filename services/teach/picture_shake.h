#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "services/base/time.h"
#include "services/route/tracked_feature.h"
#include "services/teach/driven_window.h"

namespace trailcast::teach {

// How far features shake up and down together: that of each goes its own way as the robot comes
// closer, smoothly; by what all of them suddenly do, the camera nods. What is slower than about
// half a second is left out, which is the path's and not the ground's; so is, below 4 frames a
// second or so, all that shakes.
class PictureShake {
 public:
  // Of the picture in whose pixels the features are.
  explicit PictureShake(int height_px) : height_px_(height_px) {}

  // Other features from now on, as they are in the last image.
  void Begin(const std::vector<route::TrackedFeature>& features);
  // Where those that are left are in the next image. `drives`: counts for the segment.
  void Add(SensorTime stamp, const std::vector<route::TrackedFeature>& features, bool drives);

  // RMS, as a share of the picture's height. Nothing: too few features, or too little was driven.
  [[nodiscard]] std::optional<double> Measure() const;
  void EndSegment() { window_.Cut(); }

 private:
  struct Motion {
    double v_px = 0.0;
    std::optional<double> rate_px_per_s{};
  };
  void Nod(double rate_change_px_per_s, double dt_s);

  int height_px_;
  std::unordered_map<int, Motion> features_;  // by id
  std::optional<SensorTime> last_;
  // How fast and how far it has nodded, both forgotten over time.
  double rate_px_per_s_ = 0.0;
  double nod_px_ = 0.0;
  double seen_s_ = 0.0;  // since it began to sum up
  DrivenWindow window_;
};

}  // namespace trailcast::teach
