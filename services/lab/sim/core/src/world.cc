#include "services/lab/sim/core/world.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trailcast::sim {
namespace {

// The free height that a robot needs tells a floor from a gap below one.
constexpr double kFreeHeight_m = 0.5;
constexpr float kSmallestArea_m2 = 1e-10F;

// Change of u and v per metre along the triangle's plane, from its edges.
void FillGradients(const Eigen::Vector3f& edge_b, const Eigen::Vector3f& edge_c, Surface& surface) {
  const float bb = edge_b.dot(edge_b);
  const float bc = edge_b.dot(edge_c);
  const float cc = edge_c.dot(edge_c);
  const float determinant = bb * cc - bc * bc;
  const Eigen::Vector3f along_b = (cc * edge_b - bc * edge_c) / determinant;
  const Eigen::Vector3f along_c = (bb * edge_c - bc * edge_b) / determinant;
  surface.grad_u = surface.uv_b.x() * along_b + surface.uv_c.x() * along_c;
  surface.grad_v = surface.uv_b.y() * along_b + surface.uv_c.y() * along_c;
  // Slivers have edges that are parallel to within rounding.
  if (!surface.grad_u.allFinite()) surface.grad_u.setZero();
  if (!surface.grad_v.allFinite()) surface.grad_v.setZero();
}

// Values that are not finite, which files have, must not reach the texture's lookups.
void FillUvs(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, Surface& surface) {
  surface.uv = surface.uv_b = surface.uv_c = Eigen::Vector2f::Zero();
  if (mesh.uvs.empty()) return;
  surface.uv = mesh.uvs[corners[0]];
  surface.uv_b = mesh.uvs[corners[1]] - surface.uv;
  surface.uv_c = mesh.uvs[corners[2]] - surface.uv;
  if (surface.uv.allFinite() && surface.uv_b.allFinite() && surface.uv_c.allFinite()) return;
  surface.uv = surface.uv_b = surface.uv_c = Eigen::Vector2f::Zero();
}

}  // namespace

void World::AddSurface(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners) {
  const Eigen::Vector3f& a = mesh.positions[corners[0]];
  const Eigen::Vector3f edge_b = mesh.positions[corners[1]] - a;
  const Eigen::Vector3f edge_c = mesh.positions[corners[2]] - a;
  const Eigen::Vector3f cross = edge_b.cross(edge_c);
  const float area = 0.5F * cross.norm();
  if (!(area > kSmallestArea_m2) || !std::isfinite(area)) return;
  Surface surface;
  surface.normal = cross.normalized();
  surface.material = static_cast<std::uint32_t>(mesh.material);
  FillUvs(mesh, corners, surface);
  FillGradients(edge_b, edge_c, surface);
  const Material& material = scene_.materials[mesh.material];
  if (material.texture) {
    const float uv_area =
        0.5F * std::abs(surface.uv_b.x() * surface.uv_c.y() - surface.uv_b.y() * surface.uv_c.x());
    const auto texels = static_cast<float>(material.texture->width()) *
                        static_cast<float>(material.texture->height()) * uv_area;
    surface.texels_per_m = std::sqrt(texels / area);
  }
  for (std::size_t i = 0; i < 3 && !mesh.shade.empty(); ++i) {
    surface.shade[i] = mesh.shade[corners[i]];
  }
  for (const std::uint32_t corner : corners) {
    corners_.push_back(mesh.positions[corner]);
    bounds_.extend(mesh.positions[corner]);
  }
  surfaces_.push_back(surface);
}

Result<void> World::BuildEmbreeScene() {
  // One thread builds the tree. With several, trees differ from run to run, and with them the
  // visible one of two coinciding faces.
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  if (device == nullptr) {
    return Fail(ErrorCode::kInternal, "Embree cannot start (error {})",
                static_cast<int>(rtcGetDeviceError(nullptr)));
  }
  embree_scene_ = rtcNewScene(device);
  rtcSetSceneFlags(embree_scene_, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners_.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), surfaces_.size()));
  if (positions != nullptr && indices != nullptr) {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Eigen::Map<Eigen::Vector3f>(positions + 3 * i) = corners_[i];
      indices[i] = static_cast<std::uint32_t>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_scene_, geometry);
    rtcCommitScene(embree_scene_);
  }
  rtcReleaseGeometry(geometry);
  const RTCError error = rtcGetDeviceError(device);
  rtcReleaseDevice(device);  // the scene keeps it alive
  if (error != RTC_ERROR_NONE) {
    return Fail(ErrorCode::kInternal, "Embree refused a scene of {} triangles (error {})",
                surfaces_.size(), static_cast<int>(error));
  }
  return {};
}

Result<std::shared_ptr<const World>> World::Build(Scene scene) {
  std::shared_ptr<World> world(new World);
  world->scene_ = std::move(scene);
  const std::vector<Mesh> meshes = std::move(world->scene_.meshes);
  world->scene_.meshes.clear();
  for (const Mesh& mesh : meshes) {
    for (const auto& corners : mesh.triangles) world->AddSurface(mesh, corners);
  }
  for (const Material& material : world->scene_.materials) {
    const float gray = GrayOf(material.color);
    world->paints_.push_back(
        {material.texture.get(), material.texture ? gray / 255.0F : gray, material.glows});
  }
  if (world->surfaces_.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "the world {} has no triangles: expected at least one of non-zero area",
                world->scene_.name);
  }
  if (auto built = world->BuildEmbreeScene(); !built) return tl::unexpected(built.error());
  return std::shared_ptr<const World>(std::move(world));
}

World::~World() {
  if (embree_scene_ != nullptr) rtcReleaseScene(embree_scene_);
}

std::optional<SurfaceHit> World::CastRay(const Eigen::Vector3f& origin,
                                         const Eigen::Vector3f& direction,
                                         double max_distance_m) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray.org_x = origin.x();
  query.ray.org_y = origin.y();
  query.ray.org_z = origin.z();
  query.ray.dir_x = direction.x();
  query.ray.dir_y = direction.y();
  query.ray.dir_z = direction.z();
  query.ray.tfar = static_cast<float>(max_distance_m);
  query.ray.mask = std::numeric_limits<unsigned>::max();
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_scene_, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return SurfaceHit{query.ray.tfar, surfaces_[query.hit.primID].normal, query.hit.primID};
}

Eigen::Vector2f World::TextureAt(std::uint32_t surface, const Eigen::Vector3f& at) const {
  const Surface& s = surfaces_[surface];
  const Eigen::Vector3f from_corner = at - corners_[3 * static_cast<std::size_t>(surface)];
  return s.uv + Eigen::Vector2f(s.grad_u.dot(from_corner), s.grad_v.dot(from_corner));
}

std::optional<double> World::SurfaceBelow(double x_m, double y_m, double z_max_m) const {
  const auto hit = CastRay(Eigen::Vector3d(x_m, y_m, z_max_m).cast<float>(),
                           -Eigen::Vector3f::UnitZ(), std::numeric_limits<float>::infinity());
  if (!hit) return std::nullopt;
  return z_max_m - hit->distance_m;
}

std::optional<double> World::GroundHeight(double x_m, double y_m, double z_max_m) const {
  if (scene_.ground == GroundMode::kFlat) return 0.0;
  return SurfaceBelow(x_m, y_m, z_max_m);
}

std::optional<double> World::FloorHeight(double x_m, double y_m) const {
  if (scene_.ground == GroundMode::kFlat) return 0.0;
  std::optional<double> floor;
  double above = std::numeric_limits<double>::infinity();
  double from = static_cast<double>(bounds_.max().z()) + 1.0;
  while (const auto surface = SurfaceBelow(x_m, y_m, from)) {
    if (above - *surface >= kFreeHeight_m) floor = surface;
    above = *surface;
    from = *surface - 1e-3;
  }
  return floor;
}

}  // namespace trailcast::sim
