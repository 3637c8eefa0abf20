#include "services/sim/camera_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trailcast::sim {
namespace {

// Blocks of 4 x 2 pixels keep the eight rays of a packet together.
constexpr int kBlockWidth = 4;
constexpr int kBlockHeight = 2;
// Neighbours on different triangles that differ by less (grey levels) need no finer sampling.
constexpr float kVisibleEdge = 8.0F;
// Places looked at inside an edge pixel besides its middle: a triangle turned so that level and
// upright edges get four grey steps.
constexpr std::array<std::array<float, 2>, 3> kSubPixels = {
    {{0.386F, 0.104F}, {-0.283F, 0.283F}, {-0.104F, -0.386F}}};

}  // namespace

CameraRenderer::CameraRenderer(std::shared_ptr<const World> world, const CameraModel& camera,
                               const Lighting& lighting)
    : world_(std::move(world)), lens_(camera), tracer_(*world_, lighting) {
  view_.width = camera.width;
  view_.height = camera.height;
  const std::size_t pixels = Index(0, camera.height);
  view_.gray.resize(pixels);
  view_.depth_m.resize(pixels);
  surface_.resize(pixels);
  rays_.reserve(pixels);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) rays_.push_back(MakeRay(x, y));
  }
}

CameraRenderer::PixelRay CameraRenderer::MakeRay(int x, int y) const {
  PixelRay ray;
  const Eigen::Vector2d pixel(x, y);
  const auto direction = lens_.Direction(pixel);
  if (!direction) return ray;
  ray.valid = true;
  ray.direction = direction->cast<float>();
  // One-sided at the rim of the lens's picture.
  const auto change = [&](const Eigen::Vector2d& step) -> Eigen::Vector3f {
    if (const auto next = lens_.Direction(pixel + step)) {
      return (*next - *direction).cast<float>();
    }
    if (const auto last = lens_.Direction(pixel - step)) {
      return (*direction - *last).cast<float>();
    }
    return Eigen::Vector3f::Zero();
  };
  ray.to_right = change({1.0, 0.0});
  ray.to_below = change({0.0, 1.0});
  ray.spread = std::sqrt(ray.to_right.norm() * ray.to_below.norm());
  return ray;
}

void CameraRenderer::RenderBlock(int x0, int y0) {
  std::array<std::size_t, RayPacket::kSize> pixels{};
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    const int x = x0 + static_cast<int>(i) % kBlockWidth;
    const int y = y0 + static_cast<int>(i) / kBlockWidth;
    const bool inside = x < view_.width && y < view_.height;
    pixels[i] = Index(std::min(x, view_.width - 1), std::min(y, view_.height - 1));
    const PixelRay& ray = rays_[pixels[i]];
    packet_.valid[i] = inside && ray.valid;
    packet_.directions[i] = rotation_ * ray.direction;
    packet_.spreads[i] = ray.spread;
  }
  const auto seen = tracer_.Trace(packet_);
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    if (!packet_.valid[i]) continue;
    view_.gray[pixels[i]] = seen[i].gray;
    view_.depth_m[pixels[i]] = seen[i].depth_m;
    // A shadow's edge is an edge as well: lit and shaded parts count as different surfaces.
    surface_[pixels[i]] = seen[i].in_shadow ? ~seen[i].surface : seen[i].surface;
  }
}

// Neighbouring triangles of one material in one plane: what differs there is the texture, which is
// filtered already.
bool CameraRenderer::OnOnePlane(std::size_t a, std::size_t b) const {
  const auto count = static_cast<std::uint32_t>(world_->surfaces().size());
  if (surface_[a] >= count || surface_[b] >= count) return false;  // sky or shadow
  const Surface& first = world_->surfaces()[surface_[a]];
  const Surface& second = world_->surfaces()[surface_[b]];
  if (first.material != second.material) return false;
  if (std::abs(first.normal.dot(second.normal)) < 0.9998F) return false;
  const Eigen::Vector3f step =
      view_.depth_m[a] * rays_[a].direction - view_.depth_m[b] * rays_[b].direction;
  const Eigen::Vector3f normal = rotation_.transpose() * first.normal;
  return std::abs(normal.dot(step)) < 2e-3F * view_.depth_m[a];
}

void CameraRenderer::FindEdges() {
  edges_.clear();
  const auto width = static_cast<std::size_t>(view_.width);
  const auto differ = [&](std::size_t a, std::size_t b) {
    return surface_[a] != surface_[b] && std::abs(view_.gray[a] - view_.gray[b]) > kVisibleEdge &&
           rays_[a].valid && rays_[b].valid && !OnOnePlane(a, b);
  };
  for (int y = 0; y < view_.height; ++y) {
    for (int x = 0; x < view_.width; ++x) {
      const std::size_t i = Index(x, y);
      const bool edge = (x > 0 && differ(i, i - 1)) || (x + 1 < view_.width && differ(i, i + 1)) ||
                        (y > 0 && differ(i, i - width)) ||
                        (y + 1 < view_.height && differ(i, i + width));
      if (edge) edges_.push_back(i);
    }
  }
}

void CameraRenderer::SmoothEdges() {
  constexpr std::size_t kPerPixel = kSubPixels.size();
  for (const std::size_t pixel : edges_) {
    view_.gray[pixel] = std::min(view_.gray[pixel], 255.0F) / (kPerPixel + 1);
  }
  const std::size_t rays = kPerPixel * edges_.size();
  packet_.most_lookups = RayPacket::kMostLookups / 3;
  for (std::size_t first = 0; first < rays; first += RayPacket::kSize) {
    for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
      const std::size_t which = std::min(first + i, rays - 1);
      const PixelRay& ray = rays_[edges_[which / kPerPixel]];
      const auto& place = kSubPixels[which % kPerPixel];
      packet_.valid[i] = first + i < rays;
      packet_.directions[i] =
          rotation_ *
          (ray.direction + place[0] * ray.to_right + place[1] * ray.to_below).normalized();
      packet_.spreads[i] = 0.5F * ray.spread;
    }
    const auto seen = tracer_.Trace(packet_);
    for (std::size_t i = 0; i < RayPacket::kSize && first + i < rays; ++i) {
      view_.gray[edges_[(first + i) / kPerPixel]] +=
          std::min(seen[i].gray, 255.0F) / (kPerPixel + 1);
    }
  }
}

const PerfectView& CameraRenderer::Render(const Eigen::Isometry3d& world_from_camera) {
  rotation_ = world_from_camera.linear().cast<float>();
  packet_.origin = world_from_camera.translation().cast<float>();
  packet_.most_lookups = RayPacket::kMostLookups;
  for (int y = 0; y < view_.height; y += kBlockHeight) {
    for (int x = 0; x < view_.width; x += kBlockWidth) RenderBlock(x, y);
  }
  FindEdges();
  SmoothEdges();
  return view_;
}

}  // namespace trailcast::sim
