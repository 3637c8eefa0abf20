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

// The control loop's report on itself, frame by frame.
struct TeachingNow {
  std::optional<double> drive_progress;
  double along_m = 0.0;  // taught by this drive, including the segment under way
  double speed_mps = 0.0;
  int features = 0;
  std::string stands;  // why the robot had to be stopped, in one line for people; empty if it was
                       // not
};

struct ScoutLinkOptions {
  AgentId agent;
  std::string store_file;  // for messages
  std::chrono::milliseconds delivery_timeout{30'000};
  // A process that received a signal must end soon.
  std::chrono::milliseconds delivery_timeout_when_stopped{3'000};
  // called by the link's thread
  std::function<program::Vitals()> vitals = [] { return program::Vitals{}; };
  std::function<bool()> stop = [] { return false; };  // called by any
                                                      // thread
  // These belong to an agent that waits for missions: its process, which has claimed the name in
  // the fleet (with 0, the link has its own), and additions to its statuses, which the link's
  // thread asks for.
  std::uint64_t instance = 0;
  std::function<void(exchange::AgentStatus&)> besides = [](exchange::AgentStatus&) {};
};

// The scout's other half: a thread that owns the store and the exchange, writes each segment to
// disk, then sends it, and waits for acknowledgements at the end. The control loop hands it
// segments and never waits.
class ScoutLink {
 public:
  // `exchange` may be null; segments are then only stored.
  ScoutLink(ScoutLinkOptions options, std::unique_ptr<store::RouteStore> store,
            std::unique_ptr<exchange::RouteExchange> exchange);
  ~ScoutLink();  // calls Close() if nobody did
  ScoutLink(const ScoutLink&) = delete;
  ScoutLink& operator=(const ScoutLink&) = delete;

  // Returns this agent's newest teaching of the route if it was cut off and not given up since.
  [[nodiscard]] Result<std::optional<route::RouteInfo>> FindCutOff(const std::string& route);
  // Returns the segment with which it ends.
  [[nodiscard]] Result<route::Segment> LastSegment(const route::RouteInfo& cut_off);
  // Decide, before Open, what becomes of it. Without either it is kept as it is, and sent.
  [[nodiscard]] Result<void> Discard(const route::RouteInfo& cut_off);
  void Spare(const route::RouteInfo& cut_off) { outbox_.Spare(cut_off.key); }  // for StartFrom

  // Claims the name and takes up what earlier runs left. Only before Start.
  [[nodiscard]] Result<void> Open();
  // Starts the thread. `route` is to be taught, beginning with its first segment; without it, only
  // the backlog is delivered. Its route is the stored one of this name, or whose id begins so, and
  // its teaching is new. kConflict means that several routes match.
  [[nodiscard]] Result<void> Start(std::optional<route::RouteInfo> route);
  // Starts the thread to continue a teaching that was cut off.
  [[nodiscard]] Result<void> StartFrom(const route::RouteInfo& cut_off);
  // Returns the index of the next segment. Only after Start.
  [[nodiscard]] SegmentIndex first_index() const {
    return SegmentIndex(planned_ ? planned_->segment_count : 0);
  }

  // Takes a segment from the control loop. False means that the disk does not keep up, or failed;
  // see Finish.
  [[nodiscard]] bool Offer(route::Segment segment);
  // Discards what the control loop has offered so far. The following segments are another teaching
  // of the route, with pictures of this size. Only for one that began with Start.
  [[nodiscard]] bool BeginAnew(int width_px, int height_px);
  void Report(const TeachingNow& now);
  // Says whether the store failed, so that teaching is pointless.
  [[nodiscard]] bool failed() const { return failed_.load(); }

  struct Outcome {
    std::optional<route::RouteInfo> route;  // as it is on disk; nothing if no segment was taught
    std::size_t unreceipted = 0;
    bool delivered = false;  // nothing is left to be sent
    // The route's state by a server, if one has told it.
    std::optional<exchange::StandingThere> standing;
    std::optional<std::string> refusal;  // why a server refuses the route, if one does
    // Routes of earlier runs that are now completely on a server, with their states there.
    std::vector<std::pair<route::RouteInfo, exchange::StandingThere>> earlier;
  };
  enum class Ending : std::uint8_t {
    kComplete,
    kCutOff,   // something kept the route from being completed
    kDiscard,  // nobody wants it
  };
  // Completes the route, waits for acknowledgements and ends the thread. The error is the store's,
  // if that failed.
  [[nodiscard]] Result<Outcome> Finish(Ending ending = Ending::kComplete);
  // Publishes the last status that peers see. Only after Finish.
  void Close(exchange::AgentMode mode, const std::string& detail);

 private:
  [[nodiscard]] Result<std::vector<route::RouteInfo>> FindMeant(const std::string& name_or_id);
  [[nodiscard]] Result<void> Assign(route::RouteInfo& route);
  [[nodiscard]] Result<void> Number(route::RouteInfo& route);
  [[nodiscard]] Result<void> GoOn(const route::RouteInfo& cut_off);
  void Run();
  [[nodiscard]] Result<void> Work();
  [[nodiscard]] Result<void> Step();
  // One of the two is set.
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
  std::optional<route::RouteKey> key_;  // of the taught route, once it has a segment
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
  std::optional<Error> error_;  // the thread writes it; others read it after the thread has ended
  std::thread thread_;
};

}  // namespace trailcast::agent
