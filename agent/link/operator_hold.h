#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::agent {

// How an operator keeps a robot standing.
struct Hold {
  enum class Kind { kNone, kPaused, kStopped };
  Kind kind = Kind::kNone;
  bool cancelled = false;  // the robot's present work is cancelled
  bool ended = false;      // its teaching is to be completed
  std::string text{};      // for people: "paused by desk: somebody walks here"; empty if it may
                           // drive
  bool operator==(const Hold&) const = default;
};

// Applies operators' commands to a robot. A stop outlasts the agent and its computer, in a file
// beside the store, until an operator releases it. Only a command to resume lets a robot drive
// again.
class OperatorHold {
 public:
  // Without a file, a stop is not kept.
  explicit OperatorHold(std::filesystem::path file) : file_(std::move(file)) {}

  // Loads a stop that an earlier run has left. A file that cannot be read counts as one, too.
  void Load();

  struct Obeyed {
    bool refused = false;
    std::string detail{};  // for people: the robot's state, or why the command was refused
  };
  // `by` is the operator, for people; `unix_ms` is the time by the robot's clock.
  [[nodiscard]] Obeyed Obey(const exchange::NowCommand& command, const std::string& by,
                            std::int64_t unix_ms);

  // Makes the robot stand for the reason in `text` until it is told to resume. A robot that is held
  // already stays so.
  void Pause(std::string text);
  // Ends a cancellation: it is not for what comes next.
  void ForgetCancelled() { hold_.cancelled = false; }
  // Tells whether there is a teaching that an operator can end.
  void Teaches(bool teaches) {
    teaches_ = teaches;
    hold_.ended = false;
  }

  // Tells whether there is something that an operator can cancel.
  void Works(bool works) { works_ = works; }
  // Tells whether there is a server that can send the robot somewhere.
  void MayBeSent(bool may_be_sent) { may_be_sent_ = may_be_sent; }

  [[nodiscard]] const Hold& hold() const { return hold_; }

 private:
  [[nodiscard]] Obeyed Stop(std::string text);
  [[nodiscard]] Obeyed Release();
  [[nodiscard]] Obeyed LeaveForHome(const std::string& by, const std::string& why);
  [[nodiscard]] Result<void> Keep() const;

  std::filesystem::path file_;
  Hold hold_;
  bool teaches_ = false;
  bool works_ = true;
  bool may_be_sent_ = false;
};

}  // namespace trailcast::agent
