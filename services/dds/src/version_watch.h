#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/base/told_lately.h"
#include "services/dds/src/domain/peers.h"

namespace trailcast::dds {

// Reports participants with another version of the protocol, once and again after a while. It
// ignores other people's DDS: without keys, a participant that names itself as ours do is one of
// us; with keys, one that has proven itself is. It has no clock and knows no DDS.
class VersionWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::minutes kAgain{10};

  VersionWatch(std::uint32_t own, bool keys) : own_(own), keys_(keys) {}

  void See(const std::string& participant, const Peers::SaidOfItself& said);
  void Prove(const std::string& participant);
  void Lose(const std::string& participant);
  // Forgets all, which will be seen again.
  void Forget() { participants_.clear(); }

  // Returns a line for each version that somebody else speaks.
  [[nodiscard]] std::vector<std::string> Tick(Time now);

 private:
  struct Participant {
    std::string who;  // for the line; empty if it was not seen, or is none of us
    std::uint32_t version = 0;
    bool proven = false;
  };

  Participant* Find(const std::string& participant);

  std::uint32_t own_;
  bool keys_;
  std::map<std::string, Participant> participants_;
  ToldLately told_{kAgain};  // who, and which version
};

}  // namespace trailcast::dds
