#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::console {

// What somebody has to see to now, in words for people.
struct Cause {
  std::string kind{};  // of one subject each kind is there once
  std::string subject{};
  bool of_server = false;  // the subject is one, not a robot
  bool alarm = false;      // otherwise a warning
  std::string reason{};
  std::string place{};   // empty: not known
  std::string action{};  // what to do

  bool operator==(const Cause&) const = default;
};

struct Alert {
  std::string id{};
  Cause cause{};
  bool known = true;  // false: nothing was heard of the subject since the console started
  std::int64_t since_unix_ms = 0;
  std::string acknowledged_by{};  // empty: nobody has
  std::int64_t acknowledged_unix_ms = 0;
  std::int64_t ended_unix_ms = 0;  // 0: it is open

  [[nodiscard]] bool open() const { return ended_unix_ms == 0; }
};

// Keeps what somebody has to see to, since when, and who has acknowledged it. An alert ends by
// itself once its cause has. No I/O, no clock.
class Alerts {
 public:
  // Of those that have ended the last stay so many; of those that are open at most so many begin.
  static constexpr std::size_t kMostEnded = 500;
  static constexpr std::size_t kMostOpen = 4096;

  // Takes what there is to see to now. Alerts about who is not in `subjects` stay as they are:
  // nothing is known of them yet. So do those of before the console started about who is `unsure`:
  // not all is known that they may be about.
  void Note(const std::vector<Cause>& causes, const std::set<std::string>& subjects,
            const std::set<std::string>& unsure, std::int64_t unix_ms);
  // All that are about a subject end: it is listed no more. False: none was.
  bool End(const std::string& subject, std::int64_t unix_ms);
  // kNotFound where no open alert has this id. One that is acknowledged stays so.
  [[nodiscard]] Result<void> Acknowledge(const std::string& id, const std::string& by,
                                         std::int64_t unix_ms);

  [[nodiscard]] bool IsOpen(const std::string& subject, const std::string& kind) const;
  // Counts up whenever something of it changes that is kept.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  // Show openapi.yaml's Alert each: those that are open, or all, the newest first.
  [[nodiscard]] nlohmann::ordered_json OpenShown() const;
  [[nodiscard]] nlohmann::ordered_json AllShown() const;

  // What is kept in a file, and read again. kCorrupt.
  [[nodiscard]] std::string Text() const;
  [[nodiscard]] static Result<Alerts> Read(const std::string& text);

 private:
  void EndOne(Alert& alert, std::int64_t unix_ms);
  void DropOld();

  std::deque<Alert> alerts_;  // the oldest first
  std::uint64_t changes_ = 0;
};

}  // namespace trailcast::console
