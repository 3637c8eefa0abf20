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

// Who hears whom in a fleet, how late and over what.
struct Reach {
  // A server or a robot.
  struct Member {
    AgentId name{};
    std::optional<exchange::AgentRole> role{};  // nothing: nobody hears it
    std::optional<bool> star{};                 // it meets route servers alone; nothing: no answer
    bool operator==(const Member&) const = default;
  };
  struct Hearing {
    AgentId by{};
    exchange::HeardAgent heard{};
    bool operator==(const Hearing&) const = default;
  };
  // Somebody who should hear another, and does not or does not say so.
  struct Trouble {
    AgentId member{};  // whom to look at
    std::string what{};
    std::string advice{};
    bool operator==(const Trouble&) const = default;
  };
  std::vector<Member> members{};    // by name
  std::vector<Hearing> hearings{};  // by who is heard, then by who hears
  std::vector<Trouble> troubles{};

  // All hear each other who have to.
  [[nodiscard]] bool complete() const { return !members.empty() && troubles.empty(); }
};

// Asks all that are there, directly and through servers, and gathers what they answer. No I/O, no
// clock.
class ReachSurvey {
 public:
  using Time = exchange::ReachDesk::Time;

  // `expected`: who shall be there, whether or not anybody hears them.
  ReachSurvey(AgentId self, std::set<AgentId> expected)
      : desk_(self, exchange::AgentRole::kOperator),
        self_(std::move(self)),
        expected_(std::move(expected)) {}

  // The next question, to be published now; who answers the first one may not be heard yet.
  [[nodiscard]] exchange::ReachRequest Ask(Time now);
  void Hear(const exchange::Message& message, Time now);
  // What this program hears itself is in it under its own name, though nobody need hear it.
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

// Servers are to hear everybody and to be heard by everybody, members of a mesh each other.
[[nodiscard]] std::vector<Reach::Trouble> TroublesOf(const Reach& reach);

// Of all who hear each other it is known from where, and to and from servers how long it takes
// there and back, which is so after a question or two.
[[nodiscard]] bool IsMeasured(const Reach& reach);

// A line a hearing below a line of heads, then the troubles and what to do. Empty where nobody is.
[[nodiscard]] std::string ReachText(const Reach& reach);
// For programs; null is what is not known.
[[nodiscard]] nlohmann::ordered_json ReachJson(const Reach& reach);

}  // namespace trailcast::fleet
