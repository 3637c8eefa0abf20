#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "agent/link/operator_hold.h"
#include "services/base/ids.h"
#include "services/base/newest_map.h"
#include "services/exchange/messages.h"

namespace trailcast::agent {

// Takes what operators tell this robot to do now, obeys each command once however often it comes,
// and answers it each time. No clock of its own.
class NowDesk {
 public:
  // Strangers can make commands up: more are not remembered.
  static constexpr std::size_t kMostCommands = 1024;

  NowDesk(AgentId self, std::filesystem::path stop_file)
      : self_(std::move(self)), hold_(std::move(stop_file)) {}

  // A stop that an earlier run has left.
  void Load() { hold_.Load(); }
  // As OperatorHold has them.
  void Pause(std::string text) { hold_.Pause(std::move(text)); }
  void ForgetCancelled() { hold_.ForgetCancelled(); }
  void Teaches(bool teaches) { hold_.Teaches(teaches); }
  void Works(bool works) { hold_.Works(works); }

  // `route`: the name of the one that the robot is on. `unix_ms`: now, by the robot's clock.
  void Handle(const exchange::Message& message, const std::string& route, std::int64_t unix_ms);

  // To be published.
  [[nodiscard]] std::vector<exchange::Message> TakeAnswers() { return std::exchange(answers_, {}); }
  // What was obeyed since the last call, a line each for the log.
  [[nodiscard]] std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }
  [[nodiscard]] const Hold& hold() const { return hold_.hold(); }
  // The same as the agent's status has it.
  [[nodiscard]] exchange::AgentHold shown_hold() const;

 private:
  [[nodiscard]] bool IsMeant(const exchange::NowCommand& command, const std::string& route) const;

  AgentId self_;
  OperatorHold hold_;
  // To each command, by its client and number.
  NewestMap<std::pair<AgentId, std::uint64_t>, exchange::NowAnswer> given_{kMostCommands};
  std::vector<exchange::Message> answers_;
  std::vector<std::string> news_;
};

}  // namespace trailcast::agent
