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

// This is something that a person has to see to now, in words for people.
struct Cause {
  std::string kind{};  // each subject has each kind at most once
  std::string subject{};
  bool of_server = false;  // the subject is a server, not a robot
  bool alarm = false;      // otherwise it is a warning
  std::string reason{};
  std::string place{};   // empty if not known
  std::string action{};  // what to do

  bool operator==(const Cause&) const = default;
};

struct Alert {
  std::string id{};
  Cause cause{};
  bool known = true;  // false if nothing was heard of the subject since the console started
  std::int64_t since_unix_ms = 0;
  std::string acknowledged_by{};  // empty if nobody has
  std::int64_t acknowledged_unix_ms = 0;
  std::int64_t ended_unix_ms = 0;  // 0 if it is open

  [[nodiscard]] bool open() const { return ended_unix_ms == 0; }
};

// This keeps what people have to see to, since when, and who has acknowledged it. An alert ends by
// itself once its cause has ended. It has no I/O and no clock.
class Alerts {
 public:
  // So many alerts that have ended are kept, the last ones. No more begin when so many are open.
  static constexpr std::size_t kMostEnded = 500;
  static constexpr std::size_t kMostOpen = 4096;

  // Takes what there is to see to now. Alerts about robots and servers that are not in `subjects`
  // stay unchanged, as nothing is known of them yet. So do alerts from before the console started
  // about those that are `unsure`, of which not all is known that could cause alerts.
  void Note(const std::vector<Cause>& causes, const std::set<std::string>& subjects,
            const std::set<std::string>& unsure, std::int64_t unix_ms);
  // Ends all alerts about a subject, which is no longer listed. Returns false if there was none.
  bool End(const std::string& subject, std::int64_t unix_ms);
  // Fails with kNotFound if no open alert has this id. An alert that is acknowledged stays so.
  [[nodiscard]] Result<void> Acknowledge(const std::string& id, const std::string& by,
                                         std::int64_t unix_ms);

  [[nodiscard]] bool IsOpen(const std::string& subject, const std::string& kind) const;
  // Returns a number that rises whenever something changes that is kept.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  // These show openapi.yaml's Alert for each: those that are open, or all, the newest first.
  [[nodiscard]] nlohmann::ordered_json OpenShown() const;
  [[nodiscard]] nlohmann::ordered_json AllShown() const;

  // These write and read what is kept in a file. Reading fails with kCorrupt.
  [[nodiscard]] std::string Text() const;
  [[nodiscard]] static Result<Alerts> Read(const std::string& text);

 private:
  void EndOne(Alert& alert, std::int64_t unix_ms);
  void DropOld();

  std::deque<Alert> alerts_;  // the oldest first
  std::uint64_t changes_ = 0;
};

}  // namespace trailcast::console
