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

// Tells of each who tries to take part and may not, once, with who and why. Puts together what
// Cyclone warns of and which participants are seen; no clock, no DDS. Participants go by the first
// three words of their GUID, as Cyclone writes them: "b4bcbdad:8cb94d6f:9f600af6".
class StrangerWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // A member proves itself in well under a second; on a bad radio link in several.
  static constexpr std::chrono::seconds kPatience{10};
  static constexpr std::chrono::minutes kAgain{10};

  // A participant is there, a stranger until it is proven.
  void See(const std::string& participant, const Peers::SaidOfItself& said, Time now);
  // It is a member: it can be understood. `about` says which, if that is known.
  void Prove(const std::string& participant, const std::string& about);
  void Lose(const std::string& participant);

  // A warning of Cyclone's. False if it is none about a stranger.
  bool HandleWarning(std::string_view line, Time now);
  // A member did what is not its to do.
  void HandleMisuse(const std::string& who, const std::string& why, Time now);

  // What is to be told.
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
  ToldLately told_{kAgain};                 // who, and why
  std::vector<std::string> lines_;
};

}  // namespace trailcast::dds
