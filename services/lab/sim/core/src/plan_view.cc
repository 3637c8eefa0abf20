#include "services/lab/sim/core/plan_view.h"

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/view_tracer.h"

namespace trailcast::sim {
namespace {

constexpr double kLargestSide_px = 4000.0;
const Eigen::Vector3f kNothingThere = {235.0F, 235.0F, 235.0F};
constexpr double kDepth_m = 1000.0;

Eigen::Vector3f ColorAt(const World& world, const Eigen::Vector3f& from, double pixel_m) {
  const auto hit = world.CastRay(from, -Eigen::Vector3f::UnitZ(), kDepth_m);
  if (!hit) return kNothingThere;
  const Surface& surface = world.surfaces()[hit->surface];
  const Material& material = world.material(surface.material);
  Eigen::Vector3f color = material.color;
  if (material.texture) {
    const Eigen::Vector3f at =
        from - static_cast<float>(hit->distance_m) * Eigen::Vector3f::UnitZ();
    const Eigen::Vector2f uv = world.TextureAt(hit->surface, at);
    const float level =
        std::log2(std::max(static_cast<float>(pixel_m) * surface.texels_per_m, 1e-6F));
    color = color.cwiseProduct(material.texture->Rgb(uv.x(), uv.y(), level)) / 255.0F;
  }
  const float upright = std::abs(surface.normal.z());
  return color * (0.65F + 0.35F * upright);
}

}  // namespace

PlanView RenderPlan(const World& world, const PlanOptions& options) {
  const Eigen::AlignedBox3f& bounds = world.bounds();
  const Eigen::Vector3d size = bounds.sizes().cast<double>();
  PlanView plan;
  plan.metres_per_pixel =
      std::max(options.metres_per_pixel, std::max(size.x(), size.y()) / kLargestSide_px);
  plan.x_min_m = bounds.min().x();
  plan.y_max_m = bounds.max().y();
  image::RgbImage& picture = plan.picture;
  picture.width = std::max(1, static_cast<int>(std::ceil(size.x() / plan.metres_per_pixel)));
  picture.height = std::max(1, static_cast<int>(std::ceil(size.y() / plan.metres_per_pixel)));
  picture.pixels.reserve(3U * static_cast<std::size_t>(picture.width) *
                         static_cast<std::size_t>(picture.height));
  for (int py = 0; py < picture.height; ++py) {
    for (int px = 0; px < picture.width; ++px) {
      Eigen::Vector3f color = Eigen::Vector3f::Zero();
      for (const double dy : {0.25, 0.75}) {
        for (const double dx : {0.25, 0.75}) {
          const Eigen::Vector3d from(plan.x_min_m + (px + dx) * plan.metres_per_pixel,
                                     plan.y_max_m - (py + dy) * plan.metres_per_pixel,
                                     options.cut_z_m);
          color += 0.25F * ColorAt(world, from.cast<float>(), plan.metres_per_pixel);
        }
      }
      for (int channel = 0; channel < 3; ++channel) {
        picture.pixels.push_back(
            static_cast<std::uint8_t>(std::clamp(color[channel], 0.0F, 255.0F)));
      }
    }
  }
  return plan;
}

}  // namespace trailcast::sim
