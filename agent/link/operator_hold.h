#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::agent {

// How an operator has a robot stand.
struct Hold {
  enum class Kind { kNone, kPaused, kStopped };
  Kind kind = Kind::kNone;
  bool cancelled = false;  // what the robot does is over
  bool ended = false;      // what it teaches is complete
  std::string text{};      // for people: "paused by desk: somebody walks here"; empty: it may drive
  bool operator==(const Hold&) const = default;
};

// What operators' words make of a robot. A stop outlasts its agent and its computer, in a file
// beside the store, until an operator releases it; nothing but a word to resume lets a robot drive
// again.
class OperatorHold {
 public:
  // Empty: a stop is not kept.
  explicit OperatorHold(std::filesystem::path file) : file_(std::move(file)) {}

  // A stop that an earlier run has left. A file that cannot be read is one, too.
  void Load();

  struct Obeyed {
    bool refused = false;
    std::string detail{};  // for people: how the robot is now, or why not
  };
  // `by`: who said it, for people. `unix_ms`: when, by the robot's clock.
  [[nodiscard]] Obeyed Obey(const exchange::NowCommand& command, const std::string& by,
                            std::int64_t unix_ms);

  // The robot stands until it is told to resume, and why; one that stands already goes on standing.
  void Pause(std::string text);
  // What was cancelled is over: what comes next is not.
  void ForgetCancelled() { hold_.cancelled = false; }
  // Whether there is a teaching to be ended, which is not yet.
  void Teaches(bool teaches) {
    teaches_ = teaches;
    hold_.ended = false;
  }

  // Whether there is something that can be cancelled.
  void Works(bool works) { works_ = works; }

  [[nodiscard]] const Hold& hold() const { return hold_; }

 private:
  [[nodiscard]] Obeyed Stop(std::string text);
  [[nodiscard]] Obeyed Release();
  [[nodiscard]] Result<void> Keep() const;

  std::filesystem::path file_;
  Hold hold_;
  bool teaches_ = false;
  bool works_ = true;
};

}  // namespace trailcast::agent
