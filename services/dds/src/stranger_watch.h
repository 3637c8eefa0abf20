#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/told_lately.h"
#include "services/dds/src/domain/peers.h"

namespace trailcast::dds {

// Reports each participant that tries to take part without permission, once, with its name and the
// reason. It combines Cyclone's warnings with the participants that are seen. It has no clock and
// knows no DDS. Participants are named by the first three words of their GUID, as Cyclone writes
// them: "b4bcbdad:8cb94d6f:9f600af6".
class StrangerWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // A member proves itself in well under a second, or in several on a bad radio link.
  static constexpr std::chrono::seconds kPatience{10};
  static constexpr std::chrono::minutes kAgain{10};

  // Notes a participant, which is a stranger until it is proven.
  void See(const std::string& participant, const Peers::SaidOfItself& said, Time now);
  // Notes that it is a member, because it can be decrypted. `about` names it, if that is known.
  void Prove(const std::string& participant, const std::string& about);
  void Lose(const std::string& participant);

  // Takes a warning of Cyclone's; returns false if it is not about a stranger.
  bool HandleWarning(std::string_view line, Time now);
  // Notes that a member did something that it may not do.
  void HandleMisuse(const std::string& who, const std::string& why, Time now);

  // Returns the lines to be reported.
  [[nodiscard]] std::vector<std::string> Tick(Time now);

 private:
  struct Participant {
    std::string about;
    Time seen_at;
    bool names_itself = false;
    bool proven = false;
    bool told = false;
  };
  struct Refused {
    Time first_at{};
    Time last_at{};
    bool matched = false;  // with a participant that was not proven
  };

  void Tell(const std::string& who, const std::string& why, Time now);
  [[nodiscard]] bool IsExplained(const Participant& participant);
  [[nodiscard]] const Participant* OwnerOf(const Refused& refused) const;
  [[nodiscard]] std::string Describe(const std::string& participant) const;

  std::map<std::string, Participant> participants_;
  std::map<std::string, Refused> refused_;  // by the certificate's subject
  ToldLately told_{kAgain};                 // who, and the reason
  std::vector<std::string> lines_;
};

}  // namespace trailcast::dds
