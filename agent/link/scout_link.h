#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "agent/link/outbox.h"
#include "services/base/mailbox.h"
#include "services/program/presence.h"

namespace trailcast::agent {

// What the control loop tells of itself, a frame at a time.
struct TeachingNow {
  std::optional<double> drive_progress;
  double along_m = 0.0;  // taught by this drive, with the segment under way
  double speed_mps = 0.0;
  int features = 0;
  std::string stands;  // why the robot had to be stopped, one line for people; empty: it was not
};

struct ScoutLinkOptions {
  AgentId agent;
  std::string store_file;  // for messages
  std::chrono::milliseconds delivery_timeout{30'000};
  // After a signal the process shall end soon.
  std::chrono::milliseconds delivery_timeout_when_stopped{3'000};
  std::function<program::Vitals()> vitals = [] { return program::Vitals{}; };  // the link's thread
  std::function<bool()> stop = [] { return false; };                           // any thread
  // Of an agent on duty: its process in the fleet, which has claimed the name (0: this link is all
  // there is), and what its statuses say besides, asked in the link's thread.
  std::uint64_t instance = 0;
  std::function<void(exchange::AgentStatus&)> besides = [](exchange::AgentStatus&) {};
};

// The scout's other half: a thread that owns store and exchange, writes each segment down, then
// sends it, and waits for receipts at the end. The control loop gives it segments and never waits.
class ScoutLink {
 public:
  // `exchange` may be null: then segments are only stored.
  ScoutLink(ScoutLinkOptions options, std::unique_ptr<store::RouteStore> store,
            std::unique_ptr<exchange::RouteExchange> exchange);
  ~ScoutLink();  // Close() if that was not called
  ScoutLink(const ScoutLink&) = delete;
  ScoutLink& operator=(const ScoutLink&) = delete;

  // The newest teaching of this route by this agent, if it was cut off and not given up since.
  [[nodiscard]] Result<std::optional<route::RouteInfo>> FindCutOff(const std::string& route);
  // Where it ends.
  [[nodiscard]] Result<route::Segment> LastSegment(const route::RouteInfo& cut_off);
  // What becomes of it; before Open. Without either it is kept as it is, and sent.
  [[nodiscard]] Result<void> Discard(const route::RouteInfo& cut_off);
  void Spare(const route::RouteInfo& cut_off) { outbox_.Spare(cut_off.key); }  // for StartFrom

  // Claims the name and takes up what earlier runs left. Before Start.
  [[nodiscard]] Result<void> Open();
  // Starts the thread. `route` is what is to be taught (none: only the backlog is delivered); it
  // begins with its first segment. Its route is the one of this name, or whose id begins so, in
  // the store, its teaching a new one. kConflict where several are.
  [[nodiscard]] Result<void> Start(std::optional<route::RouteInfo> route);
  // The same to go on with a teaching that was cut off.
  [[nodiscard]] Result<void> StartFrom(const route::RouteInfo& cut_off);
  // Of the first segment that is to come. After Start.
  [[nodiscard]] SegmentIndex first_index() const {
    return SegmentIndex(planned_ ? planned_->segment_count : 0);
  }

  // From the control loop. False: the disk does not keep up, or failed; see Finish.
  [[nodiscard]] bool Offer(route::Segment segment);
  // The same: what was offered so far is void, and discarded; what comes next is another teaching
  // of the route, by pictures of this size. Of one that began with Start.
  [[nodiscard]] bool BeginAnew(int width_px, int height_px);
  void Report(const TeachingNow& now);
  // The store failed: teaching is of no use any more.
  [[nodiscard]] bool failed() const { return failed_.load(); }

  struct Outcome {
    std::optional<route::RouteInfo> route;  // as it is on disk; nothing if no segment was taught
    std::size_t unreceipted = 0;
    bool delivered = false;  // nothing is left to be sent
    // What a server says that the route is to operators; nothing if none has.
    std::optional<exchange::StandingThere> standing;
    std::optional<std::string> refusal;  // why a server takes nothing, if one said so
    // Of earlier runs, and all on a server now; with what that says of each.
    std::vector<std::pair<route::RouteInfo, exchange::StandingThere>> earlier;
  };
  enum class Ending : std::uint8_t {
    kComplete,
    kCutOff,   // something on the way kept the route from its end
    kDiscard,  // it is not wanted
  };
  // No segment will follow: completes the route, waits for receipts, ends the thread. The error is
  // the store's, if it failed.
  [[nodiscard]] Result<Outcome> Finish(Ending ending = Ending::kComplete);
  // The last status peers see. After Finish.
  void Close(exchange::AgentMode mode, const std::string& detail);

 private:
  [[nodiscard]] Result<std::vector<route::RouteInfo>> FindMeant(const std::string& name_or_id);
  [[nodiscard]] Result<void> Assign(route::RouteInfo& route);
  [[nodiscard]] Result<void> Number(route::RouteInfo& route);
  [[nodiscard]] Result<void> GoOn(const route::RouteInfo& cut_off);
  void Run();
  [[nodiscard]] Result<void> Work();
  [[nodiscard]] Result<void> Step();
  // One of the two.
  struct Offered {
    std::optional<route::Segment> segment;
    struct Anew {
      int width_px = 0;
      int height_px = 0;
    };
    std::optional<Anew> anew;
  };
  [[nodiscard]] bool Put(Offered offered);
  [[nodiscard]] Result<void> StoreOffered();
  [[nodiscard]] Result<void> Begin(const Offered::Anew& anew);
  [[nodiscard]] Result<void> Trade();
  [[nodiscard]] Result<void> End();
  [[nodiscard]] Result<void> DiscardTaught();
  [[nodiscard]] Result<void> Deliver();
  [[nodiscard]] Result<void> TellHeld();
  [[nodiscard]] bool HasAsked() const;
  void HearServer();
  void HearRefusal();
  void HearRemark();
  void ShowStatus(exchange::AgentMode mode, const std::string& detail);

  ScoutLinkOptions options_;
  std::unique_ptr<store::RouteStore> store_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  Outbox outbox_;
  std::optional<program::Presence> presence_;
  std::optional<route::RouteInfo> planned_;
  std::optional<route::RouteKey> key_;  // of the route taught, once it has a segment
  std::chrono::steady_clock::time_point opened_{};
  std::optional<AgentId> told_server_;
  std::optional<std::chrono::steady_clock::time_point> server_heard_at_;
  std::optional<std::string> told_refusal_;
  std::string told_remark_;
  std::vector<route::RouteKey> held_revisions_;
  bool told_no_server_ = false;

  Mailbox<std::unique_ptr<Offered>> offered_{256};
  Mailbox<TeachingNow> reports_{64};
  TeachingNow latest_;
  Bell bell_;
  std::atomic<bool> ending_{false};
  std::atomic<Ending> how_{Ending::kComplete};
  std::atomic<bool> failed_{false};
  std::optional<Error> error_;  // written by the thread, read after it ended
  std::thread thread_;
};

}  // namespace trailcast::agent
