#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "services/lab/sim/core/camera.h"
#include "services/lab/sim/core/view_tracer.h"
#include "services/lab/sim/core/world.h"

namespace trailcast::sim {

// The camera's motion while it takes a picture, in its own frame (x right, y down, z ahead).
struct CameraMotion {
  Eigen::Vector3d linear_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_radps = Eigen::Vector3d::Zero();
};

// The view of a perfect camera, without noise or blur, and not yet cut to 8 bits. It is row-major
// with one entry a pixel. Outside the lens's picture, grey is 0 and depth is the sky's.
struct PerfectView {
  int width = 0;
  int height = 0;
  std::vector<float> gray;
  std::vector<float> depth_m;  // along the pixel's ray
  // The pixels that see something that moves by itself.
  struct Mover {
    std::size_t pixel = 0;
    Eigen::Vector3f velocity_mps;  // camera frame
  };
  std::vector<Mover> movers = {};
};

// Renders one camera's pictures of a world, with rays that are computed once. It is not
// thread-safe.
class CameraRenderer {
 public:
  // `camera` must be valid. `lighting` replaces the world's own, for a sun that has moved.
  CameraRenderer(std::shared_ptr<const World> world, const CameraModel& camera,
                 const Lighting& lighting);
  CameraRenderer(const std::shared_ptr<const World>& world, const CameraModel& camera)
      : CameraRenderer(world, camera, world->lighting()) {}

  // Renders the view from `world_from_camera` (camera frame: x right, y down, z ahead) with
  // `actors` in the world. A camera with a rolling shutter sees its last row from there, and has
  // seen the upper ones earlier, by `motion`. The next call overwrites the result.
  [[nodiscard]] const PerfectView& Render(const Eigen::Isometry3d& world_from_camera,
                                          std::span<const PlacedPart> actors = {},
                                          const CameraMotion& motion = {});

  [[nodiscard]] const Lens& lens() const { return lens_; }
  [[nodiscard]] bool InPicture(int x, int y) const { return rays_.spread[Index(x, y)] > 0.0F; }

 private:
  // One entry a pixel, row-major, in the camera's frame.
  struct Rays {
    std::vector<float> x, y, z;  // unit vectors
    std::vector<float> spread;   // radians that the pixel covers; 0 outside the lens's picture
  };
  // Four pixels meet at a corner, which has the index of the lower right one.
  using Four = std::array<std::size_t, 4>;
  struct Edge {
    std::size_t pixel = 0;
    Four corners{};
  };
  [[nodiscard]] std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] Eigen::Vector3f Direction(std::size_t pixel) const {
    return {rays_.x[pixel], rays_.y[pixel], rays_.z[pixel]};
  }
  struct Pose {  // world from camera
    Eigen::Matrix3f rotation;
    Eigen::Vector3f origin;
  };
  [[nodiscard]] Pose PoseAtRow(int y) const;
  void MakeRay(int x, int y);
  void RenderBlock(int x0, int y0);
  [[nodiscard]] std::uint32_t MaterialOf(std::uint32_t surface) const;
  void NoteMovers();
  [[nodiscard]] bool OnOnePlane(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool IsEdge(int x, int y) const;
  void FindEdges();
  [[nodiscard]] Four CornersOf(int x, int y) const;
  [[nodiscard]] Four PixelsRound(std::size_t corner) const;
  void AddCorner(std::size_t corner);
  [[nodiscard]] float Borrow(std::size_t corner, std::uint32_t surface, float depth_m) const;
  void TraceCorners();
  void SmoothEdges();

  std::shared_ptr<const World> world_;
  Lens lens_;
  ViewTracer tracer_;
  Rays rays_;
  PerfectView view_;
  std::vector<std::uint32_t> surface_;   // seen by each pixel, its complement if in shadow
  std::vector<std::uint32_t> material_;  // seen by each pixel, or its complement in shadow
  std::vector<Edge> edges_;              // pixels to sample more finely
  std::vector<std::size_t> corners_;     // their corners that need a ray
  std::vector<float> corner_gray_;
  double readout_s_;
  CameraMotion motion_;
  Pose now_;  // of the last row of the picture being rendered
};

}  // namespace trailcast::sim
