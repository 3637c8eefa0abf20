#include "services/fleet/network_client.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "services/base/local_time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/ask.h"
#include "services/fleet/draw.h"
#include "services/mission/orders.h"
#include "services/network/words.h"
#include "services/program/json.h"
#include "services/route/route_ref.h"

namespace trailcast::fleet {
namespace {

using program::Json;
using program::Rounded;
using std::chrono::milliseconds;
using Lines = std::vector<std::string>;

Result<Lines> AskForLines(exchange::RouteExchange& exchange, exchange::NetworkRequest question,
                          milliseconds timeout) {
  Lines all;
  while (true) {
    question.request = DrawNumber();
    auto reply =
        Ask<exchange::NetworkReply>(exchange, question.client, question.request, question, timeout);
    if (!reply) return tl::unexpected(reply.error());
    std::move(reply->lines.begin(), reply->lines.end(), std::back_inserter(all));
    // A reply that does not go beyond this page is the last one.
    if (reply->next <= question.first) return all;
    question.first = reply->next;
  }
}

Json PlaceJson(const network::Place& place) {
  return {{"route", place.route}, {"along_m", Rounded(place.along_m, 100.0)}};
}

Json JunctionJson(const network::Junction& junction) {
  Json lie;
  if (junction.lie) {
    lie = {{"ahead_m", Rounded(junction.lie->ahead_m, 100.0)},
           {"left_m", Rounded(junction.lie->left_m, 100.0)},
           {"turn_rad", Rounded(junction.lie->turn_rad, 1e4)}};
  }
  return {{"from", PlaceJson(junction.from)},
          {"to", PlaceJson(junction.to)},
          {"both", junction.both},
          {"lie", std::move(lie)}};
}

// Adds a member to an object.
Json With(Json object, const char* name, Json value) {
  object[name] = std::move(value);
  return object;
}

Json PartJson(const std::string& route, double from_m, double to_m) {
  return {{"route", route}, {"from_m", Rounded(from_m, 100.0)}, {"to_m", Rounded(to_m, 100.0)}};
}

// A null end is the route's end.
Json ConditionJson(const network::Condition& condition) {
  Json json = PartJson(condition.route, condition.from_m, condition.to_m);
  if (condition.to_m >= network::kToTheEnd_m) json["to_m"] = nullptr;
  if (!condition.closed && !condition.backed) {
    json["speed"] = condition.speed;
    json["cost"] = condition.cost;
  }
  return json;
}

Json LaneJson(const network::Lane& lane, const Lines& taken_by) {
  Json parts = Json::array();
  for (const network::Part& part : lane.parts) {
    parts.push_back(PartJson(part.route, part.from_m, part.to_m));
  }
  return {{"parts", std::move(parts)}, {"taken_by", taken_by}};
}

Json LostJson(const network::LostSection& lost) {
  Json json = PartJson(lost.route, lost.from_m, lost.to_m);
  json.update({{"passed", lost.passed}, {"lost", lost.lost}, {"cost", lost.cost}});
  return json;
}

// Returns whether a change is about one of these routes. An operator may have given the beginning
// of an id.
bool IsAbout(const Lines& routes, std::span<const std::string> of) {
  return std::any_of(routes.begin(), routes.end(), [&](const std::string& route) {
    return std::any_of(of.begin(), of.end(), [&](const std::string& asked) {
      return asked == route || (route::LooksLikeId(route) && asked.starts_with(route));
    });
  });
}

// Returns the sections of a path, or none for orders that are no path.
std::vector<network::Section> SectionsOf(const Lines& way) {
  const auto tasks = mission::ParseOrders(fmt::format("goto there {}", fmt::join(way, " ")))
                         .value_or(std::vector<mission::Task>{});
  std::vector<network::Section> sections;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const mission::Task& task = tasks[i];
    if (task.kind != mission::Task::Kind::kFollow) continue;
    sections.push_back({.route = task.route.route,
                        .from_m = task.from_m,
                        .to_m = task.to_m,
                        .speed = task.speed_factor,
                        .turn_rad = mission::TurnBefore(tasks, i)});
  }
  return sections;
}

}  // namespace

Result<Lines> AskForNetwork(exchange::RouteExchange& exchange, const AgentId& client,
                            milliseconds timeout) {
  return AskForLines(exchange, {.client = client}, timeout);
}

Result<Lines> AskForWay(exchange::RouteExchange& exchange, const AgentId& client,
                        const std::string& from, const std::string& to, milliseconds timeout) {
  return AskForLines(exchange, {.client = client, .words = "way " + from + " " + to}, timeout);
}

Result<network::Passings> AskWhatPasses(exchange::RouteExchange& exchange, const AgentId& client,
                                        const std::string& place, milliseconds timeout) {
  return AskForLines(exchange, {.client = client, .words = network::WhatPasses(place)}, timeout)
      .map(network::ParsePassings);
}

Result<network::History> AskForChanges(exchange::RouteExchange& exchange, const AgentId& client,
                                       std::int64_t since_unix_ms, milliseconds timeout) {
  return AskForLines(exchange, {.client = client, .words = network::ChangesSince(since_unix_ms)},
                     timeout)
      .map(network::ParseHistory);
}

Result<std::string> OrdersAlong(const Lines& way, const std::string& to) {
  if (way.empty()) return std::string();
  std::string orders = fmt::format("goto {} {}", to, fmt::join(way, " "));
  if (orders.size() <= exchange::kMaxLineBytes) return orders;
  return Fail(ErrorCode::kInvalidArgument,
              "the way has {} sections, more than one mission holds: send it to a place on the "
              "way first ('trailcast network way' shows it)",
              way.size());
}

Result<Lines> AskToJoin(exchange::RouteExchange& exchange, const AgentId& client,
                        const std::string& words, milliseconds timeout) {
  const exchange::NetworkEdit edit{.client = client, .request = DrawNumber(), .words = words};
  auto reply = Ask<exchange::NetworkReply>(exchange, client, edit.request, edit, timeout);
  if (!reply) return tl::unexpected(reply.error());
  return std::move(reply->lines);
}

std::string NetworkText(const Lines& lines) {
  if (lines.empty()) return "no routes are joined, and none is closed\n";
  std::string text;
  for (const std::string& line : lines) {
    const network::Listed listed = network::ParseListed(line);
    if (listed.route) {
      text += line + " m\n";
    } else if (listed.lost) {
      text += network::Describe(*listed.lost) + "\n";
    } else if (listed.charging) {
      text += listed.charging->robot + " " + listed.charging->text + "\n";
    } else if (!listed.used) {
      text += line.substr(network::kUnused.size()) +
              "   (not used: robots follow another revision, or none)\n";
    } else {
      text += line + "\n";
    }
  }
  return text;
}

Json NetworkJson(const Lines& lines) {
  Json network;
  for (const char* name : {"routes", "joints", "closed", "backed", "limits", "narrow", "names",
                           "proposed", "lost", "charging"}) {
    network[name] = Json::array();
  }
  network["charge"] = nullptr;
  for (const std::string& line : lines) {
    const auto [used, route, edit, proposal, lost, charging, taken_by] = network::ParseListed(line);
    if (route) {
      network["routes"].push_back(
          {{"route", route->name}, {"length_m", Rounded(route->length_m, 100.0)}});
    }
    if (proposal) {
      network["proposed"].push_back(With(JunctionJson(proposal->junction), "confidence",
                                         Rounded(proposal->confidence, 100.0)));
    }
    if (lost) network["lost"].push_back(LostJson(*lost));
    if (charging) {
      network["charging"].push_back({{"robot", charging->robot}, {"text", charging->text}});
    }
    if (!edit) continue;
    if (edit->kind == network::Edit::Kind::kJoin) {
      network["joints"].push_back(With(JunctionJson(edit->junction), "used", used));
    } else if (edit->kind == network::Edit::Kind::kNarrow) {
      network["narrow"].push_back(LaneJson(edit->lane, taken_by));
    } else if (edit->kind == network::Edit::Kind::kName) {
      network["names"].push_back({{"name", edit->named.name},
                                  {"place", PlaceJson(edit->named.place)},
                                  {"home", edit->named.home},
                                  {"dock", edit->named.dock},
                                  {"taken_by", taken_by},
                                  {"used", used}});
    } else if (edit->kind == network::Edit::Kind::kCharge) {
      if (edit->charge) {
        network["charge"] = {{"below_percent", edit->charge->below_percent},
                             {"until_percent", edit->charge->until_percent}};
      }
    } else {
      const network::Condition& condition = edit->condition;
      network[condition.closed   ? "closed"
              : condition.backed ? "backed"
                                 : "limits"]
          .push_back(ConditionJson(condition));
    }
  }
  return network;
}

std::string PassingText(const network::Passings& passings) {
  const std::string place = network::ToText(passings.place);
  if (passings.routes.empty()) {
    return fmt::format(
        "no other route is known to pass at {}: where one does, 'trailcast network join {} "
        "ROUTE@METRES' says so; 'trailcast network proposals' lists where scouts saw that routes "
        "meet\n",
        place, place);
  }
  std::size_t width = 0;
  for (const network::Passing& each : passings.routes) {
    width = std::max(width, network::ToText(each.at).size());
  }
  std::string text = place + "\n";
  const network::Junction* proposed = nullptr;
  for (const network::Passing& each : passings.routes) {
    text += fmt::format("  {:<{}}  {}\n", network::ToText(each.at), width,
                        each.confidence
                            ? network::ToText(network::Proposal{each.junction, *each.confidence})
                            : network::ToText(each.junction));
    if (each.confidence && proposed == nullptr) proposed = &each.junction;
  }
  if (proposed == nullptr) return text;
  return text + fmt::format(
                    "what is proposed is no way until somebody has looked: 'trailcast network "
                    "confirm {} {}', or refuse\n",
                    network::ToText(proposed->from), network::ToText(proposed->to));
}

Json PassingJson(const network::Passings& passings) {
  Json routes = Json::array();
  for (const network::Passing& each : passings.routes) {
    routes.push_back({{"at", PlaceJson(each.at)},
                      {"joined", !each.confidence},
                      {"confidence", program::RoundedOrNull(each.confidence, 100.0)},
                      {"joint", JunctionJson(each.junction)}});
  }
  return {{"place", PlaceJson(passings.place)}, {"passing", std::move(routes)}};
}

std::string WayText(const Lines& way) {
  if (way.empty()) return "it is there already\n";
  std::string text;
  for (const std::string& section : way) text += section + "\n";
  return text + fmt::format("{:.1f} m\n", network::LengthOf(SectionsOf(way)));
}

Json WayJson(const Lines& way) {
  const auto way_sections = SectionsOf(way);
  Json sections = Json::array();
  for (const network::Section& each : way_sections) {
    Json section = With(PartJson(each.route, each.from_m, each.to_m), "speed", each.speed);
    if (each.turn_rad != 0.0) section["turn_rad"] = Rounded(each.turn_rad, 1000.0);
    sections.push_back(std::move(section));
  }
  return {{"length_m", Rounded(network::LengthOf(way_sections), 100.0)},
          {"stretches", std::move(sections)}};
}

std::string ChangesText(const network::History& history, std::int64_t since_unix_ms,
                        std::size_t limit) {
  const std::size_t shown = std::min(limit, history.changes.size());
  std::size_t width = 0;
  for (const network::Change& change : history.changes) width = std::max(width, change.by.size());
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const network::Change& change = *(history.changes.rbegin() + static_cast<std::ptrdiff_t>(i));
    text += fmt::format("{}  {:<{}}  {}\n", LocalText(change.at_unix_ms),
                        change.by.empty() ? "-" : change.by, width, change.what);
  }
  if (text.empty()) {
    text = fmt::format("nothing was changed since {}\n", LocalText(since_unix_ms));
  }
  if (shown < history.changes.size()) {
    text += fmt::format("{} of {} changes; --limit shows more\n", shown, history.changes.size());
  }
  if (history.kept_since_unix_ms > since_unix_ms) {
    text += fmt::format("kept since {} alone: what was changed before is not known\n",
                        LocalText(history.kept_since_unix_ms));
  }
  return text;
}

Json ChangesJson(const network::History& history, std::size_t limit,
                 std::span<const std::string> of) {
  const auto routes = network::RoutesOf(history.changes);
  Json changes = Json::array();
  std::size_t total = 0;
  for (std::size_t i = history.changes.size(); i-- > 0;) {
    if (!of.empty() && !IsAbout(routes[i], of)) continue;
    if (++total > limit) continue;
    const network::Change& change = history.changes[i];
    changes.push_back({{"at_unix_ms", change.at_unix_ms},
                       {"by", change.by.empty() ? Json(nullptr) : Json(change.by)},
                       {"what", change.what},
                       {"routes", routes[i]}});
  }
  return {{"kept_since_unix_ms", history.kept_since_unix_ms},
          {"total", total},
          {"changes", std::move(changes)}};
}

}  // namespace trailcast::fleet
