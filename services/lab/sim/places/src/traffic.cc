#include "services/lab/sim/places/traffic.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/looks/furniture.h"
#include "services/lab/sim/looks/pedestrian.h"
#include "services/lab/sim/looks/vehicles.h"

namespace trailcast::sim {
namespace {

// Places beside a path, which continues straight beyond its ends.
class BesidePath {
 public:
  explicit BesidePath(const Polyline& points) : points_(points), length_m_(Length(points)) {}
  [[nodiscard]] double length_m() const { return length_m_; }
  [[nodiscard]] Eigen::Vector2d At(double along_m, double left_m) const {
    // The direction is taken over this length, so that the path's own weaving is not copied.
    constexpr double kStretch_m = 8.0;
    const double from_m = std::clamp(along_m - kStretch_m, 0.0, length_m_ - 2.0 * kStretch_m);
    const Eigen::Vector2d from = PointAlong(points_, from_m);
    const Eigen::Vector2d way = PointAlong(points_, from_m + 2.0 * kStretch_m) - from;
    const Eigen::Vector2d ahead = way.normalized();
    return from + (along_m - from_m) * ahead + left_m * Eigen::Vector2d(-ahead.y(), ahead.x());
  }

 private:
  const Polyline& points_;
  double length_m_;
};

// Walks along way-points at one speed, so as to be at number `meeting` at `time_s`.
Timetable Through(const Polyline& way, double speed_mps, std::size_t meeting, double time_s) {
  const auto table_from = [&](double from_s, std::size_t count) {
    const Eigen::Vector2d first = way[1] - way[0];
    Timetable table(from_s, {way[0].x(), way[0].y(), std::atan2(first.y(), first.x())});
    for (std::size_t i = 1; i < count; ++i) table.GoTo(way[i], speed_mps);
    return table;
  };
  return table_from(time_s - table_from(0.0, meeting + 1).until_s(), way.size());
}

Result<Actor> OnFoot(Random& random, Timetable table) {
  auto shape = MakePedestrian(random.Bits());
  if (!shape) return tl::unexpected(shape.error());
  return Actor{std::move(*shape), std::move(table), std::nullopt};
}

Result<Actor> Driving(VehicleShape vehicle, Random& random, Timetable table) {
  SceneBuilder builder;
  Vehicles(builder, random.Bits()).Park(0.0F, 0.0F, 0.0F, vehicle);
  auto body = World::Build(builder.Take("vehicle"));
  if (!body) return tl::unexpected(body.error());
  ActorShape shape;
  shape.parts.push_back({std::move(*body)});
  return Actor{std::make_shared<const ActorShape>(std::move(shape)), std::move(table),
               std::nullopt};
}

Timetable CrossesOver(const Place& place, const BesidePath& road, Random& random) {
  const double meet_m = random.Uniform(0.25, 0.40) * road.length_m();
  const double aside_m = random.Uniform(1.1, 1.6);
  constexpr double kPavement_m = -2.2;
  const Polyline way = {road.At(meet_m + 26.0, kPavement_m), road.At(meet_m + 10.0, kPavement_m),
                        road.At(meet_m + 4.5, aside_m), road.At(meet_m, aside_m),
                        road.At(meet_m - 30.0, aside_m)};
  return Through(way, random.Uniform(1.15, 1.5), 3, meet_m / place.speed_mps);
}

Timetable DrivesBy(const Place& place, const BesidePath& road, Random& random) {
  const double meet_m = random.Uniform(0.58, 0.75) * road.length_m();
  const double aside_m = random.Uniform(2.1, 2.4);
  Polyline way;
  std::size_t meeting = 0;
  for (double s = road.length_m() + 18.0; s > -16.0; s -= 4.0) {
    if (s >= meet_m) meeting = way.size();
    way.push_back(road.At(s, aside_m));
  }
  return Through(way, random.Uniform(4.5, 6.5), meeting, meet_m / place.speed_mps);
}

Timetable Strolls(const BesidePath& road, Random& random) {
  constexpr double kFarPavement_m = 6.4;
  const double from_m = random.Uniform(10.0, 30.0);
  return Through({road.At(from_m, kFarPavement_m), road.At(from_m + 45.0, kFarPavement_m)},
                 random.Uniform(0.9, 1.3), 0, random.Uniform(0.0, 20.0));
}

// A place between two shares of the path where it is straight, because a robot in a bend would
// pass.
struct OnPath {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
};
OnPath OnStraight(const Polyline& path, Random& random, double from, double to) {
  constexpr double kStretch_m = 1.5;
  constexpr int kAttempts = 50;
  double along_m = 0.0;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    along_m = random.Uniform(from, to) * Length(path);
    const Eigen::Vector2d at = PointAlong(path, along_m);
    const Eigen::Vector2d before = at - PointAlong(path, along_m - kStretch_m);
    const Eigen::Vector2d after = PointAlong(path, along_m + kStretch_m) - at;
    if (before.normalized().dot(after.normalized()) > 0.995) break;
  }
  const motion::Pose2 pose = PoseAlong(path, along_m, kStretch_m);
  return {motion::Position(pose), pose.heading_rad};
}

// Returns the free room beside a place on the path, on the given side.
double RoomBeside(const World& world, const Eigen::Vector2d& at, double towards_rad) {
  constexpr double kFar_m = 5.0;
  constexpr double kHeight_m = 0.5;
  const double z_m = world.FloorHeight(at.x(), at.y()).value_or(0.0) + kHeight_m;
  const Eigen::Vector3d from(at.x(), at.y(), z_m);
  const Eigen::Vector3d towards(std::cos(towards_rad), std::sin(towards_rad), 0.0);
  const auto hit = world.CastRay(from.cast<float>(), towards.cast<float>(), kFar_m);
  return hit ? hit->distance_m : kFar_m;
}

}  // namespace

Result<Actors> RoadTraffic(const Place& place, Role role, std::uint64_t seed) {
  Random random(seed, "traffic");
  const BesidePath road(place.path.points);
  Actors actors;
  if (role == Role::kScout) {
    if (random.Uniform() < 0.4) return actors;
    auto stroller = OnFoot(random, Strolls(road, random));
    if (!stroller) return tl::unexpected(stroller.error());
    actors.push_back(std::move(*stroller));
    return actors;
  }
  auto pedestrian = OnFoot(random, CrossesOver(place, road, random));
  if (!pedestrian) return tl::unexpected(pedestrian.error());
  auto van = Driving(VehicleShape::kVan, random, DrivesBy(place, road, random));
  if (!van) return tl::unexpected(van.error());
  actors.push_back(std::move(*pedestrian));
  actors.push_back(std::move(*van));
  return actors;
}

Result<Actors> PavementTraffic(const Place& place, Role role, std::uint64_t seed) {
  Random random(seed, role == Role::kScout ? "scout's traffic" : "follower's traffic");
  const double whole_s = Length(place.path.points) / place.speed_mps;
  Actors actors;
  for (int i = random.Integer(1, 3); i > 0; --i) {
    const double y_m = random.Uniform(18.6, 19.6);
    Polyline way = {{-12.0, y_m}, {66.0, y_m}};
    if (random.Uniform() < 0.5) std::swap(way[0], way[1]);
    auto walker = OnFoot(
        random, Through(way, random.Uniform(1.1, 1.5), 1, random.Uniform(0.4, 1.4) * whole_s));
    if (!walker) return tl::unexpected(walker.error());
    actors.push_back(std::move(*walker));
  }
  return actors;
}

Result<Actors> TrafficFor(const Place& place, Role role, std::uint64_t seed) {
  return place.traffic != nullptr ? place.traffic(place, role, seed) : Actors{};
}

Result<Actor> SomebodyInTheWay(const Place& place, std::uint64_t seed, double ahead_m) {
  Random random(seed, "encounter");
  auto shape = MakePedestrian(random.Bits(), {.long_coat = true});
  if (!shape) return tl::unexpected(shape.error());
  Encounter encounter;
  encounter.place = OnStraight(place.path.points, random, 0.3, 0.7).at;
  encounter.ahead_m = ahead_m;
  return Actor{std::move(*shape), std::nullopt, encounter};
}

Result<Actor> CartOnThePath(const Place& place, std::uint64_t seed) {
  constexpr float kLong_m = 0.7F;
  constexpr float kWide_m = 0.5F;
  constexpr float kHigh_m = 0.9F;
  Random random(seed, "cart");
  SceneBuilder builder;
  Furniture furniture(builder, random.Bits());
  furniture.Stand(-0.5F * kLong_m, -0.5F * kWide_m, 0.0);
  furniture.Cupboard(kLong_m, kHigh_m, kWide_m);
  auto body = World::Build(builder.Take("cart"));
  if (!body) return tl::unexpected(body.error());
  ActorShape shape;
  shape.parts.push_back({std::move(*body)});
  const OnPath on = OnStraight(place.path.points, random, 0.15, 0.85);
  const double left_rad = on.heading_rad + std::numbers::pi / 2.0;
  const double room_left_m = RoomBeside(*place.world, on.at, left_rad);
  const double room_right_m = RoomBeside(*place.world, on.at, left_rad + std::numbers::pi);
  const double beyond_m = random.Uniform(0.0, 0.15);
  const double left_m = (room_left_m < room_right_m ? 1.0 : -1.0) * (0.5 * kWide_m - beyond_m);
  const Eigen::Vector2d at =
      on.at + left_m * Eigen::Vector2d(std::cos(left_rad), std::sin(left_rad));
  // It stands there before the robot comes, and for longer than the robot may take.
  constexpr double kFrom_s = -1.0;
  constexpr double kFor_s = 1e6;
  Timetable stands(kFrom_s, {at.x(), at.y(), on.heading_rad});
  stands.Stand(kFor_s);
  return Actor{std::make_shared<const ActorShape>(std::move(shape)), std::move(stands),
               std::nullopt};
}

}  // namespace trailcast::sim
