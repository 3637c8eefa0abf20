#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/base/told_lately.h"
#include "services/exchange/messages.h"
#include "services/records/mission_store.h"

namespace trailcast::server {

// A server answers with this report to a mission that it does not take now.
[[nodiscard]] mission::Report PutOff(const mission::Mission& mission, const std::string& why);

// Keeps what operators send robots to do: stores it before it says so, hands it over once the robot
// is heard, and remembers what became of it; also what they tell robots to do now, and what these
// answer. No clock of its own.
class MissionBoard {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Strangers can make up names: beyond it the one is forgotten that was not heard of for longest.
  static constexpr std::size_t kMostAgents = 4096;

  // Loads those that no robot has answered.
  [[nodiscard]] static Result<std::unique_ptr<MissionBoard>> Open(
      AgentId server, std::unique_ptr<store::MissionStore> store);

  void Handle(const exchange::Message& message, Time now, std::int64_t now_unix_ms);
  // Whether nobody understands a mission's orders, which it then says.
  [[nodiscard]] bool Refuses(const mission::Mission& mission);
  // Missions that operators have sent, stored with one commit.
  void Take(std::span<const mission::Mission> missions, Time now, std::int64_t now_unix_ms);
  // What is to be published.
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now, std::int64_t now_unix_ms);
  // What is new since the last call, a line each for the log; a trouble is a warning.
  struct Note {
    std::string text;
    bool warning = false;
  };
  [[nodiscard]] std::vector<Note> TakeNotes() { return std::exchange(notes_, {}); }
  [[nodiscard]] std::size_t unanswered() const;
  // Why what was last to be stored was not; empty: it was.
  [[nodiscard]] const std::string& untaken() const { return untaken_; }

  // What a robot is at, by its own word; null: nothing, or nothing that is known here.
  [[nodiscard]] const mission::Record* CurrentOf(const AgentId& agent) const;
  [[nodiscard]] std::vector<AgentId> AtWork() const;
  // It goes another way (mission::Going): on the disk when it returns, and told to the robot, again
  // and again, as long as the mission lasts.
  [[nodiscard]] Result<void> Amend(const AgentId& agent, const std::string& orders);

 private:
  MissionBoard(AgentId server, std::unique_ptr<store::MissionStore> store)
      : server_(std::move(server)), store_(std::move(store)) {}

  void On(const mission::Report& report, std::int64_t now_unix_ms);
  void On(const exchange::MissionRequest& request);
  [[nodiscard]] Result<void> LookUp(const exchange::MissionRequest& request,
                                    exchange::MissionReply& reply);
  void On(const exchange::NowCommand& command, std::int64_t now_unix_ms);
  void On(const exchange::NowAnswer& answer);
  void On(const exchange::AgentStatus& status, Time now);
  void On(const exchange::AgentGone& gone);
  [[nodiscard]] Result<void> LoadCurrent();
  void NoteCurrent(const mission::Report& report);
  // With robots that are met, whether they still do what is taken here to be under way.
  void Agree(Time now);
  void Keep(const mission::Mission& mission, mission::Record stored);
  // Drops with one commit the missions that no robot has answered and that `why` has a reason for.
  // `expires`: by the time that passes here, however the server's clock is set meanwhile; nothing:
  // it has not been looked at yet.
  struct Waiting : mission::Record {
    explicit Waiting(mission::Record record) : mission::Record(std::move(record)) {}
    std::optional<Time> expires{};
  };
  using Why = std::function<std::optional<std::string>(const Waiting&)>;
  void Drop(mission::State state, const Why& why, std::int64_t now_unix_ms);
  void Expire(Time now, std::int64_t now_unix_ms);
  void Say(mission::Report report);
  void Warn(const Error& error) { notes_.push_back({error.message, true}); }
  // Whether something was stored is known.
  template <typename Stored>
  void NoteStored(const Stored& stored) {
    untaken_ = stored ? "" : stored.error().message;
  }

  AgentId server_;
  std::unique_ptr<store::MissionStore> store_;
  // Of each robot the oldest first: it is told of that one.
  std::map<AgentId, std::deque<Waiting>> unanswered_;
  struct Current {
    mission::Record record{};
    Time tell_at{};  // if it goes another way than at first
  };
  NewestMap<AgentId, Current> current_{kMostAgents};
  // What each robot has said last of its missions that have not ended, by their ids. It may have
  // lost them since, with its disk.
  NewestMap<AgentId, std::map<std::string, mission::Report>> unended_{kMostAgents};
  struct Heard {
    std::uint64_t instance = 0;
    Time tell_at{};
    std::chrono::milliseconds pause{};  // then, before it is told again
    Time agree_at{};
    std::chrono::milliseconds agree_pause{};  // likewise
  };
  NewestMap<AgentId, Heard> heard_{kMostAgents};
  Time expire_at_{};
  // Commands and answers that are stored, since they are said again and again.
  using NowKey = std::pair<AgentId, std::uint64_t>;
  NewestMap<NowKey, bool> commands_{kMostAgents};
  NewestMap<std::pair<AgentId, NowKey>, bool> answers_{kMostAgents};
  // Missions that cannot be stored are said again, too.
  ToldLately told_{std::chrono::milliseconds(60'000)};
  std::vector<exchange::Message> outgoing_;
  std::vector<Note> notes_;
  std::string untaken_;
};

}  // namespace trailcast::server
