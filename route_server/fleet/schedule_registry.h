#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"
#include "services/records/mission_store.h"
#include "services/schedule/listed.h"
#include "services/schedule/schedule.h"

namespace trailcast::server {

// Sends robots missions at times (schedule/schedule.h), which are in the missions' store. It has no
// clock of its own.
//
// A mission is named after its schedule and the time at which it is due. A server that was killed
// between sending it and noting so sends it again, and the robot does it once. However a clock
// jumps, a schedule sends each robot at most one mission for the time that has passed.
class ScheduleRegistry {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMostSchedules = 200;
  static constexpr std::size_t kMostRobotsEach = 64;  // of patterns, together
  // Strangers can make up names, so beyond this number the one with the oldest news is forgotten.
  static constexpr std::size_t kMostAgents = 4096;
  // Times count as missed if they are noticed later than this.
  static constexpr std::chrono::milliseconds kOnTime{60'000};
  // A robot that is not heard, or has not told its battery, is waited for this long, because the
  // server may have just started.
  static constexpr std::chrono::milliseconds kPatience{10'000};
  // A moment that lies further ahead than this was noted by a clock that was set back since.
  static constexpr std::chrono::milliseconds kAhead{60'000};

  // This is asked of the other parts of the server.
  struct Site {
    // Stores missions for robots. Each of them is in the store afterwards unless that failed.
    std::function<void(std::span<const mission::Mission>, Time, std::int64_t now_unix_ms)> take;
    // Returns what is closed of the routes in these orders, "hall 3..7 is closed", or an empty
    // text.
    std::function<std::string(const std::string& orders)> closed;
  };

  // Loads the schedules. `store` must outlive this.
  [[nodiscard]] static Result<std::unique_ptr<ScheduleRegistry>> Open(AgentId server,
                                                                      store::MissionStore& store,
                                                                      Site site);

  // Makes a change, which is on the disk when this returns. A repeated request is answered again,
  // but carried out once.
  [[nodiscard]] exchange::NetworkReply Change(const exchange::NetworkEdit& edit,
                                              std::int64_t now_unix_ms);
  [[nodiscard]] exchange::NetworkReply Answer(const exchange::NetworkRequest& request);
  // Hears which robots there are, and how their batteries are.
  void Hear(const exchange::Message& message);
  void Tick(Time now, std::int64_t now_unix_ms);
  // News since the last call, as lines for the log.
  [[nodiscard]] std::vector<std::string> TakeNotes() { return std::exchange(notes_, {}); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    schedule::Schedule schedule{};
    store::MissionStore::Schedule kept{};
    std::optional<std::int64_t> next_unix_ms{};
    std::optional<Time> waits_since{};  // since it has been due
  };
  // Tells whether a robot is sent now. `why_not` says why it is not; `perhaps` that it may be soon.
  struct Verdict {
    AgentId agent{};
    std::string why_not{};
    bool perhaps = false;
  };

  ScheduleRegistry(AgentId server, store::MissionStore& store, Site site)
      : server_(std::move(server)), store_(store), site_(std::move(site)) {}

  [[nodiscard]] Result<std::vector<std::string>> Carry(const std::string& words,
                                                       const AgentId& client,
                                                       std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> Add(schedule::Schedule schedule, const std::string& by,
                                 std::int64_t now_unix_ms);
  // The missions that it sent stay known, and times that have passed are not missed.
  [[nodiscard]] Result<void> Replace(Entry& entry, schedule::Schedule schedule,
                                     const std::string& by, std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> Pause(Entry& entry, const std::string& by);
  [[nodiscard]] Result<void> Resume(Entry& entry, std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> Keep(Entry& entry, store::MissionStore::Schedule kept);
  void Look(Entry& entry, Time now, std::int64_t now_unix_ms);
  // Sends the mission that was due, or notes why it is not sent. Does neither if that may change
  // soon.
  void Fire(Entry& entry, std::int64_t due_unix_ms, Time now, std::int64_t now_unix_ms);
  [[nodiscard]] std::vector<Verdict> Judge(const Entry& entry, const std::string& mission);
  [[nodiscard]] Verdict JudgeRobot(const Entry& entry, const AgentId& agent,
                                   const std::string& mission);
  [[nodiscard]] std::set<AgentId> RobotsOf(const schedule::Schedule& schedule) const;
  // Tells whether there may be robots of a pattern that were not heard since this server started.
  [[nodiscard]] bool MayMissSome(const schedule::Schedule& schedule, Time now) const;
  [[nodiscard]] std::optional<mission::Report> LastReport(const AgentId& agent,
                                                          const std::string& mission);
  void Conclude(Entry& entry, std::int64_t due_unix_ms, std::string outcome,
                std::vector<store::MissionStore::Schedule::Sent> sent);
  [[nodiscard]] schedule::Listed ListedAs(const Entry& entry);

  AgentId server_;
  store::MissionStore& store_;
  Site site_;
  std::map<std::string, Entry> entries_;
  // The batteries of the robots that are heard, if they tell them.
  NewestMap<AgentId, std::optional<std::uint8_t>> heard_{kMostAgents};
  std::optional<Time> began_{};
  std::optional<Time> look_at_{};
  // The answers to the last edits.
  NewestMap<std::pair<AgentId, std::uint64_t>, std::optional<exchange::NetworkReply>> answered_{64};
  std::vector<std::string> notes_;
};

}  // namespace trailcast::server
