#include "services/teach/heading_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace trailcast::teach {
namespace {

constexpr double kShortest_m = 1e-3;  // a segment that turns on the spot has no heading by distance

}  // namespace

route::HeadingPolynomial FitHeading(std::span<const HeadingSample> samples) {
  double longest_m = 0.0;
  for (const HeadingSample& sample : samples) {
    longest_m = std::max(longest_m, std::abs(sample.distance_m));
  }
  route::HeadingPolynomial polynomial;
  if (longest_m < kShortest_m) return polynomial;
  // Distances are scaled to 0..1, which keeps the columns comparable; the minimum-norm solution
  // then prefers low orders where the samples do not tell.
  Eigen::MatrixX3d powers(samples.size(), 3);
  Eigen::VectorXd headings(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = samples[i].distance_m / longest_m;
    const auto row = static_cast<Eigen::Index>(i);
    powers.row(row) << x, x * x, x * x * x;
    headings(row) = samples[i].heading_rad;
  }
  const Eigen::Vector3d c = powers.completeOrthogonalDecomposition().solve(headings);
  polynomial.c = {c[0] / longest_m, c[1] / (longest_m * longest_m),
                  c[2] / (longest_m * longest_m * longest_m)};
  return polynomial;
}

}  // namespace trailcast::teach
