#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "services/base/newest_map.h"
#include "services/base/told_lately.h"
#include "services/exchange/messages.h"
#include "services/records/mission_store.h"

namespace trailcast::server {

// Makes the report with which a server answers a mission that it does not take now.
[[nodiscard]] mission::Report PutOff(const mission::Mission& mission, const std::string& why);

// Keeps operators' missions for robots. It stores a mission before it says so, and remembers the
// outcome. It also stores operators' immediate commands and the robots' answers. It has no clock of
// its own.
//
// The missions of one robot are a queue. The oldest is handed over once the robot is heard, has no
// other mission, and is not held by an operator. The queue goes on by itself only after a mission
// that has arrived, because what comes next may begin where the one before was to end. After any
// other end, and after a stop, it is held until the robot is told to resume, also over a restart of
// this server, and even if the robot never heard of the stop. A robot that obeys a command to go
// home is sent there before its queue, which is held likewise. A command that sends all robots home
// holds the queues of all, and also missions that are sent later.
//
// A mission for a group (mission/address.h) waits in a queue of the group, and is given to the
// first robot of it that is free. One for several is taken for all of them or not at all.
class MissionRegistry {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Strangers can make up names, so beyond this number the one with the oldest news is forgotten.
  static constexpr std::size_t kMostAgents = 4096;

  // Loads the missions that no robot has answered.
  [[nodiscard]] static Result<std::unique_ptr<MissionRegistry>> Open(
      AgentId server, std::unique_ptr<store::MissionStore> store);

  void Handle(const exchange::Message& message, Time now, std::int64_t now_unix_ms);
  // Returns true, and reports it, if a mission's orders cannot be understood.
  [[nodiscard]] bool Refuses(const mission::Mission& mission);
  // Takes missions from operators and stores them in one commit.
  void Take(std::span<const mission::Mission> missions, Time now, std::int64_t now_unix_ms);
  // Returns messages to publish.
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now, std::int64_t now_unix_ms);
  // News since the last call, as lines for the log; trouble is a warning.
  struct Note {
    std::string text;
    bool warning = false;
  };
  [[nodiscard]] std::vector<Note> TakeNotes() { return std::exchange(notes_, {}); }
  [[nodiscard]] std::size_t unanswered() const;
  [[nodiscard]] store::MissionStore& store() { return *store_; }
  // Returns why the last attempt to store something failed, or an empty text.
  [[nodiscard]] const std::string& untaken() const { return untaken_; }

  // Returns a robot's present mission by its own report, or null if it has none, or none that is
  // known here.
  [[nodiscard]] const mission::Record* CurrentOf(const AgentId& agent) const;
  [[nodiscard]] std::vector<AgentId> AtWork() const;
  // Tells whether a path leads from where a robot stands to a goal; false means that the robot is
  // there already. It is asked when a mission to a place is handed over that has waited for others.
  using CheckWay = std::function<Result<bool>(const AgentId& agent, const std::string& goal)>;
  void PlanBy(CheckWay check_way) { check_way_ = std::move(check_way); }
  // Returns why the first mission of a robot's queue has to wait although the robot could begin it,
  // or an empty text.
  using CheckFirst = std::function<std::string(const mission::Record& first)>;
  void WaitBy(CheckFirst check_first) { check_first_ = std::move(check_first); }
  // Sends a robot another path (mission::Going). It is on the disk when this returns, and is
  // repeated as long as the mission lasts.
  [[nodiscard]] Result<void> Amend(const AgentId& agent, const std::string& orders);

  // The following is for whoever sends robots somewhere before their queues.
  //
  // Returns what waits for a robot, the first first.
  [[nodiscard]] std::vector<const mission::Record*> QueueOf(const AgentId& agent) const;
  // Returns the robots' present missions, and those that were handed over and are not answered.
  [[nodiscard]] std::vector<const mission::Record*> HandedOver() const;
  [[nodiscard]] bool IsAtWork(const AgentId& agent) const {
    return unended_.Find(agent) != nullptr;
  }
  // Returns the mission that a robot has ended last, or null if none is known. One that was dropped
  // here before its robot had it does not count, unless it is at its end already or was to charge.
  [[nodiscard]] const mission::Record* LastEnded(const AgentId& agent);
  // Tells whether the first mission of a robot's queue was handed over to it.
  [[nodiscard]] bool IsHanded(const AgentId& agent) const;
  // Takes a mission as the first of its robot's queue. Returns false if it is not stored.
  [[nodiscard]] bool TakeFirst(const mission::Mission& mission, Time now, std::int64_t now_unix_ms);
  // Gives a mission that waits another destination. It is on the disk when this returns.
  [[nodiscard]] Result<void> Direct(const mission::Record& waiting, const std::string& goal);
  // Drops a mission that waits and is no longer needed.
  void Withdraw(const mission::Record& waiting, const std::string& why, std::int64_t now_unix_ms);
  // Holds a robot's queue, or lets it go; it is on the disk when this returns. A hold that `stays`
  // holds also what is sent later.
  void Hold(const AgentId& agent, const std::string& why, std::int64_t now_unix_ms,
            bool stays = false);
  // Returns why a robot's queue is held, or an empty text.
  [[nodiscard]] std::string HeldBy(const AgentId& agent) const;
  // Returns for what the first mission of a robot's queue waits, in words, or an empty text.
  [[nodiscard]] std::string WhyNotNow(const AgentId& agent) const;
  // Tells whether a command means a robot, by its name or by one of its missions here.
  [[nodiscard]] bool IsMeant(const exchange::NowCommand& command, const AgentId& agent) const;
  // Notes that what a robot's queue waits for may have changed.
  void NoteQueue(const AgentId& agent) { changed_.insert(agent); }

 private:
  MissionRegistry(AgentId server, std::unique_ptr<store::MissionStore> store)
      : server_(std::move(server)), store_(std::move(store)) {}

  void On(const mission::Report& report, std::int64_t now_unix_ms);
  void On(const exchange::MissionRequest& request);
  [[nodiscard]] Result<void> LookUp(const exchange::MissionRequest& request,
                                    exchange::MissionReply& reply);
  [[nodiscard]] std::vector<std::string> RobotsLike(const std::string& robot) const;
  void On(const exchange::NowCommand& command, Time now, std::int64_t now_unix_ms);
  void On(const exchange::NowAnswer& answer, Time now, std::int64_t now_unix_ms);
  // Sends a robot home that has answered that it obeys.
  void SendHome(const exchange::NowCommand& command, const AgentId& agent, Time now,
                std::int64_t now_unix_ms);
  void On(const exchange::AgentStatus& status, Time now);
  void On(const exchange::AgentGone& gone);
  [[nodiscard]] Result<void> LoadQueues();
  [[nodiscard]] Result<void> LoadCurrent();
  void NoteCurrent(const mission::Report& report);
  // Notes a report on a mission that no operator sent over this server.
  void NoteOther(const mission::Report& report);
  // Asks robots that are met whether they still do the missions that are taken to be under way.
  void Agree(Time now);
  void Keep(const mission::Mission& mission, mission::Record stored);
  void TakeForAll(const mission::Mission& mission, const std::vector<std::string>& addressed,
                  Time now, std::int64_t now_unix_ms);
  // Returns the same mission for the robot of its group that has it already, if there is one.
  [[nodiscard]] Result<mission::Mission> AsTaken(mission::Mission mission);
  // Gives missions of groups to robots that are free.
  void GiveToGroups();
  [[nodiscard]] std::vector<AgentId> HeardOf(const AgentId& group) const;
  // Returns why a robot cannot begin a mission of its group now, or an empty text.
  [[nodiscard]] std::string WhyNotFree(const AgentId& robot, const mission::Record& record) const;
  [[nodiscard]] std::string WhyNobodyIsFree(const AgentId& group) const;
  [[nodiscard]] std::string AtWorkText(const AgentId& agent) const;
  [[nodiscard]] bool IsHeard(const AgentId& agent) const;
  // Answers a command to a group, which means what waits for it.
  void AnswerForGroup(const exchange::NowCommand& command);
  // Drops, in one commit, the missions that no robot has answered and for which `why` gives a
  // reason. `expires` is by the time that passes here, however the server's clock is set meanwhile;
  // it is empty until the mission was first looked at. `since_unix_ms` is when its robot could have
  // taken it for the first time.
  struct Waiting : mission::Record {
    explicit Waiting(mission::Record record)
        : mission::Record(std::move(record)), since_unix_ms(sent_unix_ms) {}
    std::int64_t since_unix_ms;
    std::optional<Time> expires{};
    mission::Report told{};  // the last report on what it waits for
    bool is_asked = false;   // its sender is to hear that report
    bool is_handed = false;  // its robot may have it
  };
  using Queue = std::deque<Waiting>;
  using Why = std::function<std::optional<std::string>(const Waiting&)>;
  // Holds the queues of those behind which others follow, if `holds`.
  void Drop(mission::State state, const Why& why, std::int64_t now_unix_ms, bool holds = true);
  void Expire(Time now, std::int64_t now_unix_ms);
  // Makes the report on a mission that waits, behind `before` if that is not null.
  [[nodiscard]] mission::Report Waits(const Waiting& record, const Waiting* before) const;
  void TellQueues();
  void LetGo(const AgentId& agent, std::int64_t now_unix_ms);
  void HoldAfter(const mission::Report& end, std::int64_t now_unix_ms);
  void HoldOrLetGo(const exchange::NowCommand& command, std::int64_t now_unix_ms);
  void NoteEnded(const AgentId& agent, const std::string& id);
  // Gives a mission to a place that has waited for others the path from where its robot stands by
  // now. Returns false if it has ended instead.
  [[nodiscard]] bool PlanAnew(const Waiting& record, std::int64_t now_unix_ms);
  void NoteWaited(Waiting& record);
  void HandOver(Time now, std::int64_t now_unix_ms);
  void Say(mission::Report report);
  void Warn(const Error& error) { notes_.push_back({error.message, true}); }
  // Notes whether storing worked.
  template <typename Stored>
  void NoteStored(const Stored& stored) {
    untaken_ = stored ? "" : stored.error().message;
  }

  AgentId server_;
  std::unique_ptr<store::MissionStore> store_;
  // Each robot's missions that it has not answered, the oldest first.
  std::map<AgentId, Queue> unanswered_;
  // Why queues are held, or an empty text for those that were let go.
  std::map<AgentId, store::MissionStore::Hold> holds_;
  NewestMap<AgentId, std::optional<mission::Record>> ended_{kMostAgents};  // as far as looked up
  std::set<AgentId> changed_;  // the robots of whose queues there may be news
  struct Current {
    mission::Record record{};
    Time tell_at{};  // for a second or later path
  };
  NewestMap<AgentId, Current> current_{kMostAgents};
  // Each robot's last reports on its missions that have not ended, by their ids. It may have lost
  // them since, with its disk.
  NewestMap<AgentId, std::map<std::string, mission::Report>> unended_{kMostAgents};
  // The robots that were heard since the server started.
  NewestMap<AgentId, std::monostate> met_{kMostAgents};
  struct Heard {
    std::uint64_t instance = 0;
    Time tell_at{};
    std::chrono::milliseconds pause{};  // the next pause before it is told again
    Time agree_at{};
    std::chrono::milliseconds agree_pause{};  // likewise
    exchange::AgentHold hold = exchange::AgentHold::kNone;
    std::string hold_text{};  // in the robot's words
  };
  NewestMap<AgentId, Heard> heard_{kMostAgents};
  Time expire_at_{};
  Time give_at_{};  // missions to groups
  // The commands and answers that are stored, because they are repeated.
  using NowKey = std::pair<AgentId, std::uint64_t>;
  NewestMap<NowKey, std::optional<exchange::NowCommand>> commands_{kMostAgents};
  NewestMap<std::pair<AgentId, NowKey>, std::optional<exchange::NowAnswer>> answers_{kMostAgents};
  CheckWay check_way_;
  CheckFirst check_first_;
  // Missions that cannot be stored are repeated, too.
  ToldLately told_{std::chrono::milliseconds(60'000)};
  std::vector<exchange::Message> outgoing_;
  std::vector<Note> notes_;
  std::string untaken_;
};

}  // namespace trailcast::server
