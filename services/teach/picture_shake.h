#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "services/base/time.h"
#include "services/route/tracked_feature.h"
#include "services/teach/driven_window.h"

namespace trailcast::teach {

// This measures how far features shake up and down together. Each feature moves smoothly on its own
// as the robot comes closer; a sudden motion of all of them shows that the camera nods. It omits
// what is slower than about half a second, as that is the path's and not the ground's. Below about
// 4 frames a second it omits all shaking, too.
class PictureShake {
 public:
  // `height_px` is the height of the picture in whose pixels the features are.
  explicit PictureShake(int height_px) : height_px_(height_px) {}

  // Replaces the features by others, as they are in the last image.
  void Begin(const std::vector<route::TrackedFeature>& features);
  // Adds the places of the remaining features in the next image. They count for the segment if the
  // robot `drives`.
  void Add(SensorTime stamp, const std::vector<route::TrackedFeature>& features, bool drives);

  // Returns the RMS as a share of the picture's height. Returns nothing with too few features, or
  // if the robot drove too little.
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
  // These are how fast and how far the camera has nodded. Both are forgotten over time.
  double rate_px_per_s_ = 0.0;
  double nod_px_ = 0.0;
  double seen_s_ = 0.0;  // since the sums began
  DrivenWindow window_;
};

}  // namespace trailcast::teach
