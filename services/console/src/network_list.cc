#include "services/console/network_list.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "services/fleet/network_client.h"
#include "services/network/words.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using network::Edit;

// Returns a route without its revision: "hall" for "hall@2".
std::string WithoutRevision(const std::string& route) { return route.substr(0, route.rfind('@')); }

std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

NetworkList::NetworkList(const std::vector<std::string>& lines, bool whole) : whole_(whole) {
  std::vector<std::pair<const std::string*, network::Listed>> marks;
  for (const std::string& line : lines) {
    network::Listed listed = network::ParseListed(line);
    if (!listed.route) {
      marks.emplace_back(&line, std::move(listed));
    } else if (!listed.route->name.empty()) {
      routes_.push_back({listed.route->name, Lower(listed.route->name), line, {}});
    }
  }
  std::stable_sort(routes_.begin(), routes_.end(),
                   [](const Route& one, const Route& other) { return one.name < other.name; });
  const auto is_same = [](const Route& one, const Route& other) { return one.name == other.name; };
  routes_.erase(std::unique(routes_.begin(), routes_.end(), is_same), routes_.end());
  for (std::size_t i = 0; i < routes_.size(); ++i) numbers_.emplace(routes_[i].name, i);

  for (const auto& [line, listed] : marks) {
    if (listed.proposal) TakeJunction(Kind::kProposed, listed.proposal->junction, *line);
    if (listed.lost) {
      if (const auto at = Find(listed.lost->route))
        marks_.push_back({Kind::kLost, *at, *at, *line});
    }
    if (listed.charging) of_fleet_.push_back(*line);
    if (!listed.edit) continue;
    const Edit& edit = *listed.edit;
    if (edit.kind == Edit::Kind::kCharge) {
      of_fleet_.push_back(*line);
      continue;
    }
    if (edit.kind == Edit::Kind::kJoin) {
      ++junctions_;
      TakeJunction(Kind::kJunction, edit.junction, *line);
      continue;
    }
    if (edit.kind == Edit::Kind::kNarrow) {
      const auto from = Find(edit.lane.parts.front().route);
      const auto to = Find(edit.lane.parts.back().route);
      if (from && to) marks_.push_back({Kind::kLane, *from, *to, *line});
      continue;
    }
    const bool is_name = edit.kind == Edit::Kind::kName;
    const auto at = Find(is_name ? edit.named.place.route : edit.condition.route);
    if (!at) continue;
    marks_.push_back({is_name ? Kind::kName : Kind::kCondition, *at, *at, *line});
    if (!is_name) continue;
    routes_[*at].lower += '\n';
    routes_[*at].lower += Lower(edit.named.name);
  }
}

void NetworkList::TakeJunction(Kind kind, const network::Junction& junction,
                               const std::string& line) {
  const auto from = Find(junction.from.route);
  const auto to = Find(junction.to.route);
  if (!from || !to) return;
  marks_.push_back({kind, *from, *to, line});
  if (*from == *to || kind != Kind::kJunction) return;
  routes_[*from].joined.push_back(*to);
  routes_[*to].joined.push_back(*from);
}

std::optional<std::size_t> NetworkList::Find(const std::string& route) const {
  auto at = numbers_.find(route);
  if (at == numbers_.end()) at = numbers_.find(WithoutRevision(route));
  return at == numbers_.end() ? std::nullopt : std::optional(at->second);
}

std::vector<std::size_t> NetworkList::Matching(const std::string& search) const {
  const std::string lower = Lower(search);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < routes_.size(); ++i) {
    if (routes_[i].lower.find(lower) != std::string::npos) found.push_back(i);
  }
  return found;
}

std::vector<std::size_t> NetworkList::Around(const std::string& route) const {
  const auto at = numbers_.find(route);
  if (at == numbers_.end()) return {};
  std::vector<std::size_t> found{at->second};
  std::vector<bool> known(routes_.size(), false);
  known[at->second] = true;
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (const std::size_t neighbour : routes_[found[next]].joined) {
      if (known[neighbour]) continue;
      known[neighbour] = true;
      found.push_back(neighbour);
    }
  }
  return found;
}

// Returns the route and those that it meets.
std::vector<std::size_t> NetworkList::WithMet(const std::string& route) const {
  const auto at = numbers_.find(route);
  if (at == numbers_.end()) return {};
  std::vector<std::size_t> found{at->second};
  for (const Mark& mark : marks_) {
    if (mark.kind != Kind::kJunction && mark.kind != Kind::kProposed) continue;
    if (mark.route != at->second && mark.other != at->second) continue;
    const std::size_t other = mark.route == at->second ? mark.other : mark.route;
    if (std::find(found.begin(), found.end(), other) == found.end()) found.push_back(other);
  }
  return found;
}

std::string NetworkList::Body(const NetworkQuery& query) const {
  std::vector<std::size_t> found = !query.of.empty()       ? WithMet(query.of)
                                   : !query.around.empty() ? Around(query.around)
                                                           : Matching(query.search);
  const std::size_t matched = found.size();
  found.resize(std::min<std::size_t>(found.size(), query.limit));
  std::vector<bool> shown(routes_.size(), false);
  std::vector<std::string> lines = of_fleet_;
  for (const std::size_t i : found) {
    shown[i] = true;
    lines.push_back(routes_[i].line);
  }
  std::array<std::size_t, kKinds> marks{};
  std::size_t left_out = 0;
  std::map<std::size_t, std::size_t> elsewhere;
  for (const Mark& mark : marks_) {
    if (!shown[mark.route] && !shown[mark.other]) continue;
    if (!shown[mark.route] || !shown[mark.other]) {
      if (mark.kind == Kind::kJunction) ++elsewhere[shown[mark.route] ? mark.route : mark.other];
    } else if (++marks[static_cast<std::size_t>(mark.kind)] > kMostMarks) {
      ++left_out;
    } else {
      lines.push_back(mark.line);
    }
  }
  auto counts = program::Json::array();
  for (const auto& [route, count] : elsewhere) {
    counts.push_back({{"route", routes_[route].name}, {"joints", count}});
  }
  return program::OneLine({{"network", fleet::NetworkJson(lines)},
                           {"elsewhere", std::move(counts)},
                           {"matched", matched},
                           {"routes", routes_.size()},
                           {"joints", junctions_},
                           {"left_out", left_out},
                           {"whole", whole_}});
}

}  // namespace trailcast::console
