#include "services/teach/visual_odometry.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "services/base/median.h"
#include "services/base/square.h"

namespace trailcast::teach {
namespace {

constexpr int kCamera = 4;      // unknowns
constexpr int kOfInterval = 3;  // turn, pitch, roll
enum CameraIndex { kTowardsU, kTowardsV, kWidening, kAhead };

constexpr int kIterations = 8;
// The first iterations let nearly all features count alike; then the weight narrows. The noise is
// estimated only after that.
constexpr double kWidest_sigmas = 24.0;
constexpr double kNarrows = 0.6;
constexpr double kTellsNoise_sigmas = 10.0;
constexpr double kSlowest = 0.05;        // share of the usual speed, so the path always goes on
constexpr double kSmallestShrink = 0.1;  // of a depth along a segment
constexpr double kNearestBeyond_m = 0.2;
constexpr double kUsualSpeedLearns_per_s = 0.2;

}  // namespace

struct VisualOdometry::Landmark {
  struct Step {  // over one interval
    int interval = 0;
    double u = 0.0;  // in the interval's middle
    double v = 0.0;
    double du = 0.0;
    double dv = 0.0;
  };
  int id = 0;
  double inverse_depth = 0.0;  // at the segment's start
  double expected = 0.0;
  double sigma = 0.0;
  double information = 0.0;  // after a fit
  std::vector<Step> steps;
};

struct VisualOdometry::Fit {
  std::vector<std::size_t> knots;  // positions of moments
  std::vector<double> at_s;        // of the knots
  double noise_px = 0.0;
  std::vector<Landmark> landmarks;
  Eigen::VectorXd unknowns;

  [[nodiscard]] int intervals() const { return static_cast<int>(knots.size()) - 1; }
  // Indices of the unknowns.
  [[nodiscard]] int turn(int interval) const { return kCamera + kOfInterval * interval; }
  [[nodiscard]] int pitch(int interval) const { return turn(interval) + 1; }
  [[nodiscard]] int roll(int interval) const { return turn(interval) + 2; }
  [[nodiscard]] int speed(int knot) const { return turn(intervals()) + knot; }
  [[nodiscard]] int size() const { return speed(intervals()) + 1; }
  [[nodiscard]] double took_s(int interval) const { return at_s[interval + 1] - at_s[interval]; }
  [[nodiscard]] double way_m(int interval) const {
    return 0.5 * took_s(interval) * (unknowns[speed(interval)] + unknowns[speed(interval + 1)]);
  }
  [[nodiscard]] double length_m() const {
    double length_m = 0.0;
    for (int i = 0; i < intervals(); ++i) length_m += way_m(i);
    return length_m;
  }
};

// Normal equations of the unknowns, from which the inverse depths are eliminated.
struct VisualOdometry::Equations {
  struct OfDepth {
    Eigen::VectorXd mixed;
    double information = 0.0;
    double gradient = 0.0;
  };

  explicit Equations(int size)
      : information(Eigen::MatrixXd::Zero(size, size)), gradient(Eigen::VectorXd::Zero(size)) {}

  void Expect(int index, double error, double sigma) {
    information(index, index) += 1.0 / Square(sigma);
    gradient[index] += error / Square(sigma);
  }
  void ExpectAlike(int a, int b, double difference, double sigma) {
    const double weight = 1.0 / Square(sigma);
    information(a, a) += weight;
    information(b, b) += weight;
    information(a, b) -= weight;
    information(b, a) -= weight;
    gradient[a] += weight * difference;
    gradient[b] -= weight * difference;
  }

  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  std::vector<OfDepth> depths;  // of the landmarks, in their order
};

VisualOdometry::VisualOdometry(int width_px, const VisualOdometryOptions& options)
    : options_(options), scale_(width_px / 320.0), focal_px_(route::kUsualFocalShare * width_px) {}

// Begins a feature. One that the last segment saw where this one begins keeps its depth.
VisualOdometry::Landmark VisualOdometry::Meet(const route::TrackedFeature& feature) const {
  Landmark landmark;
  landmark.id = feature.id;
  landmark.expected = options_.inverse_depth_per_m;
  landmark.sigma = options_.inverse_depth_sigma_per_m;
  double nearest_px = options_.same_px_at_320 * scale_;
  for (const Known& known : known_) {
    const double apart_px = std::hypot(known.at.u_px - feature.u_px, known.at.v_px - feature.v_px);
    if (apart_px > nearest_px) continue;
    nearest_px = apart_px;
    landmark.expected = known.inverse_depth;
    landmark.sigma = known.sigma;
  }
  landmark.inverse_depth = landmark.expected;
  return landmark;
}

VisualOdometry::Fit VisualOdometry::Prepare(std::span<const Moment> moments) const {
  Fit fit;
  const double duration_s = moments.back().moving_s;
  const int wanted = std::clamp(static_cast<int>(std::lround(duration_s / options_.interval_s)), 1,
                                options_.most_intervals);
  fit.knots.push_back(0);
  for (std::size_t i = 1; i + 1 < moments.size(); ++i) {
    const auto next = static_cast<int>(fit.knots.size());
    const bool is_due = moments[i].moving_s >= duration_s * next / wanted;
    const bool moves = moments[i].moving_s > moments[fit.knots.back()].moving_s;
    const bool is_before_last = moments[i].moving_s < duration_s;
    if (next < wanted && is_due && moves && is_before_last) fit.knots.push_back(i);
  }
  fit.knots.push_back(moments.size() - 1);
  for (const std::size_t knot : fit.knots) fit.at_s.push_back(moments[knot].moving_s);

  for (const auto& [id, first] : *moments.front().features) {
    Landmark landmark = Meet(first);
    route::TrackedFeature before = first;
    for (int i = 0; i < fit.intervals(); ++i) {
      const Features& seen = *moments[fit.knots[i + 1]].features;
      const auto now = seen.find(id);
      if (now == seen.end()) break;
      const route::TrackedFeature& after = now->second;
      landmark.steps.push_back({i, 0.5 * (before.u_px + after.u_px),
                                0.5 * (before.v_px + after.v_px), after.u_px - before.u_px,
                                after.v_px - before.v_px});
      before = after;
    }
    if (!landmark.steps.empty()) fit.landmarks.push_back(std::move(landmark));
  }
  // Sorting makes the sums below independent of the order in a hash table.
  std::sort(fit.landmarks.begin(), fit.landmarks.end(),
            [](const Landmark& a, const Landmark& b) { return a.id < b.id; });

  fit.noise_px = options_.noise_px_at_320 * scale_;
  fit.unknowns = Eigen::VectorXd::Zero(fit.size());
  fit.unknowns[kWidening] = options_.widening;
  fit.unknowns[kAhead] = options_.ahead_m;
  for (int i = 0; i < fit.intervals(); ++i) {
    fit.unknowns[fit.turn(i)] =
        moments[fit.knots[i + 1]].turned_rad - moments[fit.knots[i]].turned_rad;
  }
  fit.unknowns.tail(fit.intervals() + 1).setConstant(speed_mps_);
  return fit;
}

// Adds the prior.
void VisualOdometry::Expect(const Fit& fit, Equations& equations) const {
  const Eigen::VectorXd& x = fit.unknowns;
  const double mount_px = options_.mount_rad * focal_px_;
  equations.Expect(kTowardsU, -x[kTowardsU], mount_px);
  equations.Expect(kTowardsV, -x[kTowardsV], mount_px);
  equations.Expect(kWidening, options_.widening - x[kWidening], options_.widening_sigma);
  equations.Expect(kAhead, options_.ahead_m - x[kAhead], options_.ahead_sigma_m);
  const int n = fit.intervals();
  for (int i = 0; i < n; ++i) {
    equations.Expect(fit.turn(i), -x[fit.turn(i)], options_.turn_rad);
    equations.Expect(fit.pitch(i), -x[fit.pitch(i)], options_.tilt_rad);
    equations.Expect(fit.roll(i), -x[fit.roll(i)], options_.tilt_rad);
    const int a = fit.speed(i);
    const int b = fit.speed(i + 1);
    equations.ExpectAlike(a, b, x[b] - x[a],
                          options_.speed_walk * usual_mps_ * std::sqrt(fit.took_s(i)));
  }
  for (int knot = 0; knot <= n; ++knot) {
    equations.Expect(fit.speed(knot), route::kUsualSpeed_mps - x[fit.speed(knot)],
                     options_.speed_spread * route::kUsualSpeed_mps);
  }
  equations.Expect(fit.speed(0), speed_mps_ - x[fit.speed(0)], speed_known_ * usual_mps_);
}

// Adds what the features tell, by the equations of the class's comment.
void VisualOdometry::Measure(Fit& fit, double cauchy_sigmas, Equations& equations) const {
  constexpr int kConcerned = kCamera + kOfInterval + 2;  // unknowns in a step's equations
  using Slopes = Eigen::Matrix<double, kConcerned, 1>;
  const Eigen::VectorXd& x = fit.unknowns;
  const double f = focal_px_;
  const double c = x[kWidening];
  const double ahead_m = x[kAhead];
  std::vector<double> begins_m{0.0};
  for (int i = 0; i < fit.intervals(); ++i) begins_m.push_back(begins_m.back() + fit.way_m(i));
  std::vector<double> off_px;
  for (const Landmark& landmark : fit.landmarks) {
    Equations::OfDepth own{Eigen::VectorXd::Zero(fit.size()), 1.0 / Square(landmark.sigma),
                           (landmark.expected - landmark.inverse_depth) / Square(landmark.sigma)};
    for (const Landmark::Step& s : landmark.steps) {
      const int i = s.interval;
      const double way_m = fit.way_m(i);
      const double middle_m = begins_m[i] + 0.5 * way_m;
      const double shrink = std::max(kSmallestShrink, 1.0 - landmark.inverse_depth * middle_m);
      const double rho = landmark.inverse_depth / shrink;
      const double turn = x[fit.turn(i)];
      const double pitch = x[fit.pitch(i)];
      const double roll = x[fit.roll(i)];
      const double out_u = s.u - x[kTowardsU];
      const double out_v = s.v - x[kTowardsV];
      const double turn_u = f + c * s.u * s.u / f;
      const double turn_v = c * s.u * s.v / f;
      const double pitch_u = turn_v;
      const double pitch_v = f + c * s.v * s.v / f;
      const double residual_u = s.du - turn * turn_u - pitch * pitch_u + roll * s.v -
                                rho * way_m * out_u - f * rho * ahead_m * turn;
      const double residual_v =
          s.dv - turn * turn_v - pitch * pitch_v - roll * s.u - rho * way_m * out_v;
      const double residual_px = std::hypot(residual_u, residual_v);
      off_px.push_back(residual_px);
      const double weight =
          1.0 / (Square(fit.noise_px) * (1.0 + Square(residual_px / fit.noise_px / cauchy_sigmas)));

      const std::array<int, kConcerned> indices = {kTowardsU,   kTowardsV,    kWidening,
                                                   kAhead,      fit.turn(i),  fit.pitch(i),
                                                   fit.roll(i), fit.speed(i), fit.speed(i + 1)};
      const double by_speed = 0.5 * fit.took_s(i) * rho;
      Slopes slope_u;
      slope_u << -rho * way_m, 0.0, (turn * s.u * s.u + pitch * s.u * s.v) / f, f * rho * turn,
          turn_u + f * rho * ahead_m, pitch_u, -s.v, by_speed * out_u, by_speed * out_u;
      Slopes slope_v;
      slope_v << 0.0, -rho * way_m, (turn * s.u * s.v + pitch * s.v * s.v) / f, 0.0, turn_v,
          pitch_v, s.u, by_speed * out_v, by_speed * out_v;
      const double depth_u = (way_m * out_u + f * ahead_m * turn) / Square(shrink);
      const double depth_v = way_m * out_v / Square(shrink);
      for (int a = 0; a < kConcerned; ++a) {
        for (int b = 0; b < kConcerned; ++b) {
          equations.information(indices[a], indices[b]) +=
              weight * (slope_u[a] * slope_u[b] + slope_v[a] * slope_v[b]);
        }
        equations.gradient[indices[a]] +=
            weight * (slope_u[a] * residual_u + slope_v[a] * residual_v);
        own.mixed[indices[a]] += weight * (slope_u[a] * depth_u + slope_v[a] * depth_v);
      }
      own.information += weight * (Square(depth_u) + Square(depth_v));
      own.gradient += weight * (depth_u * residual_u + depth_v * residual_v);
    }
    equations.information.noalias() -= own.mixed * own.mixed.transpose() / own.information;
    equations.gradient -= own.mixed * (own.gradient / own.information);
    equations.depths.push_back(std::move(own));
  }
  if (cauchy_sigmas < kTellsNoise_sigmas && !off_px.empty()) {
    fit.noise_px =
        std::max(options_.noise_px_at_320 * scale_, options_.noise_of_median * Median(off_px));
  }
}

bool VisualOdometry::Improve(Fit& fit, double cauchy_sigmas) const {
  Equations equations(fit.size());
  Expect(fit, equations);
  Measure(fit, cauchy_sigmas, equations);
  const Eigen::VectorXd step = equations.information.ldlt().solve(equations.gradient);
  if (!step.allFinite()) return false;
  fit.unknowns += step;
  for (int knot = 0; knot <= fit.intervals(); ++knot) {
    double& speed_mps = fit.unknowns[fit.speed(knot)];
    speed_mps = std::max(speed_mps, kSlowest * usual_mps_);
  }
  const double nearest_per_m = 1.0 / (fit.length_m() + kNearestBeyond_m);
  for (std::size_t i = 0; i < fit.landmarks.size(); ++i) {
    Landmark& landmark = fit.landmarks[i];
    const Equations::OfDepth& own = equations.depths[i];
    landmark.inverse_depth += (own.gradient - own.mixed.dot(step)) / own.information;
    landmark.inverse_depth = std::min(landmark.inverse_depth, nearest_per_m);
    landmark.information = own.information;
  }
  return true;
}

void VisualOdometry::Remember(const Fit& fit, const Features& last) {
  known_.clear();
  const double length_m = fit.length_m();
  for (const Landmark& landmark : fit.landmarks) {
    const auto at = last.find(landmark.id);
    if (at == last.end()) continue;
    const double shrink = std::max(kSmallestShrink, 1.0 - landmark.inverse_depth * length_m);
    const double inverse_depth = landmark.inverse_depth / shrink;
    const double sigma = 1.0 / (std::sqrt(landmark.information) * Square(shrink));
    known_.push_back({at->second, inverse_depth,
                      std::hypot(sigma, options_.same_inverse_depth * inverse_depth)});
  }
  speed_mps_ = fit.unknowns[fit.speed(fit.intervals())];
  const double took_s = fit.at_s.back();
  usual_mps_ +=
      std::min(1.0, kUsualSpeedLearns_per_s * took_s) * (fit.length_m() / took_s - usual_mps_);
  speed_known_ = options_.speed_known;
}

std::vector<VisualOdometry::Place> VisualOdometry::DriveOn(std::span<const Moment> moments) const {
  std::vector<Place> places;
  places.reserve(moments.size());
  for (const Moment& moment : moments) {
    places.push_back({speed_mps_ * moment.moving_s, moment.turned_rad});
  }
  return places;
}

std::vector<VisualOdometry::Place> VisualOdometry::Follow(std::span<const Moment> moments) {
  if (moments.size() < 2 || moments.back().moving_s <= 0.0) return DriveOn(moments);
  Fit fit = Prepare(moments);
  double cauchy_sigmas = kWidest_sigmas;
  for (int i = 0; i < kIterations; ++i) {
    if (!Improve(fit, cauchy_sigmas)) {
      known_.clear();
      return DriveOn(moments);
    }
    cauchy_sigmas = std::max(options_.cauchy_sigmas, kNarrows * cauchy_sigmas);
  }
  std::vector<Place> places(moments.size());
  Place begin;
  for (int i = 0; i < fit.intervals(); ++i) {
    const double from_mps = fit.unknowns[fit.speed(i)];
    const double to_mps = fit.unknowns[fit.speed(i + 1)];
    const double turn_rad = fit.unknowns[fit.turn(i)];
    for (std::size_t m = fit.knots[i] + 1; m <= fit.knots[i + 1]; ++m) {
      const double since_s = moments[m].moving_s - fit.at_s[i];
      const double share = since_s / fit.took_s(i);
      places[m] = {begin.way_m + since_s * (from_mps + 0.5 * share * (to_mps - from_mps)),
                   begin.turned_rad + share * turn_rad};
    }
    begin = {begin.way_m + fit.way_m(i), begin.turned_rad + turn_rad};
  }
  Remember(fit, *moments.back().features);
  return places;
}

}  // namespace trailcast::teach
