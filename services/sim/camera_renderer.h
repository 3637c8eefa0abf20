#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "services/sim/camera.h"
#include "services/sim/view_tracer.h"
#include "services/sim/world.h"

namespace trailcast::sim {

// What a perfect camera would see: no noise, no blur, not yet cut to 8 bits. Row-major, one entry a
// pixel; outside the lens's picture grey is 0 and depth that of the sky.
struct PerfectView {
  int width = 0;
  int height = 0;
  std::vector<float> gray;
  std::vector<float> depth_m;  // along the pixel's ray
};

// One camera's rays, computed once, and its pictures of a world. Not for several threads at once.
class CameraRenderer {
 public:
  // `camera` must be valid. `lighting` stands in for the world's own (a sun that has moved).
  CameraRenderer(std::shared_ptr<const World> world, const CameraModel& camera,
                 const Lighting& lighting);
  CameraRenderer(const std::shared_ptr<const World>& world, const CameraModel& camera)
      : CameraRenderer(world, camera, world->lighting()) {}

  // The view from `world_from_camera` (camera frame: x right, y down, z ahead). The result is
  // overwritten by the next call.
  [[nodiscard]] const PerfectView& Render(const Eigen::Isometry3d& world_from_camera);

  [[nodiscard]] const Lens& lens() const { return lens_; }
  [[nodiscard]] bool InPicture(int x, int y) const { return rays_[Index(x, y)].valid; }

 private:
  struct PixelRay {
    Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();
    float spread = 0.0F;                 // radians that the pixel covers
    Eigen::Vector3f to_right, to_below;  // change of direction for one pixel
    bool valid = false;
  };
  [[nodiscard]] std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] PixelRay MakeRay(int x, int y) const;
  void RenderBlock(int x0, int y0);
  [[nodiscard]] bool OnOnePlane(std::size_t a, std::size_t b) const;
  void FindEdges();
  void SmoothEdges();

  std::shared_ptr<const World> world_;
  Lens lens_;
  ViewTracer tracer_;
  std::vector<PixelRay> rays_;
  PerfectView view_;
  std::vector<std::uint32_t> surface_;  // seen by each pixel
  std::vector<std::size_t> edges_;      // pixels to be sampled more finely
  Eigen::Matrix3f rotation_;            // of the camera being rendered
  RayPacket packet_;
};

}  // namespace trailcast::sim
