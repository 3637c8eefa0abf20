#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/webhooks/event.h"
#include "services/webhooks/hook.h"

namespace trailcast::webhooks {

// This is all that hooks still have to be told, in order: a hook that does not answer holds back
// its own events alone. It has no I/O and no clock. Times are in milliseconds since 1970, which go
// on while the program is not running. A clock that is set back makes nobody wait for longer than
// kLongestWait_ms.
class Outbox {
 public:
  static constexpr std::size_t kMostWaiting = 200;  // for each hook; the oldest are dropped
  static constexpr std::int64_t kFirstWait_ms = 1000;
  static constexpr std::int64_t kLongestWait_ms = 600'000;  // doubled up to this
  static constexpr int kMostTries = 154;                    // in a day

  explicit Outbox(const std::vector<Hook>& hooks);

  // Returns the hooks for which their oldest event was dropped, by their places in the list.
  std::vector<std::size_t> Add(const Event& event, std::int64_t unix_ms);

  struct Delivery {
    std::size_t hook = 0;  // its place in the list of hooks
    Event event{};
    int tries = 0;  // before this one
  };
  // Returns one that is due, or nothing.
  [[nodiscard]] std::optional<Delivery> Due(std::int64_t unix_ms) const;
  // Returns when the next one is due, or nothing if none waits.
  [[nodiscard]] std::optional<std::int64_t> NextDue() const;
  // The delivery has arrived, or is to be tried again. Returns false if it is given up.
  void Arrived(const Delivery& delivery);
  [[nodiscard]] bool Failed(const Delivery& delivery, std::int64_t unix_ms);

  [[nodiscard]] std::size_t waiting() const;
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

  // These write and read what outlasts a restart: what waits, by URL, and what was seen. Hooks that
  // are no longer there are left out. kCorrupt means that the text is nothing of ours.
  [[nodiscard]] std::string Text(const std::map<std::string, std::string>& seen) const;
  struct Kept;
  [[nodiscard]] static Result<Kept> Read(const std::vector<Hook>& hooks, const std::string& text);

 private:
  struct Waiting {
    Event event{};
    std::int64_t due_ms = 0;
    int tries = 0;
  };
  [[nodiscard]] static bool IsDue(const Waiting& waiting, std::int64_t unix_ms);
  [[nodiscard]] Waiting* Find(const Delivery& delivery);

  std::vector<Hook> hooks_;
  std::vector<std::deque<Waiting>> waiting_;  // by hook
  std::uint64_t dropped_ = 0;
};

struct Outbox::Kept {
  Outbox outbox;
  std::map<std::string, std::string> seen{};
};

}  // namespace trailcast::webhooks
