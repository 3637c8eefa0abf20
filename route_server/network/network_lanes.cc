// This part of NetworkRegistry keeps mutex zones.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "route_server/network/network_ids.h"
#include "route_server/network/network_registry.h"

namespace trailcast::server {
namespace {

using network::Lane;
using network::Part;
using Lines = std::vector<std::string>;

bool AreSame(const Lane& a, const Lane& b) {
  return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                    [](const Part& one, const Part& other) {
                      return one.route == other.route &&
                             std::abs(one.from_m - other.from_m) <= NetworkRegistry::kSame_m &&
                             std::abs(one.to_m - other.to_m) <= NetworkRegistry::kSame_m;
                    });
}

bool Overlaps(const Lane& lane, const network::Condition& where) {
  return std::any_of(lane.parts.begin(), lane.parts.end(), [&](const Part& part) {
    return part.route == where.route && part.from_m < where.to_m && part.to_m > where.from_m;
  });
}

}  // namespace

Result<Lines> NetworkRegistry::Narrow(Lane lane, const std::string& by, std::int64_t now_unix_ms) {
  for (network::Part& part : lane.parts) {
    const auto meant = Meant(part.route);
    if (!meant) return tl::unexpected(meant.error());
    if (part.to_m > meant->length_m + kSame_m) {
      return Fail(ErrorCode::kInvalidArgument,
                  "route '{}' is {:.2f} m long: {:g}..{:g} is not on it", meant->name,
                  meant->length_m, part.from_m, part.to_m);
    }
    part = {meant->key.route.value(), ToCentimetre(part.from_m), ToCentimetre(part.to_m)};
  }
  auto kept = std::find_if(lanes_.begin(), lanes_.end(),
                           [&](const store::KeptLane& each) { return AreSame(each.lane, lane); });
  if (kept == lanes_.end()) {
    const auto number = store_->Put(lane, by, now_unix_ms);
    if (!number) return tl::unexpected(number.error());
    kept = lanes_.insert(lanes_.end(), {.number = *number, .lane = std::move(lane)});
    NoteChange();
  }
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  return Lines{network::ToText(CalledLane(*kept))};
}

Result<Lines> NetworkRegistry::LetBack(const network::Edit& edit, const std::string& by,
                                       std::int64_t now_unix_ms) {
  const auto meant = Meant(edit.condition.route);
  if (!meant) return tl::unexpected(meant.error());
  const double end_m = std::min(edit.condition.to_m, meant->length_m);
  auto lines = Set(edit, by, now_unix_ms);
  if (!lines) return lines;
  auto narrow = Narrow({{{edit.condition.route, edit.condition.from_m, end_m}}}, by, now_unix_ms);
  if (!narrow) return narrow;
  lines->insert(lines->end(), narrow->begin(), narrow->end());
  return lines;
}

Result<Lines> NetworkRegistry::Leave(const network::Edit& edit) {
  const auto meant = Meant(edit.condition.route);
  if (!meant) return tl::unexpected(meant.error());
  if (auto known = Know({meant->key.route}); !known) return tl::unexpected(known.error());
  network::Condition where = edit.condition;
  where.route = meant->key.route.value();
  Lines lines;
  if (edit.kind == network::Edit::Kind::kVacate) {
    auto vacated = VacateDocks(where);
    if (!vacated) return vacated;
    lines = *std::move(vacated);
  }
  for (auto kept = lanes_.begin(); kept != lanes_.end();) {
    if (!Overlaps(kept->lane, where)) {
      ++kept;
      continue;
    }
    const std::string called = network::ToText(CalledLane(*kept));
    if (edit.kind == network::Edit::Kind::kWide) {
      if (auto dropped = store_->DropLane(kept->number); !dropped) {
        return tl::unexpected(dropped.error());
      }
      kept = lanes_.erase(kept);
      NoteChange();
      lines.push_back(called);
      continue;
    }
    for (const AgentId& agent : std::exchange(kept->holders, {})) {
      if (auto released = store_->Release(std::array{kept->number}, agent); !released) {
        return tl::unexpected(released.error());
      }
      vacated_.insert(agent);
      places_.Erase(agent);
      lines.push_back(
          fmt::format("{} no longer has {}", agent.value(), called.substr(called.find(' ') + 1)));
    }
    ++kept;
  }
  if (!lines.empty()) return lines;
  if (edit.kind == network::Edit::Kind::kWide) {
    return Fail(ErrorCode::kNotFound, "nothing is {} narrow there", meant->name);
  }
  return Fail(ErrorCode::kNotFound, "nobody has what is {} narrow there, nor a dock", meant->name);
}

Result<std::vector<Lane>> NetworkRegistry::Lanes() {
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  std::vector<Lane> lanes;
  for (const store::KeptLane& kept : lanes_) {
    Lane& lane = lanes.emplace_back();
    for (const network::Part& part : kept.lane.parts) {
      const auto& followed = known_.at(RouteId(part.route)).followed;
      if (followed) lane.parts.push_back({IdOf(followed->key), part.from_m, part.to_m});
    }
  }
  return lanes;
}

NetworkRegistry::LaneSet NetworkRegistry::HeldBy(const AgentId& agent) const {
  LaneSet held;
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    if (lanes_[i].holders.contains(agent)) held.insert(i);
  }
  return held;
}

std::vector<std::int64_t> NetworkRegistry::NumbersOf(const LaneSet& lanes) const {
  std::vector<std::int64_t> numbers;
  for (const std::size_t lane : lanes) numbers.push_back(lanes_[lane].number);
  return numbers;
}

Result<void> NetworkRegistry::Hold(const LaneSet& lanes, const AgentId& agent) {
  if (auto held = store_->Hold(NumbersOf(lanes), agent); !held) return held;
  for (const std::size_t lane : lanes) lanes_[lane].holders.insert(agent);
  return {};
}

Result<void> NetworkRegistry::Release(const LaneSet& lanes, const AgentId& agent) {
  if (auto released = store_->Release(NumbersOf(lanes), agent); !released) return released;
  for (const std::size_t lane : lanes) lanes_[lane].holders.erase(agent);
  return {};
}

Lane NetworkRegistry::CalledLane(const store::KeptLane& kept) const {
  Lane lane = kept.lane;
  for (network::Part& part : lane.parts) part.route = Called(RouteId(part.route));
  return lane;
}

std::string NetworkRegistry::Called(std::size_t lane) const {
  const network::Part& part = lanes_[lane].lane.parts.front();
  return fmt::format("{} {:g}..{:g}", Called(RouteId(part.route)), part.from_m, part.to_m);
}

Result<std::vector<mission::Task>> NetworkRegistry::TasksOf(std::span<const network::Section> way,
                                                            const LaneSet& open) {
  const auto lanes = Lanes();
  if (!lanes) return tl::unexpected(lanes.error());
  return TasksOf(network::LegsOf(way, *lanes, open));
}

std::vector<mission::Task> NetworkRegistry::TasksOf(std::span<const network::Leg> legs) const {
  std::vector<mission::Task> tasks;
  for (const network::Leg& leg : legs) {
    if (&leg != &legs.front()) tasks.push_back({.kind = mission::Task::Kind::kWaitLane});
    const network::Section* before = nullptr;
    double turn_rad = 0.0;
    for (const network::Section& section : leg.sections) {
      turn_rad += section.turn_rad;
      if (section.length_m() <= kSame_m) continue;
      if (turn_rad != 0.0) {
        tasks.push_back(
            {.kind = mission::Task::Kind::kTurn, .turn_rad = std::exchange(turn_rad, 0.0)});
      }
      if (before != nullptr && GoesOn(*before, section) && before->speed == section.speed) {
        tasks.back().to_m = TaskOf(section).to_m;
      } else {
        tasks.push_back(TaskOf(section));
      }
      before = &section;
    }
  }
  return tasks;
}

}  // namespace trailcast::server
