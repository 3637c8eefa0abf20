#include "route_server/network/network_registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "route_server/network/network_ids.h"
#include "route_server/routes/followable.h"
#include "services/base/number.h"
#include "services/base/process_name.h"
#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"
#include "services/network/passing.h"

namespace trailcast::server {
namespace {

using network::Condition;
using network::Edit;
using network::Goal;
using network::Junction;
using network::NamedPlace;
using network::Place;
using Lines = std::vector<std::string>;

bool IsNear(double a_m, double b_m) { return std::abs(a_m - b_m) <= NetworkRegistry::kSame_m; }

bool IsNear(const Place& a, const Place& b) {
  return a.route == b.route && IsNear(a.along_m, b.along_m);
}

Junction Reversed(Junction junction) {
  std::swap(junction.from, junction.to);
  return junction;
}

std::vector<std::string> NamesOf(const std::set<AgentId>& agents) {
  std::vector<std::string> names;
  for (const AgentId& agent : agents) names.push_back(agent.value());
  return names;
}

std::string TakenText(const std::string& line, const std::set<AgentId>& holders) {
  return fmt::format("{}{}{}", line, network::kTakenBy, fmt::join(NamesOf(holders), " "));
}

std::string ListedText(const std::string& edit, bool used) {
  return used ? edit : std::string(network::kUnused) + edit;
}

std::string PlacesText(const std::string& line) {
  const network::Listed listed = network::ParseListed(line);
  const Junction junction = listed.proposal ? listed.proposal->junction
                            : listed.edit   ? listed.edit->junction
                                            : Junction{};
  return network::ToText(junction.from) + " " + network::ToText(junction.to);
}

// Describes the effect of an edit as one edit each; confirming several proposals gives one for each
// junction. `words` are the edit, and `lines` its answer.
std::vector<std::string> DoneText(const Edit& edit, const std::string& words, const Lines& lines) {
  switch (edit.kind) {
    case Edit::Kind::kJoin:
    case Edit::Kind::kName:
    case Edit::Kind::kConfirm:
      return lines;
    case Edit::Kind::kForget:
      return {"forget " + edit.named.name};
    case Edit::Kind::kPart:
    case Edit::Kind::kRefuse: {
      const std::string verb = edit.kind == Edit::Kind::kPart ? "part " : "refuse ";
      std::vector<std::string> done;
      for (const std::string& line : lines) done.push_back(verb + PlacesText(line));
      return done;
    }
    default:
      return {PlainText(words, exchange::kMaxLineBytes / 2)};
  }
}

}  // namespace

Result<std::unique_ptr<NetworkRegistry>> NetworkRegistry::Open(
    AgentId server, std::unique_ptr<store::NetworkStore> store, store::RouteStore& routes) {
  std::unique_ptr<NetworkRegistry> registry(
      new NetworkRegistry(std::move(server), std::move(store), routes));
  auto junctions = registry->store_->Junctions();
  if (!junctions) return tl::unexpected(junctions.error());
  auto conditions = registry->store_->Conditions();
  if (!conditions) return tl::unexpected(conditions.error());
  auto names = registry->store_->Names();
  if (!names) return tl::unexpected(names.error());
  for (NamedPlace& named : *names) registry->named_.emplace(named.name, std::move(named));
  auto proposed = registry->store_->Proposals();
  if (!proposed) return tl::unexpected(proposed.error());
  auto searched = registry->store_->Searched();
  if (!searched) return tl::unexpected(searched.error());
  auto lanes = registry->store_->Lanes();
  if (!lanes) return tl::unexpected(lanes.error());
  const auto followed = registry->store_->Followed();
  if (!followed) return tl::unexpected(followed.error());
  auto holders = registry->store_->DockHolders();
  if (!holders) return tl::unexpected(holders.error());
  const auto charge = registry->store_->Charge();
  if (!charge) return tl::unexpected(charge.error());
  registry->dock_holders_ = *std::move(holders);
  registry->charge_limits_ = *charge;
  registry->followed_.Load(*followed);
  registry->lanes_ = *std::move(lanes);
  registry->proposed_ = *std::move(proposed);
  registry->searched_.insert(searched->begin(), searched->end());
  registry->junctions_ = *std::move(junctions);
  registry->conditions_ = *std::move(conditions);
  return registry;
}

exchange::NetworkReply NetworkRegistry::Change(const exchange::NetworkEdit& edit,
                                               std::int64_t now_unix_ms) {
  auto& answered = answered_.Touch({edit.client, edit.request});
  if (answered) return *answered;
  exchange::NetworkReply reply{.server = server_, .client = edit.client, .request = edit.request};
  const std::string by = WithoutProcess(edit.client.value());
  auto lines = network::ParseEdit(edit.words).and_then([&](const Edit& parsed) {
    auto carried = Carry(parsed, by, now_unix_ms);
    if (!carried) return carried;
    for (std::string& done : DoneText(parsed, edit.words, *carried)) {
      made_.push_back({now_unix_ms, by, std::move(done)});
    }
    return carried;
  });
  if (lines) {
    lines->resize(std::min(lines->size(), exchange::kMaxNetworkLines));
    reply.lines = *std::move(lines);
  } else {
    reply.error = PlainText(lines.error().message, exchange::kMaxLineBytes);
  }
  answered = reply;
  return reply;
}

exchange::NetworkReply NetworkRegistry::Answer(const exchange::NetworkRequest& request) {
  exchange::NetworkReply reply{
      .server = server_, .client = request.client, .request = request.request};
  const auto lines = Answered(request.words);
  if (!lines) {
    reply.error = PlainText(lines.error().message, exchange::kMaxLineBytes);
    return reply;
  }
  const std::size_t begin = std::min<std::size_t>(request.first, lines->size());
  const std::size_t end = std::min(begin + exchange::kMaxNetworkLines, lines->size());
  reply.lines.assign(lines->begin() + static_cast<std::ptrdiff_t>(begin),
                     lines->begin() + static_cast<std::ptrdiff_t>(end));
  if (end < lines->size()) reply.next = static_cast<std::uint32_t>(end);
  return reply;
}

Result<Lines> NetworkRegistry::Answered(const std::string& words) {
  if (words.empty()) return All();
  if (words == network::kAsksCharging) return ChargingLines();
  if (const auto goal = network::ParseWhatPasses(words)) {
    return network::ParseGoal(*goal).and_then([&](const Goal& at) { return WhatPasses(at); });
  }
  return network::ParseQuestion(words).and_then(
      [&](const network::Question& question) { return WayTo(question); });
}

void NetworkRegistry::Hear(const exchange::AgentStatus& status) {
  if (status.role != exchange::AgentRole::kFollower) return;
  if (status.place) {
    places_.Touch(status.agent) = {
        {IdOf(status.place->key), status.place->along_m}, status.speed_mps, true};
  } else if (Stand* stand = places_.Find(status.agent)) {
    stand->now = false;
  }
}

void NetworkRegistry::Note(const route::RouteInfo& info) {
  if (info.standing == route::Standing::kDeleted) DropProposals(info.key);
  const auto at = known_.find(info.key.route);
  if (at == known_.end()) {
    // Its name may no longer identify one route.
    if (!names_.contains(info.name)) return;
    known_.clear();
  } else {
    const auto& followed = at->second.followed;
    const bool is_followed = followed && followed->key == info.key;
    if (is_followed ? *followed == info : !IsFollowable(info)) return;
    known_.erase(at);
  }
  NoteChange();
}

Result<Lines> NetworkRegistry::Carry(const Edit& edit, const std::string& by,
                                     std::int64_t now_unix_ms) {
  switch (edit.kind) {
    case Edit::Kind::kJoin:
      return Join(edit.junction, by, now_unix_ms);
    case Edit::Kind::kPart:
      return Part(edit.junction);
    case Edit::Kind::kName:
      return Name(edit.named, by, now_unix_ms);
    case Edit::Kind::kForget:
      return Forget(edit.named.name);
    case Edit::Kind::kCharge:
      return SetCharge(edit.charge);
    case Edit::Kind::kConfirm:
    case Edit::Kind::kRefuse:
      return Settle(edit, by, now_unix_ms);
    case Edit::Kind::kNarrow:
      return Narrow(edit.lane, by, now_unix_ms);
    case Edit::Kind::kBack:
      return LetBack(edit, by, now_unix_ms);
    case Edit::Kind::kWide:
    case Edit::Kind::kVacate:
      return Leave(edit);
    default:
      return Set(edit, by, now_unix_ms);
  }
}

Result<Lines> NetworkRegistry::Join(Junction junction, const std::string& by,
                                    std::int64_t now_unix_ms) {
  for (Place* place : {&junction.from, &junction.to}) {
    auto resolved = Resolve(*place);
    if (!resolved) return tl::unexpected(resolved.error());
    *place = *std::move(resolved);
  }
  if (IsNear(junction.from, junction.to)) {
    return Fail(ErrorCode::kInvalidArgument,
                "a junction leads to another place than where it begins");
  }
  const auto before = std::find_if(junctions_.begin(), junctions_.end(), [&](const Junction& each) {
    return IsNear(each.from, junction.from) && IsNear(each.to, junction.to);
  });
  if (before != junctions_.end()) {
    junction.from = before->from;
    junction.to = before->to;
  }
  if (auto put = store_->Put(junction, by, now_unix_ms); !put) return tl::unexpected(put.error());
  if (before != junctions_.end()) junctions_.erase(before);
  junctions_.push_back(junction);
  NoteChange();
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  const auto called = Called(junction);
  if (!called) return tl::unexpected(called.error());
  return Lines{network::ToText(*called)};
}

Result<Lines> NetworkRegistry::Part(const Junction& junction) {
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  // Routes that were deleted are known only by their name in the list.
  const auto from = Resolve(junction.from);
  const auto to = Resolve(junction.to);
  std::vector<Junction> parted;
  Lines lines;
  for (const Junction& each : junctions_) {
    const auto called = Called(each);
    if (!called) return tl::unexpected(called.error());
    const auto is = [&](const Junction& it, const Junction& its_name) {
      return (IsNear(its_name.from, junction.from) || (from && IsNear(it.from, *from))) &&
             (IsNear(its_name.to, junction.to) || (to && IsNear(it.to, *to)));
    };
    if (!is(each, *called) && !is(Reversed(each), Reversed(*called))) continue;
    parted.push_back(each);
    lines.push_back(network::ToText(*called));
  }
  if (parted.empty()) {
    return Fail(ErrorCode::kNotFound, "there is no junction of {} and {}",
                network::ToText(junction.from), network::ToText(junction.to));
  }
  for (const Junction& each : parted) {
    if (auto dropped = store_->Drop(each); !dropped) return tl::unexpected(dropped.error());
    std::erase(junctions_, each);
    NoteChange();
  }
  return lines;
}

Result<Lines> NetworkRegistry::Set(Edit edit, const std::string& by, std::int64_t now_unix_ms) {
  Condition& condition = edit.condition;
  const auto meant = Meant(condition.route);
  if (!meant) return tl::unexpected(meant.error());
  if (condition.from_m >= meant->length_m) {
    return Fail(ErrorCode::kInvalidArgument, "route '{}' is {:.1f} m long: {:g} m is beyond it",
                meant->name, meant->length_m, condition.from_m);
  }
  condition.route = meant->key.route.value();
  auto after = network::Amended(conditions_, edit);
  std::vector<Condition> its;
  std::copy_if(after.begin(), after.end(), std::back_inserter(its),
               [&](const Condition& each) { return each.route == condition.route; });
  if (auto stored = store_->Replace(condition.route, its, by, now_unix_ms); !stored) {
    return tl::unexpected(stored.error());
  }
  conditions_ = std::move(after);
  NoteChange();
  if (auto known = Know({meant->key.route}); !known) return tl::unexpected(known.error());
  Lines lines;
  for (Condition& each : its) {
    each.route = Called(meant->key.route);
    lines.push_back(network::ToText(each));
  }
  return lines;
}

Result<Lines> NetworkRegistry::Name(NamedPlace named, const std::string& by,
                                    std::int64_t now_unix_ms) {
  auto place = Resolve(named.place);
  if (!place) return tl::unexpected(place.error());
  named.place = *std::move(place);
  if (auto put = store_->Put(named, by, now_unix_ms); !put) return tl::unexpected(put.error());
  NamedPlace& known_as = named_[named.name];
  if (!named.dock || !IsNear(known_as.place, named.place)) {
    if (auto left = HoldDock(named.name, {}); !left) return tl::unexpected(left.error());
  }
  known_as = named;
  NoteChange();
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  const auto called = Called(named);
  if (!called) return tl::unexpected(called.error());
  return Lines{network::ToText(*called)};
}

Result<Lines> NetworkRegistry::Forget(const std::string& name) {
  const auto at = named_.find(name);
  if (at == named_.end()) return Fail(ErrorCode::kNotFound, "no place is called '{}'", name);
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  const auto called = Called(at->second);
  if (!called) return tl::unexpected(called.error());
  if (auto forgotten = store_->Forget(name); !forgotten) return tl::unexpected(forgotten.error());
  named_.erase(at);
  dock_holders_.erase(name);
  NoteChange();
  return Lines{network::ToText(*called)};
}

Lines NetworkRegistry::ChargingLines() const {
  Lines lines;
  for (const network::Charging& each : charging_) {
    lines.push_back(PlainText(network::ToText(each), exchange::kMaxLineBytes));
  }
  return lines;
}

Result<Lines> NetworkRegistry::All() {
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  Lines lines;
  for (const auto& [id, known] : known_) {
    if (!known.followed) continue;
    lines.push_back(network::ToText(
        network::Route{.name = known.called, .length_m = known.followed->length_m}));
  }
  for (const Junction& junction : junctions_) {
    const auto called = Called(junction);
    if (!called) return tl::unexpected(called.error());
    lines.push_back(
        ListedText(network::ToText(*called), IsUsed(junction.from) && IsUsed(junction.to)));
  }
  for (Condition condition : conditions_) {
    condition.route = Called(RouteId(condition.route));
    lines.push_back(network::ToText(condition));
  }
  for (std::string& line : PoorLines()) lines.push_back(std::move(line));
  for (const store::KeptLane& kept : lanes_) {
    std::string line = network::ToText(CalledLane(kept));
    if (!kept.holders.empty()) line = TakenText(line, kept.holders);
    lines.push_back(PlainText(line, exchange::kMaxLineBytes));
  }
  for (const auto& [name, named] : named_) {
    const auto called = Called(named);
    if (!called) return tl::unexpected(called.error());
    lines.push_back(ListedText(network::ToText(*called), IsUsed(named.place)));
    const auto holders = dock_holders_.find(name);
    if (holders == dock_holders_.end() || holders->second.empty()) continue;
    lines.back() = PlainText(TakenText(lines.back(), holders->second), exchange::kMaxLineBytes);
  }
  if (charge_limits_) lines.push_back(network::ToText(charge_limits_));
  for (std::string& line : ChargingLines()) lines.push_back(std::move(line));
  for (const std::size_t each : Open()) {
    network::Proposal proposal = proposed_[each].proposal;
    auto called = Called(std::move(proposal.junction));
    if (!called) return tl::unexpected(called.error());
    proposal.junction = *std::move(called);
    lines.push_back(network::ToText(proposal));
  }
  return lines;
}

template <typename Find>
Result<network::Way> NetworkRegistry::NearestOf(const std::vector<Place>& places,
                                                const Find& find) const {
  std::optional<Result<network::Way>> nearest;
  for (const Place& to : places) {
    if (places.size() > 1 && !IsUsed(to)) continue;
    Result<network::Way> way = find(to);
    const bool is_better = nearest && way && (!*nearest || way->length_m < (*nearest)->length_m);
    if (!nearest || is_better) nearest = std::move(way);
  }
  if (nearest) return *std::move(nearest);
  return Fail(ErrorCode::kNotFound, "all homes are on revisions that robots do not follow");
}

Result<Lines> NetworkRegistry::WayTo(const network::Question& question) {
  const auto to = PlacesOf(question.to);
  if (!to) return tl::unexpected(to.error());
  const std::string& robot = question.from.name;
  const auto* stands = robot.empty() ? nullptr : places_.Find(AgentId(robot));
  if (stands == nullptr && !robot.empty() && !named_.contains(robot)) {
    return Fail(
        ErrorCode::kNotFound,
        "'{}' has not said where on a route it stands since this server was started, nor is "
        "a place called so: say from where it is to go",
        robot);
  }
  const auto from = stands == nullptr ? Resolve(question.from) : Result<Place>(stands->place);
  if (!from) return tl::unexpected(from.error());
  if (auto known = Know({KeyOf(from->route).route, KeyOf(to->front().route).route}); !known) {
    return tl::unexpected(known.error());
  }
  for (const auto& place : {*from, to->front()}) {
    if (IsUsed(place) || (to->size() > 1 && place != *from)) continue;
    const auto called = Called(place);
    if (!called) return tl::unexpected(called.error());
    return Fail(ErrorCode::kNotFound, "{} is on a revision that robots do not follow{}",
                network::ToText(*called),
                stands == nullptr ? "" : ", where " + robot + " may stand");
  }
  const auto way =
      NearestOf(*to, [&](const Place& each) { return network_->ShortestWay(*from, each); });
  if (!way) return tl::unexpected(way.error());
  const auto tasks = TasksOf(way->sections, HeldBy(AgentId(robot)));
  if (!tasks) return tl::unexpected(tasks.error());
  Lines lines;
  for (const mission::Task& task : *tasks) lines.push_back(mission::ToText(task));
  return lines;
}

mission::Task NetworkRegistry::TaskOf(const network::Section& section) const {
  return {.route = {.route = Called(KeyOf(section.route).route)},
          .from_m = ToCentimetre(section.from_m),
          .to_m = ToCentimetre(section.to_m),
          .backwards = section.backwards(),
          .speed_factor = section.speed};
}

Result<network::Section> NetworkRegistry::SectionOf(std::span<const mission::Task> tasks,
                                                    std::size_t number) {
  const mission::Task& task = tasks[number];
  const auto& [name, revision] = task.route;
  const auto meant = Meant(revision == 0 ? name : fmt::format("{}@{}", name, revision));
  if (!meant) return tl::unexpected(meant.error());
  network::Section section{.route = IdOf(meant->key),
                           .from_m = task.from_m,
                           .to_m = task.to_m,
                           .speed = task.speed_factor,
                           .turn_rad = mission::TurnBefore(tasks, number)};
  double& end_m = task.backwards ? section.from_m : section.to_m;
  if (end_m <= 0.0) end_m = meant->length_m;
  return section;
}

Result<std::optional<Condition>> NetworkRegistry::FirstClosed(const network::Section& section) {
  if (auto known = Know({KeyOf(section.route).route}); !known) return tl::unexpected(known.error());
  return network_->FirstClosed(section);
}

Result<std::optional<Condition>> NetworkRegistry::ClosedAround(const Place& place) {
  if (auto known = Know({KeyOf(place.route).route}); !known) return tl::unexpected(known.error());
  return network_->ClosedAround(place);
}

std::string NetworkRegistry::Called(const Condition& closed) const {
  return fmt::format("{} {:g}..{:g}", Called(KeyOf(closed.route).route),
                     ToCentimetre(closed.from_m), ToCentimetre(closed.to_m));
}

Result<std::vector<network::Section>> NetworkRegistry::WayOn(const Place& from,
                                                             const std::string& goal) {
  const auto parsed = network::ParseGoal(goal);
  if (!parsed) return tl::unexpected(parsed.error());
  const auto to = PlacesOf(*parsed);
  if (!to) return tl::unexpected(to.error());
  if (auto known = Know({KeyOf(from.route).route, KeyOf(to->front().route).route}); !known) {
    return tl::unexpected(known.error());
  }
  auto way = NearestOf(*to, [&](const Place& each) { return network_->WayOn(from, each); });
  if (!way) return tl::unexpected(way.error());
  std::erase_if(way->sections, [](const network::Section& each) {
    return each.length_m() <= kSame_m && each.turn_rad == 0.0;
  });
  return std::move(way->sections);
}

void NetworkRegistry::NoteChange() {
  network_.reset();
  ++changes_;
}

}  // namespace trailcast::server
