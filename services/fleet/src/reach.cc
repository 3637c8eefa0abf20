#include "services/fleet/reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "services/base/time.h"
#include "services/fleet/robot_state.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using exchange::AgentRole;
using exchange::HeardAgent;
using std::chrono::milliseconds;

// A server is in all meshes, and answers stars.
const char* DiscoveryText(const Reach::Member& member) {
  if (member.role == AgentRole::kServer) return "all";
  if (!member.star) return "-";
  return *member.star ? "star" : "mesh";
}

std::string SpanText(milliseconds span) {
  const double s = Seconds(span);
  if (s < 120.0) return fmt::format("{:.1f} s", s);
  return s < 7200.0 ? fmt::format("{:.0f} min", s / 60.0) : fmt::format("{:.0f} h", s / 3600.0);
}

bool IsServer(const Reach::Member& member) { return member.role == AgentRole::kServer; }

// This finds which member hears which other, and from where.
class Hearings {
 public:
  explicit Hearings(const Reach& reach) {
    for (const Reach::Hearing& each : reach.hearings) {
      by_.emplace(std::pair(each.by, each.heard.agent), &each.heard);
      heard_by_[each.heard.agent].push_back(each.by);
    }
  }
  [[nodiscard]] const HeardAgent* Find(const AgentId& by, const AgentId& heard) const {
    const auto found = by_.find({by, heard});
    return found == by_.end() ? nullptr : found->second;
  }
  [[nodiscard]] const std::vector<AgentId>& Of(const AgentId& heard) const {
    static const std::vector<AgentId> kNobody;
    const auto found = heard_by_.find(heard);
    return found == heard_by_.end() ? kNobody : found->second;
  }
  // Returns "10.0.0.7:41830", as any member hears it.
  [[nodiscard]] std::string AddressOf(const AgentId& heard) const {
    for (const AgentId& by : Of(heard)) {
      const HeardAgent* found = Find(by, heard);
      if (!found->address.empty()) return found->address;
    }
    return "an address that nobody knows";
  }

 private:
  std::map<std::pair<AgentId, AgentId>, const HeardAgent*> by_;
  std::map<AgentId, std::vector<AgentId>> heard_by_;
};

Reach::Trouble Unheard(const Reach::Member& member) {
  return {.member = member.name,
          .what = fmt::format("nobody hears {}", member.name.value()),
          .advice =
              "see that its program runs, with this domain, tag and keys, and run 'trailcast "
              "doctor' on its computer; without multicast give it --server-address; behind "
              "NAT or at another site both ends need a VPN (\"Between sites\" in "
              "config/README.md)"};
}

Reach::Trouble Unanswered(const Reach::Member& member, const Hearings& hearings) {
  const std::string& by = hearings.Of(member.name).front().value();
  return {.member = member.name,
          .what = fmt::format("{} hears {}, which does not answer", by, member.name.value()),
          .advice = fmt::format(
              "let UDP from there to {} through firewalls; if that is so, its program or its keys "
              "may be of before it could be asked: update it, or renew them",
              hearings.AddressOf(member.name))};
}

Reach::Trouble OneWay(const Reach::Member& deaf, const Reach::Member& unheard,
                      const Hearings& hearings) {
  const bool back = hearings.Find(unheard.name, deaf.name) != nullptr;
  return {
      .member = deaf.name,
      .what = fmt::format("{} does not hear {}{}", deaf.name.value(), unheard.name.value(),
                          back ? ", which hears it" : ""),
      .advice = fmt::format(
          "let UDP from {} to {} through firewalls and access points (\"client isolation\"); "
          "without multicast between the two give --server-address; through NAT both need a VPN "
          "(\"Between sites\" in config/README.md)",
          hearings.AddressOf(unheard.name), hearings.AddressOf(deaf.name))};
}

bool ShallHear(const Reach::Member& by, const Reach::Member& heard) {
  if (by.name == heard.name) return false;
  const bool both_in_mesh = by.star == false && heard.star == false;
  return IsServer(by) || IsServer(heard) || both_in_mesh;
}

program::Json HearingJson(const Reach::Hearing& hearing) {
  const HeardAgent& heard = hearing.heard;
  const auto text = [](const std::string& value) {
    return value.empty() ? program::Json(nullptr) : program::Json(value);
  };
  return {{"by", hearing.by.value()},
          {"for_s", program::Rounded(Seconds(heard.heard_for), 10.0)},
          {"last_s", program::Rounded(Seconds(heard.age), 10.0)},
          {"round_trip_ms", program::RoundedOrNull(heard.round_trip_ms, 100.0)},
          {"late_ms", program::Rounded(heard.late_ms, 100.0)},
          {"address", text(heard.address)},
          {"network_interface", text(heard.network)}};
}

}  // namespace

exchange::ReachRequest ReachSurvey::Ask(Time now) {
  const exchange::ReachRequest request{.client = self_, .request = ++asked_};
  desk_.NoteAsked(request, now);
  return request;
}

void ReachSurvey::Hear(const exchange::Message& message, Time now) {
  desk_.Handle(message, now);
  const auto* report = std::get_if<exchange::ReachReport>(&message);
  if (report == nullptr || report->client != self_ || report->request > asked_) return;
  if (!answers_.contains(report->agent) && answers_.size() >= exchange::ReachDesk::kMostAgents) {
    return;
  }
  Answer& answer = answers_[report->agent];
  if (report->request < answer.request) return;
  if (report->request > answer.request) answer.heard.clear();
  answer.request = report->request;
  answer.role = report->role;
  answer.star = report->star;
  for (const HeardAgent& heard : report->heard) answer.heard.insert_or_assign(heard.agent, heard);
}

Reach ReachSurvey::Result(Time now) const {
  std::map<AgentId, Reach::Member> members;
  for (const AgentId& name : expected_) members[name];
  std::map<std::pair<AgentId, AgentId>, HeardAgent> hearings;  // by heard, then by hearing member
  const auto note = [&](const AgentId& by, const HeardAgent& heard) {
    if (heard.role == AgentRole::kOperator) return;
    members[heard.agent].role = heard.role;
    hearings.emplace(std::pair(heard.agent, by), heard);
  };
  for (const HeardAgent& heard : desk_.Heard(now)) note(self_, heard);
  for (const auto& [name, answer] : answers_) {
    for (const auto& [agent, heard] : answer.heard) note(name, heard);
  }
  for (const auto& [name, answer] : answers_) {
    members[name].role = answer.role;
    members[name].star = answer.star;
  }
  Reach reach;
  for (auto& [name, member] : members) {
    member.name = name;
    reach.members.push_back(member);
  }
  for (auto& [pair, heard] : hearings) {
    const auto& [agent, by] = pair;
    // A round trip is as long in the other direction.
    const auto back = hearings.find({by, agent});
    if (!heard.round_trip_ms && back != hearings.end()) {
      heard.round_trip_ms = back->second.round_trip_ms;
    }
    reach.hearings.push_back({by, heard});
  }
  reach.troubles = TroublesOf(reach);
  return reach;
}

std::vector<Reach::Trouble> TroublesOf(const Reach& reach) {
  const Hearings hearings(reach);
  std::vector<Reach::Trouble> troubles;
  std::vector<const Reach::Member*> answered;
  for (const Reach::Member& member : reach.members) {
    if (member.star) {
      answered.push_back(&member);
    } else {
      const bool heard = !hearings.Of(member.name).empty();
      troubles.push_back(heard ? Unanswered(member, hearings) : Unheard(member));
    }
  }
  for (const Reach::Member* by : answered) {
    for (const Reach::Member& heard : reach.members) {
      // A member that nobody hears is reported once.
      const bool known = heard.star || !hearings.Of(heard.name).empty();
      if (!known || !ShallHear(*by, heard) || hearings.Find(by->name, heard.name)) continue;
      troubles.push_back(OneWay(*by, heard, hearings));
    }
  }
  return troubles;
}

bool IsMeasured(const Reach& reach) {
  std::set<AgentId> servers;
  for (const Reach::Member& member : reach.members) {
    if (IsServer(member)) servers.insert(member.name);
  }
  return std::all_of(reach.hearings.begin(), reach.hearings.end(), [&](const auto& hearing) {
    const HeardAgent& heard = hearing.heard;
    const bool timed = servers.contains(hearing.by) || servers.contains(heard.agent);
    return !heard.address.empty() && (!timed || heard.round_trip_ms);
  });
}

std::string ReachText(const Reach& reach) {
  constexpr const char* kLine = "{:<16} {:<9} {:<9} {:<16} {:>8} {:>8} {:>10} {:>10}  {}\n";
  std::string text;
  if (!reach.members.empty()) {
    text = fmt::format(kLine, "WHO", "ROLE", "DISCOVERY", "HEARD BY", "FOR", "LAST", "THERE+BACK",
                       "LATE", "AT");
  }
  std::size_t next = 0;
  for (const Reach::Member& member : reach.members) {
    const char* role = member.role ? ToText(*member.role) : "-";
    std::string who = member.name.value();
    const auto line = [&](const std::string& by, const HeardAgent* heard) {
      const auto ms = [](double value) { return fmt::format("{:.1f} ms", value); };
      std::string at = heard == nullptr || heard->address.empty() ? "-" : heard->address;
      if (heard != nullptr && !heard->network.empty()) at += " over " + heard->network;
      text +=
          fmt::format(kLine, who, role, DiscoveryText(member), by,
                      heard ? SpanText(heard->heard_for) : "-", heard ? SpanText(heard->age) : "-",
                      heard && heard->round_trip_ms ? ms(*heard->round_trip_ms) : "-",
                      heard ? ms(heard->late_ms) : "-", at);
    };
    const std::size_t first = next;
    for (; next < reach.hearings.size() && reach.hearings[next].heard.agent == member.name;
         ++next) {
      line(reach.hearings[next].by.value(), &reach.hearings[next].heard);
    }
    if (next == first) line("nobody", nullptr);
  }
  for (const Reach::Trouble& trouble : reach.troubles) {
    text += fmt::format("BAD   {}\n      {}\n", trouble.what, trouble.advice);
  }
  return text;
}

nlohmann::ordered_json ReachJson(const Reach& reach) {
  auto members = program::Json::array();
  std::size_t next = 0;
  for (const Reach::Member& member : reach.members) {
    auto heard_by = program::Json::array();
    for (; next < reach.hearings.size() && reach.hearings[next].heard.agent == member.name;
         ++next) {
      heard_by.push_back(HearingJson(reach.hearings[next]));
    }
    const std::string discovery = DiscoveryText(member);
    members.push_back(
        {{"name", member.name.value()},
         {"role", member.role ? program::Json(ToText(*member.role)) : program::Json(nullptr)},
         {"discovery", discovery == "-" ? program::Json(nullptr) : program::Json(discovery)},
         {"answers", member.star.has_value()},
         {"heard_by", std::move(heard_by)}});
  }
  auto troubles = program::Json::array();
  for (const Reach::Trouble& trouble : reach.troubles) {
    troubles.push_back(
        {{"member", trouble.member.value()}, {"what", trouble.what}, {"advice", trouble.advice}});
  }
  return {{"all_hear_each_other", reach.complete()},
          {"members", std::move(members)},
          {"troubles", std::move(troubles)}};
}

}  // namespace trailcast::fleet
