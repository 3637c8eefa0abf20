#include "services/teach/picture_turn.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>

#include "services/base/square.h"
#include "services/route/usual_camera.h"

namespace trailcast::teach {
namespace {

constexpr int kIterations = 8;
// The first fits let all features count alike, for a large motion is no outlier.
constexpr double kWidest = 64.0;  // times the noise

}  // namespace

std::vector<MovedFeature> MovedBetween(std::span<const route::TrackedFeature> before,
                                       std::span<const route::TrackedFeature> now) {
  std::vector<MovedFeature> moved;
  std::size_t i = 0;
  for (const route::TrackedFeature& feature : now) {
    while (i < before.size() && before[i].id != feature.id) ++i;
    if (i == before.size()) break;
    moved.push_back({before[i], feature});
  }
  return moved;
}

PictureFlow FlowOf(std::span<const MovedFeature> features, double noise_px) {
  Eigen::Vector3d flow = Eigen::Vector3d::Zero();
  double width_px = kWidest * noise_px;
  for (int i = 0; i < kIterations && !features.empty(); ++i) {
    // A single feature gives a shift and no growth.
    Eigen::Matrix3d information = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [before, now] : features) {
      const Eigen::Vector3d by_u(1.0, 0.0, before.u_px);
      const Eigen::Vector3d by_v(0.0, 1.0, before.v_px);
      const double du = now.u_px - before.u_px;
      const double dv = now.v_px - before.v_px;
      const double off2 = Square(du - by_u.dot(flow)) + Square(dv - by_v.dot(flow));
      const double weight = i == 0 ? 1.0 : 1.0 / (1.0 + off2 / Square(width_px));
      information += weight * (by_u * by_u.transpose() + by_v * by_v.transpose());
      sum += weight * (du * by_u + dv * by_v);
    }
    flow = information.ldlt().solve(sum);
    width_px = std::max(noise_px, 0.4 * width_px);
  }
  return {flow[0], flow[1], flow[2]};
}

double TurnOf(const PictureFlow& flow, int width_px) {
  return flow.u_px / (route::kUsualFocalShare * width_px);
}

}  // namespace trailcast::teach
