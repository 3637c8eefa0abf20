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

// Handles operators' immediate commands to this robot. It obeys each command once, however often it
// comes, and answers it each time. It has no clock of its own.
class NowHandler {
 public:
  // Strangers can make up commands, so no more are remembered.
  static constexpr std::size_t kMostCommands = 1024;

  NowHandler(AgentId self, std::filesystem::path stop_file)
      : self_(std::move(self)), hold_(std::move(stop_file)) {}

  // Loads a stop that an earlier run has left.
  void Load() { hold_.Load(); }
  // These are OperatorHold's.
  void Pause(std::string text) { hold_.Pause(std::move(text)); }
  void ForgetCancelled() { hold_.ForgetCancelled(); }
  void Teaches(bool teaches) { hold_.Teaches(teaches); }
  void Works(bool works) { hold_.Works(works); }
  void MayBeSent(bool may_be_sent) { hold_.MayBeSent(may_be_sent); }

  // `route` is the name of the robot's present route; `unix_ms` is the time by the robot's clock.
  void Handle(const exchange::Message& message, const std::string& route, std::int64_t unix_ms);

  // Returns messages to publish.
  [[nodiscard]] std::vector<exchange::Message> TakeAnswers() { return std::exchange(answers_, {}); }
  // Returns lines for the log about the commands obeyed since the last call.
  [[nodiscard]] std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }
  [[nodiscard]] const Hold& hold() const { return hold_.hold(); }
  // Returns the same as the agent's status shows it.
  [[nodiscard]] exchange::AgentHold shown_hold() const;

 private:
  [[nodiscard]] bool IsMeant(const exchange::NowCommand& command, const std::string& route) const;

  AgentId self_;
  OperatorHold hold_;
  // The answers, by the command's client and number.
  NewestMap<std::pair<AgentId, std::uint64_t>, exchange::NowAnswer> given_{kMostCommands};
  std::vector<exchange::Message> answers_;
  std::vector<std::string> news_;
};

}  // namespace trailcast::agent
