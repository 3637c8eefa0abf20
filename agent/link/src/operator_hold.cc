#include "agent/link/operator_hold.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "services/base/durable_file.h"
#include "services/base/unix_time.h"

namespace trailcast::agent {
namespace {

namespace fs = std::filesystem;
using exchange::NowOrder;

constexpr const char* kStopFirstLine = "trailcast-stop 1";

std::optional<std::string> TextIn(const fs::path& file) {
  std::ifstream stream(file);
  std::string first;
  std::string text;
  if (!std::getline(stream, first) || !std::getline(stream, text)) return std::nullopt;
  return first == kStopFirstLine && !text.empty() ? std::optional(text) : std::nullopt;
}

}  // namespace

void OperatorHold::Load() {
  std::error_code ignored;
  if (file_.empty() || !fs::exists(file_, ignored)) return;
  hold_ = {.kind = Hold::Kind::kStopped,
           .text = TextIn(file_).value_or(
               fmt::format("stopped, nobody knows by whom: {} cannot be read", file_.string()))};
}

Result<void> OperatorHold::Keep() const {
  if (file_.empty()) return {};
  return ReplaceFile(file_, fmt::format("{}\n{}\n", kStopFirstLine, hold_.text));
}

// The robot is stopped first; the answer then says whether the stop outlasts a restart.
OperatorHold::Obeyed OperatorHold::Stop(std::string text) {
  if (hold_.kind == Hold::Kind::kStopped) return {false, hold_.text};
  hold_.kind = Hold::Kind::kStopped;
  hold_.text = std::move(text);
  const auto kept = Keep();
  if (kept) return {false, hold_.text};
  return {false, hold_.text + "; but not after a restart: " + kept.error().message};
}

OperatorHold::Obeyed OperatorHold::Release() {
  if (hold_.kind != Hold::Kind::kStopped) {
    return {false, hold_.text.empty() ? "was not stopped" : hold_.text};
  }
  std::error_code failed;
  if (!file_.empty()) fs::remove(file_, failed);
  if (failed) {
    return {true,
            fmt::format("still stopped: cannot remove {}: {}", file_.string(), failed.message())};
  }
  hold_.kind = Hold::Kind::kPaused;
  hold_.text = "released, and stands until it is told to resume";
  return {false, hold_.text};
}

// A server sends the mission that leads home, with the path from where the robot stands.
OperatorHold::Obeyed OperatorHold::LeaveForHome(const std::string& by, const std::string& why) {
  if (hold_.kind == Hold::Kind::kStopped) return {true, hold_.text + "; release it first"};
  if (hold_.kind == Hold::Kind::kPaused) return {true, hold_.text + "; resume it first"};
  if (teaches_) return {true, "teaches a route: end that first"};
  if (!may_be_sent_) {
    return {true, "hears no server that keeps missions, and so could not be sent home"};
  }
  hold_.cancelled = works_;
  return {false,
          fmt::format("{} by {}{}", works_ ? "ends its mission, and is sent home" : "is sent home",
                      by, why)};
}

void OperatorHold::Pause(std::string text) {
  if (hold_.kind != Hold::Kind::kNone) return;
  hold_.kind = Hold::Kind::kPaused;
  hold_.text = std::move(text);
}

OperatorHold::Obeyed OperatorHold::Obey(const exchange::NowCommand& command, const std::string& by,
                                        std::int64_t unix_ms) {
  const std::string why = command.reason.empty() ? "" : ": " + command.reason;
  switch (command.order) {
    case NowOrder::kPause:
      Pause("paused by " + by + why);
      return {false, hold_.text};
    case NowOrder::kResume:
      if (hold_.kind == Hold::Kind::kStopped) return {true, hold_.text + "; release it first"};
      hold_.kind = Hold::Kind::kNone;
      hold_.text.clear();
      return {false, "drives on"};
    case NowOrder::kCancel:
      if (!works_) return {true, "has no mission to cancel"};
      hold_.cancelled = true;
      return {false, (teaches_ ? "teaching discarded by " : "mission cancelled by ") + by + why};
    case NowOrder::kHome:
      return LeaveForHome(by, why);
    case NowOrder::kStop:
      return Stop(fmt::format("stopped by {} {}{}", by, MomentText(unix_ms), why));
    case NowOrder::kRelease:
      return Release();
    case NowOrder::kEnd:
      if (!teaches_) return {true, "teaches no route"};
      hold_.ended = true;
      return {false, "ends the route that it teaches"};
  }
  return {true, "does not know this command"};
}

}  // namespace trailcast::agent
