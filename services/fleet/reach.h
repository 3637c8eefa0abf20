#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "services/exchange/reach_desk.h"

namespace trailcast::fleet {

// This is which members of a fleet hear which others, how late, and over what.
struct Reach {
  // This is a server or a robot.
  struct Member {
    AgentId name{};
    std::optional<exchange::AgentRole> role{};  // empty if nobody hears it
    std::optional<bool> star{};  // it meets route servers alone; empty without an answer
    bool operator==(const Member&) const = default;
  };
  struct Hearing {
    AgentId by{};
    exchange::HeardAgent heard{};
    bool operator==(const Hearing&) const = default;
  };
  // This is a member that should hear another, and does not or does not report it.
  struct Trouble {
    AgentId member{};  // the member to look at
    std::string what{};
    std::string advice{};
    bool operator==(const Trouble&) const = default;
  };
  std::vector<Member> members{};    // sorted by name
  std::vector<Hearing> hearings{};  // by heard member, then by hearing member
  std::vector<Trouble> troubles{};

  // Returns whether all members that have to hear each other do.
  [[nodiscard]] bool complete() const { return !members.empty() && troubles.empty(); }
};

// This asks all members, directly and through servers, and collects their answers. It has no I/O
// and no clock.
class ReachSurvey {
 public:
  using Time = exchange::ReachDesk::Time;

  // The `expected` members are in the result whether or not anybody hears them.
  ReachSurvey(AgentId self, std::set<AgentId> expected)
      : desk_(self, exchange::AgentRole::kOperator),
        self_(std::move(self)),
        expected_(std::move(expected)) {}

  // Returns the next question, to be published at once. A member that answers the first one may not
  // be heard yet.
  [[nodiscard]] exchange::ReachRequest Ask(Time now);
  void Hear(const exchange::Message& message, Time now);
  // Returns the result, which has what this program hears itself under its own name, though no
  // member need hear it.
  [[nodiscard]] Reach Result(Time now) const;

 private:
  struct Answer {
    std::uint64_t request = 0;
    exchange::AgentRole role = exchange::AgentRole::kOperator;
    bool star = false;
    std::map<AgentId, exchange::HeardAgent> heard{};
  };
  exchange::ReachDesk desk_;
  AgentId self_;
  std::set<AgentId> expected_;
  std::uint64_t asked_ = 0;
  std::map<AgentId, Answer> answers_;
};

// Returns who should hear another and does not. Servers must hear everybody and be heard by
// everybody; members of a mesh must hear each other.
[[nodiscard]] std::vector<Reach::Trouble> TroublesOf(const Reach& reach);

// Returns whether the addresses of all members that hear each other, and the round trips to
// servers, are known. They are after a question or two.
[[nodiscard]] bool IsMeasured(const Reach& reach);

// Returns a table with a line for each hearing, then the troubles and what to do. It is empty if
// there is no member.
[[nodiscard]] std::string ReachText(const Reach& reach);
// Returns an object for programs, in which null is unknown.
[[nodiscard]] nlohmann::ordered_json ReachJson(const Reach& reach);

}  // namespace trailcast::fleet
