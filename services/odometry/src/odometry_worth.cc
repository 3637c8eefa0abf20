#include "services/odometry/odometry_worth.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "services/odometry/src/drive_track.h"
#include "services/odometry/src/turn_fit.h"

namespace trailcast::odometry {
namespace {

using Window = DriveTrack::Window;

// Steering leads by some tenths of a second; bad drivers and networks come late by some more.
constexpr LagOptions kLateness{.longest_s = 1.5, .period_s = 0.3, .clear = 0.5};
constexpr double kWindow_s = 0.5;
constexpr double kLeastSpell_s = 0.3;
constexpr double kSpellsApart_s = 0.3;
// Odometry stands below these rates, as frozen odometry does: rounding leaves nothing smaller.
constexpr double kStill_mps = 0.002;
constexpr double kStill_radps = 0.002;
// The picture moves beyond doubt above this flow, in shares of its width.
constexpr double kMoves_flow = 0.03;  // a second
// The picture stands below these, which are a tracker's noise in one window.
constexpr double kStands_rad = 0.003;
constexpr double kStands_down = 0.003;
constexpr double kStands_growth = 0.004;
// Odometry moves beyond doubt above these rates.
constexpr double kDrives_mps = 0.05;
constexpr double kTurns_radps = 0.1;
// Differences of turn rates above these are no noise.
constexpr double kElse_radps = 0.35;
constexpr double kElseNoise = 5.0;
constexpr double kLeastStanding_s = 2.0;
constexpr double kLeastTold_m = 0.5;
// Cameras' focal lengths and useful odometry show a whole turn within these factors. Outside them,
// the place only resembles the first one.
constexpr double kLeastWhole = 0.4;
constexpr double kMostWhole = 2.5;
constexpr double kLeastWholeTold = 0.6;
constexpr double kMostWholeTold = 1.6;

// The state at the end of each step whose window is known.
struct Moment {
  double t_s = 0.0;
  Window window;
};

std::vector<Moment> MomentsOf(std::span<const DriveStep> steps, const DriveTrack& track,
                              double late_s) {
  std::vector<Moment> moments;
  for (const DriveStep& step : steps) {
    const Window window = track.Over(step.t_s, kWindow_s, late_s);
    if (window.known) moments.push_back({step.t_s, window});
  }
  return moments;
}

bool OdometryIsStill(const Window& window) {
  return std::abs(window.driven_m) < kStill_mps * kWindow_s &&
         std::abs(window.odometry_rad) < kStill_radps * kWindow_s;
}

bool PictureStands(const Window& window) {
  return std::abs(window.picture_rad) < kStands_rad && std::abs(window.down_share) < kStands_down &&
         std::abs(window.growth) < kStands_growth;
}

bool IsFrozen(const Window& window) {
  return OdometryIsStill(window) && window.flow > kMoves_flow * kWindow_s;
}

bool MovesAlone(const Window& window) {
  return PictureStands(window) && (std::abs(window.driven_m) > kDrives_mps * kWindow_s ||
                                   std::abs(window.odometry_rad) > kTurns_radps * kWindow_s);
}

double BeyondPicture(const TurnFit& fit, const Window& window, double period_s) {
  return window.odometry_rad - fit.scale * window.picture_rad - fit.drift_radps * period_s;
}

// Returns the runs of consecutive windows for which `is` holds. A spell begins in the middle of its
// first window and ends in the middle of its last.
std::vector<Spell> SpellsOf(Spell::Kind kind, const std::vector<Moment>& moments,
                            const std::function<bool(const Window&)>& is) {
  std::vector<Spell> spells;
  for (const Moment& moment : moments) {
    if (!is(moment.window)) continue;
    const double from_s = moment.t_s - kWindow_s;
    if (!spells.empty() && from_s <= spells.back().to_s + kSpellsApart_s) {
      spells.back().to_s = moment.t_s;
    } else {
      spells.push_back({kind, from_s, moment.t_s});
    }
  }
  std::erase_if(spells, [](const Spell& spell) {
    return spell.to_s - spell.from_s < kWindow_s + kLeastSpell_s;
  });
  return spells;
}

bool IsWithin(const std::vector<Spell>& spells, double t_s) {
  return std::any_of(spells.begin(), spells.end(), [&](const Spell& spell) {
    return t_s >= spell.from_s && t_s - kWindow_s <= spell.to_s;
  });
}

std::optional<TurnFit> FitOutside(const std::vector<Spell>& spells,
                                  const std::vector<Moment>& moments) {
  std::vector<TurnPair> pairs;
  for (const Moment& moment : moments) {
    if (IsWithin(spells, moment.t_s)) continue;
    pairs.push_back({moment.t_s, moment.window.picture_rad / kWindow_s,
                     moment.window.odometry_rad / kWindow_s});
  }
  return FitTurn(pairs);
}

void AddTurnsElse(const TurnFit& fit, const std::vector<Moment>& moments,
                  std::vector<Spell>& spells) {
  const double most_rad = kWindow_s * std::max(kElse_radps, kElseNoise * fit.noise_radps);
  std::vector<Spell> turns = SpellsOf(Spell::Kind::kTurnsElse, moments, [&](const Window& window) {
    return std::abs(BeyondPicture(fit, window, kWindow_s)) > most_rad;
  });
  std::erase_if(turns, [&](const Spell& turn) {
    return std::any_of(spells.begin(), spells.end(), [&](const Spell& other) {
      return turn.from_s < other.to_s && other.from_s < turn.to_s;
    });
  });
  spells.insert(spells.end(), turns.begin(), turns.end());
}

void Measure(const DriveTrack& track, double late_s, const std::optional<TurnFit>& fit,
             Spell& spell) {
  const double period_s = spell.to_s - spell.from_s;
  const Window window = track.Over(spell.to_s, period_s, late_s);
  spell.turned_rad = spell.kind == Spell::Kind::kTurnsElse && fit
                         ? BeyondPicture(*fit, window, period_s)
                         : window.odometry_rad;
  spell.driven_m = window.driven_m;
}

std::optional<double> StandingDrift(const std::vector<Moment>& moments, double step_s) {
  double sum_rad = 0.0;
  double count = 0.0;
  for (const Moment& moment : moments) {
    if (!PictureStands(moment.window) || std::abs(moment.window.driven_m) > kStill_mps) continue;
    sum_rad += moment.window.odometry_rad;
    count += 1.0;
  }
  if (count * step_s < kLeastStanding_s) return std::nullopt;
  return sum_rad / count / kWindow_s;
}

std::optional<WholeTurn> WholeTurnOf(const DriveTrack& track, double late_s,
                                     const std::optional<CameBack>& came_back) {
  if (!came_back) return std::nullopt;
  const double period_s = came_back->t_s - track.begins_s();
  const Window window = track.Over(came_back->t_s, period_s, 0.0);
  // The lateness does not matter if the robot stands or drives straight at both ends.
  const double odometry_rad = ValueAt(track.odometry_turn(), came_back->t_s + late_s) -
                              ValueAt(track.odometry_turn(), track.begins_s() + late_s);
  const double whole_rad = 2.0 * std::numbers::pi;
  const double share = std::abs(window.picture_rad) / whole_rad;
  if (share < kLeastWhole || share > kMostWhole) return std::nullopt;
  const double sign = window.picture_rad > 0.0 ? 1.0 : -1.0;
  const double turned_rad = sign * whole_rad + came_back->turned_rad;
  const double told = std::abs(odometry_rad / turned_rad);
  if (told < kLeastWholeTold || told > kMostWholeTold) return std::nullopt;
  return WholeTurn{whole_rad * odometry_rad / turned_rad,
                   whole_rad * window.picture_rad / turned_rad};
}

std::optional<ToldWay> ToldWayOf(std::span<const DriveStep> steps) {
  ToldWay way;
  for (const DriveStep& step : steps) {
    if (!step.told || step.odometry_broke) continue;
    way.told_m += step.told->linear_mps * step.dt_s;
    way.driven_m += step.moved.distance_m;
  }
  return std::abs(way.told_m) < kLeastTold_m ? std::nullopt : std::optional(way);
}

void SumUp(std::span<const DriveStep> steps, OdometryWorth& worth) {
  for (const DriveStep& step : steps) {
    worth.lasts_s += step.dt_s;
    worth.driven_m += std::abs(step.moved.distance_m);
    worth.turned_rad += std::abs(step.moved.heading_change_rad);
    if (step.odometry_broke) worth.breaks_s.push_back(step.t_s);
    if (!step.picture) continue;
    worth.seen_share += 1.0 / static_cast<double>(steps.size());
    worth.picture_turned_rad += std::abs(step.picture->turn_rad);
  }
}

}  // namespace

OdometryWorth Weigh(std::span<const DriveStep> steps, const std::optional<CameBack>& came_back) {
  OdometryWorth worth;
  SumUp(steps, worth);
  const DriveTrack track(steps);
  worth.late = LagOf(track.odometry_turn(), track.picture_turn(), kLateness);
  const double late_s = worth.late ? worth.late->s : 0.0;
  const std::vector<Moment> moments = MomentsOf(steps, track, late_s);
  worth.spells = SpellsOf(Spell::Kind::kFrozen, moments, IsFrozen);
  const auto alone = SpellsOf(Spell::Kind::kMovesAlone, moments, MovesAlone);
  worth.spells.insert(worth.spells.end(), alone.begin(), alone.end());
  if (worth.late) worth.turn = FitOutside(worth.spells, moments);
  if (worth.turn) AddTurnsElse(*worth.turn, moments, worth.spells);
  for (Spell& spell : worth.spells) Measure(track, late_s, worth.turn, spell);
  std::sort(worth.spells.begin(), worth.spells.end(),
            [](const Spell& a, const Spell& b) { return a.from_s < b.from_s; });
  worth.standing_drift_radps =
      StandingDrift(moments, worth.lasts_s / static_cast<double>(steps.size()));
  worth.whole_turn = WholeTurnOf(track, late_s, came_back);
  worth.told = ToldWayOf(steps);
  return worth;
}

}  // namespace trailcast::odometry
