#include "services/tool/odometry_checkup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "services/base/angles.h"
#include "services/odometry/odometry_worth.h"
#include "services/route/usual_camera.h"

namespace trailcast::tool {
namespace {

using odometry::OdometryWorth;
using odometry::Spell;
using odometry::TurnFit;
using Grade = Finding::Grade;

constexpr double kSeenEnough = 0.7;
constexpr double kTurnedEnough_rad = 1.0;
constexpr double kDrivenEnough_m = 1.0;
constexpr double kInTime_s = 0.1;
constexpr double kSameTurn = 0.12;
constexpr double kSteady = 2.0;  // ratio of the largest to the least
// Lenses, and a camera that looks a few degrees aside, cause about as much.
constexpr double kLeastDrift_radps = 0.012;
constexpr double kDriftNoise = 1.2;
constexpr double kStandingDrift_radps = 0.01;
constexpr double kSameWay = 0.15;
// Robots' cameras have fields of view within these bounds.
constexpr double kNarrow_deg = 25.0;
constexpr double kWide_deg = 150.0;
constexpr std::size_t kMostTold = 3;

const char* SideOf(double turn_rad) { return turn_rad > 0.0 ? "left" : "right"; }

Finding JudgeDrive(const agent::DriveLook& drive, const OdometryWorth& worth) {
  const std::string what = fmt::format(
      "drive: {:.0f} s, {} pictures; odometry drives {:.1f} m and turns by {:.0f} degrees to "
      "either "
      "side",
      worth.lasts_s, drive.pictures, worth.driven_m, Degrees(worth.turned_rad));
  if (worth.seen_share < kSeenEnough) {
    return {Grade::kWarning,
            fmt::format("{}, but only {:.0f} % of the pictures can be held against those before "
                        "them",
                        what, 100.0 * worth.seen_share),
            "they show too little, or move too fast for how many come: drive slower, with more to "
            "see"};
  }
  if (worth.picture_turned_rad < kTurnedEnough_rad && worth.turned_rad < kTurnedEnough_rad) {
    return {Grade::kWarning, what,
            "that is too little to judge turns by: drive some metres with a turn to either side"};
  }
  if (worth.driven_m < kDrivenEnough_m) {
    return {Grade::kWarning, what, "that is little: drive some metres"};
  }
  return {Grade::kGood, what, ""};
}

bool Drifts(const OdometryWorth& worth) {
  return std::abs(worth.turn->drift_radps) >
             std::max(kLeastDrift_radps, kDriftNoise * worth.turn->noise_radps) ||
         std::abs(worth.standing_drift_radps.value_or(0.0)) > kStandingDrift_radps;
}

// Tells that both turn, or that one of them should.
bool TurnsEnough(const OdometryWorth& worth) {
  return std::max(worth.picture_turned_rad, worth.turned_rad) >= kTurnedEnough_rad;
}

Finding JudgeNoLag(const OdometryWorth& worth) {
  if (worth.turned_rad < 0.2 * worth.picture_turned_rad) {
    return {Grade::kBad,
            fmt::format("turns: odometry hardly turns while the picture does, by {:.0f} degrees",
                        Degrees(worth.picture_turned_rad)),
            "does its driver fill in the orientation? Trailcast takes the robot to drive straight "
            "on and follows by pictures alone as soon as these contradict it"};
  }
  return {Grade::kBad, "turns: odometry's have nothing to do with the picture's",
          "are both of this robot and this drive, and their clocks within a second and a half? "
          "Without odometry (--odom-topic '') Trailcast goes by pictures and commands"};
}

Finding JudgeDelay(const odometry::Lag& late) {
  const std::string what =
      fmt::format("delay: odometry turns {:.2f} s {} the picture (they agree to {:.2f})",
                  std::abs(late.s), late.s > 0.0 ? "after" : "before", std::abs(late.correlation));
  if (std::abs(late.s) <= kInTime_s) return {Grade::kGood, what, ""};
  return {Grade::kWarning, what,
          fmt::format("Trailcast goes by the stamps and does not make up for it: have the {} stamp "
                      "what it publishes when it is {}",
                      late.s > 0.0 ? "base" : "camera's driver",
                      late.s > 0.0 ? "measured, and publish what the wheels do, not what is "
                                     "filtered for long"
                                   : "taken; commands that are summed up instead of wheels that "
                                     "are counted lead, too")};
}

constexpr const char* kSetTurn =
    "multiply its wheel separation (a car's: its wheel base; a gyro: divide its scale) by {:.2f}. "
    "Trailcast learns how long odometry's metres are, not its turns: it steers by what it sees, "
    "and believes odometry less while that contradicts it";

Finding JudgeTurnScale(double scale, const std::string& by) {
  const std::string what =
      fmt::format("turns: odometry counts each {:.2f} times, by {}", scale, by);
  if (std::abs(scale - 1.0) <= kSameTurn) return {Grade::kGood, what, ""};
  return {Grade::kWarning, what, fmt::format(kSetTurn, scale)};
}

// If nothing tells the focal length, this reports the one that odometry implies.
Finding JudgeUnscaled(const TurnFit& turn) {
  const double implied_deg = Degrees(FieldOfView(route::kUsualFocalShare / turn.scale));
  const std::string what = fmt::format(
      "turns: odometry and picture turn the same way; they turn as far if the camera sees {:.0f} "
      "degrees across",
      implied_deg);
  const std::string advice =
      "whether it does is not known: give --fov, or drive until what was seen first is seen again "
      "after a whole turn";
  const bool may_be = implied_deg > kNarrow_deg && implied_deg < kWide_deg;
  return {may_be ? Grade::kGood : Grade::kWarning, may_be ? what : what + ", which hardly any does",
          advice};
}

void JudgeTurns(const OdometryWorth& worth, std::optional<double> field_of_view_rad,
                std::vector<Finding>& findings) {
  if (!worth.turn) {
    findings.push_back({Grade::kWarning, "turns: too few are clear to judge odometry's by",
                        "drive a longer way, with turns to either side"});
    return;
  }
  const TurnFit& turn = *worth.turn;
  if (turn.scale < 0.0) {
    findings.push_back(
        {Grade::kBad, "turns: odometry turns to the other side than the picture shows",
         "counter-clockwise is positive (REP 103); or the picture is mirrored or upside down (then "
         "turn the camera, or add 180 to --camera-roll)"});
    return;
  }
  // A steady drift is no fault of each turn.
  if (worth.whole_turn && !Drifts(worth)) {
    const double scale = std::abs(worth.whole_turn->odometry_rad) / (2.0 * std::numbers::pi);
    findings.push_back(JudgeTurnScale(scale, "a whole turn, after which the first view came back"));
  } else if (field_of_view_rad) {
    findings.push_back(JudgeTurnScale(
        turn.scale,
        fmt::format("a camera that sees {:.0f} degrees across", Degrees(*field_of_view_rad))));
  } else {
    findings.push_back(JudgeUnscaled(turn));
  }
  if (turn.least_scale <= 0.0 || turn.most_scale > kSteady * turn.least_scale) {
    findings.push_back(
        {Grade::kWarning,
         fmt::format("turns: how far odometry turns for what the picture does is not steady: "
                     "{:.2f} to {:.2f} times the usual in parts of the drive",
                     turn.least_scale / turn.scale, turn.most_scale / turn.scale),
         "slipping wheels, carpets, loads; Trailcast believes odometry the less the more it "
         "contradicts the pictures"});
  }
}

Finding JudgeDrift(const OdometryWorth& worth) {
  const double drift_radps = worth.turn->drift_radps;
  std::string what =
      fmt::format("drift: {:.1f} degrees a second to the {} that the picture does not show",
                  std::abs(Degrees(drift_radps)), SideOf(drift_radps));
  const double speed_mps = worth.lasts_s > 0.0 ? worth.driven_m / worth.lasts_s : 0.0;
  if (speed_mps > kStandingDrift_radps) {
    what += fmt::format(", or {:.1f} a metre", std::abs(Degrees(drift_radps / speed_mps)));
  }
  const double standing_radps = worth.standing_drift_radps.value_or(0.0);
  const bool stands_too = std::abs(standing_radps) > kStandingDrift_radps;
  if (stands_too) {
    what += fmt::format("; {:.1f} a second to the {} while it stands",
                        std::abs(Degrees(standing_radps)), SideOf(standing_radps));
  }
  if (!Drifts(worth)) {
    what += fmt::format("; turns are told to {:.1f} a second", Degrees(worth.turn->noise_radps));
    return {Grade::kGood, what, ""};
  }
  if (worth.whole_turn) {
    what += fmt::format("; a whole turn of 360 degrees is told as {:.0f}",
                        std::abs(Degrees(worth.whole_turn->odometry_rad)));
  }
  return {Grade::kWarning, what,
          stands_too ? "a gyro's bias: have its driver calibrate it while the robot stands. "
                       "Trailcast bears it as far as what it sees corrects it"
                     : "wheels of unequal size, a gyro's bias, or a camera that does not look "
                       "straight ahead. Trailcast bears it as far as what it sees corrects it"};
}

std::string Told(const std::vector<std::string>& each) {
  const std::size_t told = std::min(each.size(), kMostTold);
  std::string text = fmt::format("{}", fmt::join(std::span(each).first(told), "; "));
  if (each.size() > told) text += fmt::format("; and {} more", each.size() - told);
  return text;
}

std::string SpellText(const Spell& spell, double begins_s) {
  const std::string when =
      fmt::format("{:.1f} s for {:.1f} s", spell.from_s - begins_s, spell.to_s - spell.from_s);
  switch (spell.kind) {
    case Spell::Kind::kFrozen:
      return when;
    case Spell::Kind::kMovesAlone:
      return fmt::format("{} ({:.2f} m, {:.0f} degrees)", when, spell.driven_m,
                         Degrees(spell.turned_rad));
    case Spell::Kind::kTurnsElse:
      return fmt::format("{} ({:.0f} degrees too far to the {})", when,
                         std::abs(Degrees(spell.turned_rad)), SideOf(spell.turned_rad));
  }
  return when;
}

void JudgeSpells(Spell::Kind kind, const OdometryWorth& worth, double begins_s,
                 const std::string& what, const std::string& advice,
                 std::vector<Finding>& findings) {
  std::vector<std::string> each;
  for (const Spell& spell : worth.spells) {
    if (spell.kind == kind) each.push_back(SpellText(spell, begins_s));
  }
  if (each.empty()) return;
  findings.push_back({Grade::kWarning, fmt::format("{}, from {}", what, Told(each)), advice});
}

void JudgeAllSpells(const OdometryWorth& worth, double begins_s, std::vector<Finding>& findings) {
  JudgeSpells(Spell::Kind::kFrozen, worth, begins_s,
              "frozen: odometry stands while the picture moves",
              "do encoders and their driver run all the time? Trailcast goes by pictures and "
              "commands meanwhile",
              findings);
  JudgeSpells(Spell::Kind::kMovesAlone, worth, begins_s,
              "slip: odometry moves while the picture stands",
              "wheels that spin, encoders that count noise, or a camera that gives one picture "
              "again and again. Trailcast believes odometry less where views contradict it",
              findings);
  JudgeSpells(Spell::Kind::kTurnsElse, worth, begins_s,
              "slip: odometry turns otherwise than the picture",
              "a wheel that spins or blocks, or somebody before the camera. Trailcast believes "
              "odometry less where views contradict it",
              findings);
  std::vector<std::string> breaks;
  for (const double at_s : worth.breaks_s)
    breaks.push_back(fmt::format("{:.1f} s", at_s - begins_s));
  if (breaks.empty()) return;
  findings.push_back(
      {Grade::kWarning, fmt::format("jumps: odometry jumps, or is silent, at {}", Told(breaks)),
       "publish odometry whose frame goes on (no localisation's corrections in it, no node that "
       "begins anew). Trailcast leaves the jump out and goes by pictures over it"});
}

Finding JudgeWay(const OdometryWorth& worth) {
  if (!worth.told) {
    return {
        Grade::kGood,
        fmt::format("metres: {:.1f} by odometry, which pictures alone cannot tell", worth.driven_m),
        "nobody was heard to tell the base anything: hold it against a tape measure. On a route "
        "Trailcast learns how long odometry's metres are"};
  }
  const double scale = worth.told->driven_m / worth.told->told_m;
  const std::string what = fmt::format(
      "metres: odometry drives {:.1f} where the base was told {:.1f}, {:.2f} times as far",
      worth.told->driven_m, worth.told->told_m, scale);
  if (std::abs(scale - 1.0) <= kSameWay) return {Grade::kGood, what, ""};
  return {Grade::kWarning, what,
          "hold it against a tape measure: either wheels are counted wrong (set their radius) or "
          "the base does not drive what it is told. On a route Trailcast learns how long "
          "odometry's metres are"};
}

}  // namespace

double FieldOfView(double focal_share) { return 2.0 * std::atan(0.5 / focal_share); }
double FocalShare(double field_of_view_rad) { return 0.5 / std::tan(0.5 * field_of_view_rad); }

std::vector<Finding> JudgeOdometry(const agent::DriveLook& drive,
                                   std::optional<double> field_of_view_rad) {
  if (!drive.has_odometry) {
    return {{Grade::kBad, "odometry: there is none",
             "name its topic or file; without, Trailcast goes by pictures and commands"}};
  }
  if (drive.steps.empty()) {
    return {{Grade::kBad, "drive: fewer than two pictures came", "look at the camera first"}};
  }
  const OdometryWorth worth = odometry::Weigh(drive.steps, drive.came_back);
  std::vector<Finding> findings{JudgeDrive(drive, worth)};
  if (worth.late) {
    findings.push_back(JudgeDelay(*worth.late));
    JudgeTurns(worth, field_of_view_rad, findings);
    if (worth.turn && worth.turn->scale > 0.0) findings.push_back(JudgeDrift(worth));
  } else if (TurnsEnough(worth)) {
    findings.push_back(JudgeNoLag(worth));
  }
  JudgeAllSpells(worth, drive.begins_s, findings);
  if (!drive.news.empty()) {
    findings.push_back({Grade::kWarning, fmt::format("clocks and messages: {}", Told(drive.news)),
                        "set clocks before a drive, not on it (chrony); numbers that are none come "
                        "from a driver that is not ready. Trailcast leaves such messages out"});
  }
  findings.push_back(JudgeWay(worth));
  return findings;
}

}  // namespace trailcast::tool
