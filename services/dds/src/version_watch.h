#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/base/told_lately.h"
#include "services/dds/src/domain/peers.h"

namespace trailcast::dds {

// Tells of those that speak another version of the protocol, once, and again after a while. Of
// others' DDS it knows nothing: without keys who gives itself a name like ours is one of us, with
// keys who has proven itself. No clock, no DDS.
class VersionWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::minutes kAgain{10};

  VersionWatch(std::uint32_t own, bool keys) : own_(own), keys_(keys) {}

  void See(const std::string& participant, const Peers::SaidOfItself& said);
  void Prove(const std::string& participant);
  void Lose(const std::string& participant);
  // All are to be seen anew.
  void Forget() { participants_.clear(); }

  // What is to be told, a line for each version that somebody else speaks.
  [[nodiscard]] std::vector<std::string> Tick(Time now);

 private:
  struct Participant {
    std::string who;  // for the line; empty: not seen, or none of us
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
