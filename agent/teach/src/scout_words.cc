#include "agent/teach/src/scout_words.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>

#include "services/base/angles.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::agent {
namespace {

using route::Standing;

// Nobody means to teach a shorter route.
constexpr double kLeastRoute_m = 0.2;
// Two to five thousand are usual.
constexpr double kManyBytes_per_m = 10'000.0;
constexpr double kToldTurn_rad = 0.3;

// Returns "route 'hall' revision 2 (a3f9c21@2)".
std::string Which(const route::RouteInfo& route) {
  return fmt::format("{} ({})", route::Describe(route), route::ShortIds().Of(route));
}

// Tells how to activate a teaching that no robot follows by itself, by a server's report if there
// is one.
std::string HowToActivate(const route::RouteInfo& route,
                          const std::optional<exchange::StandingThere>& there) {
  const std::string id = route::ShortIds().Of(route);
  std::string until = "robots go on with the active revision, if there is one,";
  if (there && there->followed.value() > 0) {
    until = fmt::format("robots go on with revision {}", there->followed.value());
  } else if (there) {
    until = "robots follow no revision of the route";
  }
  return fmt::format(
      "{} until an operator {}has them follow this one: 'trailcast routes activate {}'; 'trailcast "
      "routes delete {}' discards it",
      until, route.to_review ? "has looked at it and " : "", id, id);
}

void TellOddities(const route::RouteInfo& route) {
  if (route.length_m < kLeastRoute_m) {
    spdlog::warn(
        "the route is {:.2f} m long: was the robot driven? ('trailcast robot' drives itself with "
        "--scout)",
        route.length_m);
  } else if (route.bytes > kManyBytes_per_m * route.length_m) {
    spdlog::warn(
        "the route takes {:.0f} kB a metre, where 2 to 5 are usual: features are soon lost, so "
        "followers will find few; is what the camera sees bland, blurred, or odometry in other "
        "units than metres?",
        1e-3 * route.bytes / route.length_m);
  }
}

// Tells the standing by a server that has the whole route.
void TellStanding(const route::RouteInfo& route, const exchange::StandingThere& there) {
  switch (there.standing) {
    case Standing::kActive:
      spdlog::info("robots follow {} from now on", Which(route));
      break;
    case Standing::kStaged:
      spdlog::info("{} is {}: {}", Which(route), route::StateText(route),
                   HowToActivate(route, there));
      break;
    case Standing::kRetired:
      spdlog::info("{} was retired by an operator: no robot follows it", Which(route));
      break;
    case Standing::kDeleted:
      break;  // Judge returns an error for it
  }
}

}  // namespace

void TellEarlier(const ScoutLink::Outcome& outcome) {
  for (const auto& [route, there] : outcome.earlier) TellStanding(route, there);
}

void TellTaught(const ScoutLink::Outcome& outcome, bool has_odometry, bool sent) {
  const route::RouteInfo& route = *outcome.route;
  if (has_odometry) TellOddities(route);
  if (outcome.standing) {
    TellStanding(route, *outcome.standing);
  } else if (!sent) {
    spdlog::info(
        "{} is in this robot's store alone: other robots go on with what they have until "
        "'trailcast-agent deliver' gives it to a server",
        Which(route));
  }
}

std::string TaughtText(const ScoutLink::Outcome& outcome, bool interrupted) {
  const route::RouteInfo& route = *outcome.route;
  std::string text = fmt::format("taught {}: {:.1f} m, {} segments", Which(route), route.length_m,
                                 route.segment_count);
  if (interrupted) text += "; cut off: no robot follows it unless an operator activates it";
  if (outcome.refusal) return text + "; kept on the robot: " + *outcome.refusal;
  return text +
         (outcome.delivered ? "; a server has it" : "; kept on the robot until a server is there");
}

void TellNotTaught(double turned_rad) {
  if (std::abs(turned_rad) > kToldTurn_rad) {
    spdlog::warn(
        "the route ends before the turn on the spot at its end, by {:.0f} degrees to the {}: a "
        "turn is taught with what is driven after it",
        Degrees(std::abs(turned_rad)), turned_rad > 0.0 ? "left" : "right");
  }
}

Result<void> Judge(const Result<void>& driven, const ScoutLink::Outcome& outcome, bool sent,
                   const std::string& store_file) {
  if (!driven && outcome.route) {
    return Fail(driven.error().code,
                "{} (the {} segments taught before are kept in {} as {}, cut off: {}; or 'teach "
                "--unfinished go-on' goes on with it)",
                driven.error().message, outcome.route->segment_count, store_file,
                Which(*outcome.route), HowToActivate(*outcome.route, outcome.standing));
  }
  if (!driven) return driven;
  if (!outcome.route) {
    return Fail(ErrorCode::kInvalidArgument,
                "nothing was taught: no segment had enough features or was long enough");
  }
  if (outcome.standing && outcome.standing->standing == Standing::kDeleted) {
    return Fail(ErrorCode::kConflict,
                "{} was deleted by an operator while it was taught: no robot follows it; this "
                "agent's copy stays in {}",
                Which(*outcome.route), store_file);
  }
  if (sent && !outcome.delivered) return tl::unexpected(NotReceipted(outcome, store_file));
  return {};
}

Error NotReceipted(const ScoutLink::Outcome& outcome, const std::string& store_file) {
  return {ErrorCode::kUnavailable,
          fmt::format("{} segments not acknowledged, kept in {}: send them with 'trailcast-agent "
                      "deliver --store {}' when {}; until then robots follow what they followed "
                      "before{}{}",
                      outcome.unreceipted, store_file, store_file,
                      outcome.refusal ? "that is mended" : "a server is there",
                      outcome.refusal ? ": " : "", outcome.refusal.value_or(""))};
}

}  // namespace trailcast::agent
