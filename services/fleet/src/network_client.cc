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

using program::JsonList;
using program::JsonText;
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
    // A server's pages go on, or end.
    if (reply->next <= question.first) return all;
    question.first = reply->next;
  }
}

std::string JsonTexts(const Lines& texts) {
  Lines all;
  for (const std::string& text : texts) all.push_back(JsonText(text));
  return JsonList(all);
}

std::string PlaceJson(const network::Place& place) {
  return fmt::format("{{\"route\": {}, \"along_m\": {:.2f}}}", JsonText(place.route),
                     place.along_m);
}

// What is between the braces of a joint's object.
std::string JointFields(const network::Joint& joint) {
  std::string lie = "null";
  if (joint.lie) {
    lie = fmt::format("{{\"ahead_m\": {:.2f}, \"left_m\": {:.2f}, \"turn_rad\": {:.4f}}}",
                      joint.lie->ahead_m, joint.lie->left_m, joint.lie->turn_rad);
  }
  return fmt::format("\"from\": {}, \"to\": {}, \"both\": {}, \"lie\": {}", PlaceJson(joint.from),
                     PlaceJson(joint.to), joint.both, lie);
}

std::string JointJson(const network::Joint& joint, bool used) {
  return fmt::format("{{{}, \"used\": {}}}", JointFields(joint), used);
}

std::string ProposalJson(const network::Proposal& proposal) {
  return fmt::format("{{{}, \"confidence\": {:.2f}}}", JointFields(proposal.joint),
                     proposal.confidence);
}

// null: up to the route's end.
std::string ConditionJson(const network::Condition& condition) {
  const std::string to =
      condition.to_m >= network::kToTheEnd_m ? "null" : fmt::format("{:.2f}", condition.to_m);
  std::string text = fmt::format("{{\"route\": {}, \"from_m\": {:.2f}, \"to_m\": {}",
                                 JsonText(condition.route), condition.from_m, to);
  if (!condition.closed && !condition.backed) {
    text += fmt::format(", \"speed\": {:g}, \"cost\": {:g}", condition.speed, condition.cost);
  }
  return text + "}";
}

std::string LaneJson(const network::Lane& lane, const Lines& taken_by) {
  Lines parts;
  for (const network::Part& part : lane.parts) {
    parts.push_back(fmt::format("{{\"route\": {}, \"from_m\": {:.2f}, \"to_m\": {:.2f}}}",
                                JsonText(part.route), part.from_m, part.to_m));
  }
  return fmt::format("{{\"parts\": {}, \"taken_by\": {}}}", JsonList(parts), JsonTexts(taken_by));
}

std::string LostJson(const network::LostStretch& lost) {
  return fmt::format(
      "{{\"route\": {}, \"from_m\": {:.2f}, \"to_m\": {:.2f}, \"passed\": {:g}, \"lost\": {:g}, "
      "\"cost\": {:g}}}",
      JsonText(lost.route), lost.from_m, lost.to_m, lost.passed, lost.lost, lost.cost);
}

std::string RouteJson(const network::Route& route) {
  return fmt::format("{{\"route\": {}, \"length_m\": {:.2f}}}", JsonText(route.name),
                     route.length_m);
}

// One of these; an operator may have said the beginning of an id.
bool IsAbout(const Lines& routes, std::span<const std::string> of) {
  return std::any_of(routes.begin(), routes.end(), [&](const std::string& route) {
    return std::any_of(of.begin(), of.end(), [&](const std::string& asked) {
      return asked == route || (route::LooksLikeId(route) && asked.starts_with(route));
    });
  });
}

// The stretches; of orders that are no way, none.
std::vector<network::Stretch> StretchesOf(const Lines& way) {
  const auto tasks = mission::ParseOrders(fmt::format("goto there {}", fmt::join(way, " ")))
                         .value_or(std::vector<mission::Task>{});
  std::vector<network::Stretch> stretches;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const mission::Task& task = tasks[i];
    if (task.kind != mission::Task::Kind::kFollow) continue;
    stretches.push_back({.route = task.route.route,
                         .from_m = task.from_m,
                         .to_m = task.to_m,
                         .speed = task.speed_factor,
                         .turn_rad = mission::TurnBefore(tasks, i)});
  }
  return stretches;
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
              "the way has {} stretches, more than one mission holds: send it to a place on the "
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
    } else if (!listed.used) {
      text += line.substr(network::kUnused.size()) +
              "   (not used: robots follow another revision, or none)\n";
    } else {
      text += line + "\n";
    }
  }
  return text;
}

std::string NetworkJson(const Lines& lines) {
  Lines routes;
  Lines joints;
  Lines closed;
  Lines backed;
  Lines limits;
  Lines narrow;
  Lines names;
  Lines proposed;
  Lines lost_on;
  for (const std::string& line : lines) {
    const auto [used, route, edit, proposal, lost, taken_by] = network::ParseListed(line);
    if (route) routes.push_back(RouteJson(*route));
    if (proposal) proposed.push_back(ProposalJson(*proposal));
    if (lost) lost_on.push_back(LostJson(*lost));
    if (!edit) continue;
    if (edit->kind == network::Edit::Kind::kJoin) {
      joints.push_back(JointJson(edit->joint, used));
    } else if (edit->kind == network::Edit::Kind::kNarrow) {
      narrow.push_back(LaneJson(edit->lane, taken_by));
    } else if (edit->kind == network::Edit::Kind::kName) {
      names.push_back(fmt::format("{{\"name\": {}, \"place\": {}, \"used\": {}}}",
                                  JsonText(edit->named.name), PlaceJson(edit->named.place), used));
    } else {
      Lines& its = edit->condition.closed ? closed : edit->condition.backed ? backed : limits;
      its.push_back(ConditionJson(edit->condition));
    }
  }
  return fmt::format(
      "{{\"routes\": {}, \"joints\": {}, \"closed\": {}, \"backed\": {}, \"limits\": {}, "
      "\"narrow\": {}, \"names\": {}, \"proposed\": {}, \"lost\": {}}}\n",
      JsonList(routes), JsonList(joints), JsonList(closed), JsonList(backed), JsonList(limits),
      JsonList(narrow), JsonList(names), JsonList(proposed), JsonList(lost_on));
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
  const network::Joint* proposed = nullptr;
  for (const network::Passing& each : passings.routes) {
    text += fmt::format("  {:<{}}  {}\n", network::ToText(each.at), width,
                        each.confidence
                            ? network::ToText(network::Proposal{each.joint, *each.confidence})
                            : network::ToText(each.joint));
    if (each.confidence && proposed == nullptr) proposed = &each.joint;
  }
  if (proposed == nullptr) return text;
  return text + fmt::format(
                    "what is proposed is no way until somebody has looked: 'trailcast network "
                    "confirm {} {}', or refuse\n",
                    network::ToText(proposed->from), network::ToText(proposed->to));
}

std::string PassingJson(const network::Passings& passings) {
  Lines routes;
  for (const network::Passing& each : passings.routes) {
    routes.push_back(fmt::format(
        "{{\"at\": {}, \"joined\": {}, \"confidence\": {}, \"joint\": {{{}}}}}", PlaceJson(each.at),
        !each.confidence, each.confidence ? fmt::format("{:.2f}", *each.confidence) : "null",
        JointFields(each.joint)));
  }
  return fmt::format("{{\"place\": {}, \"passing\": {}}}\n", PlaceJson(passings.place),
                     JsonList(routes));
}

std::string WayText(const Lines& way) {
  if (way.empty()) return "it is there already\n";
  std::string text;
  for (const std::string& stretch : way) text += stretch + "\n";
  return text + fmt::format("{:.1f} m\n", network::LengthOf(StretchesOf(way)));
}

std::string WayJson(const Lines& way) {
  const auto way_stretches = StretchesOf(way);
  Lines stretches;
  for (const network::Stretch& each : way_stretches) {
    const std::string turn =
        each.turn_rad == 0.0 ? "" : fmt::format(", \"turn_rad\": {:.3f}", each.turn_rad);
    stretches.push_back(
        fmt::format("{{\"route\": {}, \"from_m\": {:.2f}, \"to_m\": {:.2f}, \"speed\": {:g}{}}}",
                    JsonText(each.route), each.from_m, each.to_m, each.speed, turn));
  }
  return fmt::format("{{\"length_m\": {:.2f}, \"stretches\": {}}}\n",
                     network::LengthOf(way_stretches), JsonList(stretches));
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

std::string ChangesJson(const network::History& history, std::size_t limit,
                        std::span<const std::string> of) {
  const auto routes = network::RoutesOf(history.changes);
  Lines changes;
  std::size_t total = 0;
  for (std::size_t i = history.changes.size(); i-- > 0;) {
    if (!of.empty() && !IsAbout(routes[i], of)) continue;
    if (++total > limit) continue;
    const network::Change& change = history.changes[i];
    changes.push_back(
        fmt::format("{{\"at_unix_ms\": {}, \"by\": {}, \"what\": {}, \"routes\": {}}}",
                    change.at_unix_ms, change.by.empty() ? "null" : JsonText(change.by),
                    JsonText(change.what), JsonTexts(routes[i])));
  }
  return fmt::format("{{\"kept_since_unix_ms\": {}, \"total\": {}, \"changes\": {}}}\n",
                     history.kept_since_unix_ms, total, JsonList(changes));
}

}  // namespace trailcast::fleet
