#include "services/lab/sim/core/camera_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trailcast::sim {
namespace {

// Blocks of 4 x 4 pixels keep the rays of a packet together.
constexpr int kBlock = 4;
static_assert(std::size_t{kBlock} * kBlock == RayPacket::kSize);
// Edges are collected by larger squares, so that neighbouring ones are traced together, too.
constexpr int kSquare = 16;
// Neighbours on different triangles that differ by less (grey levels) need no finer sampling.
constexpr float kVisibleEdge = 16.0F;
// This share of an edge pixel's grey comes from its middle. The rest comes from its four corners,
// which neighbours share; so dense edges, as in foliage, cost little more than one ray a pixel.
constexpr float kMiddleShare = 1.0F / 2.0F;

constexpr std::uint32_t kNoMaterial = 0xFFFFFFFFU;
constexpr float kUnknownGray = -1.0F;

// A value brighter than white would light up its edges.
float Cut(float gray) { return std::min(gray, 255.0F); }

}  // namespace

CameraRenderer::CameraRenderer(std::shared_ptr<const World> world, const CameraModel& camera,
                               const Lighting& lighting)
    : world_(std::move(world)),
      lens_(camera),
      tracer_(*world_, lighting),
      readout_s_(camera.readout_s) {
  view_.width = camera.width;
  view_.height = camera.height;
  const std::size_t pixels = Index(0, camera.height);
  view_.gray.resize(pixels);
  view_.depth_m.resize(pixels);
  surface_.resize(pixels);
  material_.resize(pixels, kNoMaterial);
  corner_gray_.resize(pixels);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) MakeRay(x, y);
  }
}

CameraRenderer::Pose CameraRenderer::PoseAtRow(int y) const {
  if (readout_s_ == 0.0) return now_;
  const double since_s = readout_s_ * (static_cast<double>(y) / view_.height - 1.0);
  const Eigen::Vector3f turn = (since_s * motion_.angular_radps).cast<float>();
  const float angle = turn.norm();
  const Eigen::Vector3f axis = angle > 0.0F ? Eigen::Vector3f(turn / angle) : turn;
  return {now_.rotation * Eigen::AngleAxisf(angle, axis).toRotationMatrix(),
          now_.origin + now_.rotation * (since_s * motion_.linear_mps).cast<float>()};
}

void CameraRenderer::MakeRay(int x, int y) {
  const Eigen::Vector2d pixel(x, y);
  const auto direction = lens_.Direction(pixel);
  // The difference is one-sided at the rim of the lens's picture.
  const auto change = [&](const Eigen::Vector2d& step) -> Eigen::Vector3f {
    if (!direction) return Eigen::Vector3f::Zero();
    if (const auto next = lens_.Direction(pixel + step)) {
      return (*next - *direction).cast<float>();
    }
    if (const auto last = lens_.Direction(pixel - step)) {
      return (*direction - *last).cast<float>();
    }
    return Eigen::Vector3f::Zero();
  };
  const Eigen::Vector3f ahead = direction.value_or(Eigen::Vector3d::UnitZ()).cast<float>();
  rays_.x.push_back(ahead.x());
  rays_.y.push_back(ahead.y());
  rays_.z.push_back(ahead.z());
  rays_.spread.push_back(std::sqrt(change({1.0, 0.0}).norm() * change({0.0, 1.0}).norm()));
}

void CameraRenderer::RenderBlock(int x0, int y0) {
  RayPacket packet;
  const Pose pose = PoseAtRow(y0);
  packet.origin = pose.origin;
  std::array<std::size_t, RayPacket::kSize> pixels{};
  float widest = 0.0F;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    const std::size_t row = i / kBlock;
    pixels[i] = Index(x0, y0) + row * static_cast<std::size_t>(view_.width) + i % kBlock;
    packet.SetRay(i, pose.rotation * Direction(pixels[i]), rays_.spread[pixels[i]]);
    widest = std::max(widest, packet.spreads[i]);
  }
  if (widest == 0.0F) return;  // all outside the lens's picture
  const PacketHits hits = tracer_.FindHits(packet);
  const PacketView seen = tracer_.Shade(packet, hits);
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    if (packet.spreads[i] == 0.0F) continue;
    view_.gray[pixels[i]] = seen.gray[i];
    view_.depth_m[pixels[i]] = hits.depth_m[i];
    material_[pixels[i]] = MaterialOf(hits.surface[i]);
    // A shadow's edge is an edge as well: lit and shaded parts count as different surfaces.
    surface_[pixels[i]] = seen.in_shadow[i] ? ~hits.surface[i] : hits.surface[i];
  }
}

// A part of an actor counts as one material, which is enough to tell things apart.
std::uint32_t CameraRenderer::MaterialOf(std::uint32_t surface) const {
  if (surface == PacketHits::kSky) return kNoMaterial;
  const PlacedPart* part = tracer_.PartOf(surface);
  return part == nullptr ? world_->surfaces()[surface].material : part->first_surface;
}

// Neighbouring triangles of one material in one plane differ only in their texture, which is
// filtered already.
bool CameraRenderer::OnOnePlane(std::size_t a, std::size_t b) const {
  const auto count = static_cast<std::uint32_t>(world_->surfaces().size());
  if (surface_[a] >= count || surface_[b] >= count) return false;  // sky or shadow
  const Surface& first = world_->surfaces()[surface_[a]];
  const Surface& second = world_->surfaces()[surface_[b]];
  if (first.material != second.material) return false;
  if (std::abs(first.normal.dot(second.normal)) < 0.9998F) return false;
  const Eigen::Vector3f step = view_.depth_m[a] * Direction(a) - view_.depth_m[b] * Direction(b);
  const Eigen::Vector3f normal = now_.rotation.transpose() * first.normal;
  return std::abs(normal.dot(step)) < 2e-3F * view_.depth_m[a];
}

bool CameraRenderer::IsEdge(int x, int y) const {
  const std::size_t i = Index(x, y);
  const auto width = static_cast<std::size_t>(view_.width);
  const auto differs = [&](std::size_t other) {
    return surface_[i] != surface_[other] &&
           std::abs(view_.gray[i] - view_.gray[other]) > kVisibleEdge && rays_.spread[i] > 0.0F &&
           rays_.spread[other] > 0.0F && !OnOnePlane(i, other);
  };
  return (x > 0 && differs(i - 1)) || (x + 1 < view_.width && differs(i + 1)) ||
         (y > 0 && differs(i - width)) || (y + 1 < view_.height && differs(i + width));
}

void CameraRenderer::FindEdges() {
  edges_.clear();
  corners_.clear();
  std::fill(corner_gray_.begin(), corner_gray_.end(), kUnknownGray);
  for (int y0 = 0; y0 < view_.height; y0 += kSquare) {
    for (int x0 = 0; x0 < view_.width; x0 += kSquare) {
      for (int y = y0; y < std::min(y0 + kSquare, view_.height); ++y) {
        for (int x = x0; x < std::min(x0 + kSquare, view_.width); ++x) {
          if (!IsEdge(x, y)) continue;
          edges_.push_back({Index(x, y), CornersOf(x, y)});
          for (const std::size_t corner : edges_.back().corners) AddCorner(corner);
        }
      }
    }
  }
}

// The picture's rim has no corners of its own, so pixels there take those further in.
CameraRenderer::Four CameraRenderer::CornersOf(int x, int y) const {
  const int left = std::max(x, 1);
  const int upper = std::max(y, 1);
  const int right = std::min(x + 1, view_.width - 1);
  const int lower = std::min(y + 1, view_.height - 1);
  return {Index(left, upper), Index(right, upper), Index(left, lower), Index(right, lower)};
}

CameraRenderer::Four CameraRenderer::PixelsRound(std::size_t corner) const {
  const auto width = static_cast<std::size_t>(view_.width);
  return {corner - width - 1, corner - width, corner - 1, corner};
}

// Between surfaces of one material (leaves of a crown, or a shadow's edge on the ground) a corner
// needs no ray: its grey is that of the pixels round it. The same holds at the rim of the lens.
void CameraRenderer::AddCorner(std::size_t corner) {
  if (corner_gray_[corner] != kUnknownGray) return;
  float sum = 0.0F;
  float count = 0.0F;
  bool one_material = true;
  for (const std::size_t pixel : PixelsRound(corner)) {
    if (rays_.spread[pixel] == 0.0F) continue;
    sum += Cut(view_.gray[pixel]);
    count += 1.0F;
    one_material = one_material && material_[pixel] == material_[corner];
  }
  corner_gray_[corner] = sum / count;
  if (!one_material && count == 4.0F) corners_.push_back(corner);
}

// The four pixels round a corner already know what its ray meets. The grey is that of those that
// see the same surface, or else of the one that is nearest in depth.
float CameraRenderer::Borrow(std::size_t corner, std::uint32_t surface, float depth_m) const {
  float sum = 0.0F;
  float count = 0.0F;
  float nearest_m = std::numeric_limits<float>::infinity();
  float nearest_gray = 0.0F;
  for (const std::size_t pixel : PixelsRound(corner)) {
    if (surface_[pixel] == surface || surface_[pixel] == ~surface) {
      sum += Cut(view_.gray[pixel]);
      count += 1.0F;
    }
    const float away_m = std::abs(depth_m - view_.depth_m[pixel]);
    if (away_m >= nearest_m) continue;
    nearest_m = away_m;
    nearest_gray = Cut(view_.gray[pixel]);
  }
  return count > 0.0F ? sum / count : nearest_gray;
}

void CameraRenderer::TraceCorners() {
  RayPacket packet;
  for (std::size_t first = 0; first < corners_.size(); first += RayPacket::kSize) {
    const std::size_t count = std::min(RayPacket::kSize, corners_.size() - first);
    // A packet's corners are near each other.
    const Pose pose = PoseAtRow(static_cast<int>(corners_[first]) / view_.width);
    packet.origin = pose.origin;
    packet.spreads.fill(0.0F);
    for (std::size_t i = 0; i < count; ++i) {
      const Four pixels = PixelsRound(corners_[first + i]);
      const Eigen::Vector3f direction =
          Direction(pixels[0]) + Direction(pixels[1]) + Direction(pixels[2]) + Direction(pixels[3]);
      packet.SetRay(i, pose.rotation * direction.normalized(), rays_.spread[pixels[0]]);
    }
    const PacketHits hits = tracer_.FindHits(packet);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t corner = corners_[first + i];
      corner_gray_[corner] = Borrow(corner, hits.surface[i], hits.depth_m[i]);
    }
  }
}

void CameraRenderer::SmoothEdges() {
  for (const Edge& edge : edges_) {
    float sum = 0.0F;
    for (const std::size_t corner : edge.corners) sum += corner_gray_[corner];
    view_.gray[edge.pixel] =
        kMiddleShare * Cut(view_.gray[edge.pixel]) + 0.25F * (1.0F - kMiddleShare) * sum;
  }
}

void CameraRenderer::NoteMovers() {
  for (std::size_t i = 0; i < surface_.size(); ++i) {
    const std::uint32_t surface = std::min(surface_[i], ~surface_[i]);
    const PlacedPart* part = tracer_.PartOf(surface);
    if (part == nullptr) continue;
    view_.movers.push_back({i, now_.rotation.transpose() * part->velocity_mps});
  }
}

const PerfectView& CameraRenderer::Render(const Eigen::Isometry3d& world_from_camera,
                                          std::span<const PlacedPart> actors,
                                          const CameraMotion& motion) {
  now_ = {world_from_camera.linear().cast<float>(), world_from_camera.translation().cast<float>()};
  motion_ = motion;
  tracer_.ShowActors(actors);
  // If the size is no multiple of the block's, the last blocks overlap those before.
  for (int y = 0; y < view_.height; y += kBlock) {
    for (int x = 0; x < view_.width; x += kBlock) {
      RenderBlock(std::min(x, view_.width - kBlock), std::min(y, view_.height - kBlock));
    }
  }
  view_.movers.clear();
  if (!actors.empty()) NoteMovers();
  FindEdges();
  TraceCorners();
  SmoothEdges();
  tracer_.ShowActors({});
  return view_;
}

}  // namespace trailcast::sim
