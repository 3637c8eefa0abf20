#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace trailcast::webhooks {

struct Event {
  std::string id{};    // unique, so that a receiver can tell what came twice
  std::string name{};  // "alert.began", "mission.arrived"
  std::string body{};  // JSON
};

// Finds what has happened by comparing what is with what was. It has no I/O and no clock.
//
// alert.began, alert.acknowledged, alert.ended; mission.sent and so on, a mission's states with '-'
// for blanks: mission.under-way.
class EventFinder {
 public:
  // No more are remembered, apart from those that are there now.
  static constexpr std::size_t kMostSeen = 4096;

  // `seen` is from Seen of an earlier run. A state from before the first look of all is no news,
  // whenever it is heard of.
  explicit EventFinder(std::map<std::string, std::string> seen = {}) : seen_(std::move(seen)) {}

  // `alerts` and `missions` are lists as openapi.yaml has them; missions are null while nobody
  // knows them. An event of an alert has it as "alert", one of a mission as "mission".
  [[nodiscard]] std::vector<Event> Look(const nlohmann::ordered_json& alerts,
                                        const nlohmann::ordered_json& missions,
                                        std::int64_t unix_ms);
  // Returns what each alert and mission was at the last look.
  [[nodiscard]] const std::map<std::string, std::string>& Seen() const { return seen_; }

 private:
  void Compare(const char* kind, const nlohmann::ordered_json& list, std::int64_t unix_ms,
               std::vector<Event>& events);
  [[nodiscard]] std::int64_t Began(std::int64_t unix_ms);

  std::map<std::string, std::string> seen_;  // state by "alert ID" or "mission ROBOT ID"
};

}  // namespace trailcast::webhooks
