#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "agent/camera_view/snapshots.h"
#include "agent/duty/on_duty.h"
#include "agent/duty/src/relocalisation.h"
#include "agent/duty/src/turning.h"
#include "agent/duty/src/view_question.h"
#include "agent/follow/next_path.h"
#include "agent/link/followed_note.h"
#include "agent/link/lasting_exchange.h"
#include "agent/link/mission_handler.h"
#include "agent/link/now_handler.h"
#include "agent/link/photo_sender.h"
#include "agent/photos/photo_taker.h"
#include "agent/teach/teleoperation.h"
#include "services/base/mailbox.h"
#include "services/program/presence.h"

namespace trailcast::agent {

// A robot that waits for missions and does them. `on_duty.cc` hears and reports; `duty_work.cc`
// does the work.
//
// While a route is followed or taught, that link's thread hears messages, and the thread that runs
// this waits for it, or takes messages from teleoperation. Neither needs a lock.
class Duty {
 public:
  Duty(RobotDevice& device, const OnDutyOptions& options,
       std::unique_ptr<exchange::RouteExchange> exchange);

  [[nodiscard]] Result<void> Run();

 private:
  using State = mission::State;
  using Time = std::chrono::steady_clock::time_point;

  void Hear(const exchange::Message& message);
  void Say(exchange::RouteExchange& to);
  void SawStatus(const exchange::AgentStatus& status);
  void ShowFree();
  void AddDuty(exchange::AgentStatus& status) const;
  void NoteAilment(Time now);
  void TellNews();
  void TellState(State state, const std::string& why,
                 mission::WaitsFor waits_for = mission::WaitsFor::kNothing);
  [[nodiscard]] bool Held() const { return now_handler_.hold().kind != Hold::Kind::kNone; }

  void Work();
  void WaitOn(const mission::Task& task);
  void Turn(const mission::Task& task, std::unique_ptr<Turning> turning);
  [[nodiscard]] bool WaitsForWay() const;
  void WaitForWay();
  void Reroute();
  void GoAlong();
  void Follow(const mission::Task& task, std::unique_ptr<NextPath> begun);
  [[nodiscard]] std::optional<mission::Task> TaskAfter() const;
  [[nodiscard]] FollowerOptions::Next PrepareNext(const std::optional<OwnLens>& lens);
  void Relocalise();
  [[nodiscard]] FollowerOptions FollowerFor(const mission::Task& task);
  // Returns nothing if there is no outcome to judge, because it failed before, or goes another way.
  [[nodiscard]] std::optional<Result<ReplayOutcome>> RunFollower(
      const FollowerOptions& follower, std::unique_ptr<NextPath> begun = nullptr);
  [[nodiscard]] bool BeginsToRelocalise(const Result<ReplayOutcome>& outcome);
  [[nodiscard]] std::vector<std::string> RoutesInView();
  [[nodiscard]] std::vector<std::string> AskWhatIsInView(const route::View& view);
  void RefreshVisited();
  [[nodiscard]] std::string PhotosText() const;
  void Teach(const mission::Task& task);
  [[nodiscard]] ScoutOptions ScoutFor(const mission::Task& task);
  void FindUndelivered();
  void Deliver();
  void Judge(const Result<ReplayOutcome>& outcome);
  void Done(const std::string& what = {});
  void End(State state, const std::string& why,
           mission::WaitsFor waits_for = mission::WaitsFor::kNothing);

  RobotDevice& device_;
  const OnDutyOptions& options_;
  Snapshots snapshots_;
  LastingExchange exchange_;
  NowHandler now_handler_;
  FollowedNote followed_note_;
  MissionHandler mission_handler_;
  std::optional<PhotoTaker> photo_taker_;
  std::optional<PhotoSender> photo_sender_;
  // The photos of its mission that this process has taken, and the places among them, in words.
  int photos_taken_ = 0;
  std::set<std::string> photographed_;
  bool photos_before_ = false;  // an earlier process has begun its mission
  std::unique_ptr<exchange::RouteExchange> own_visit_;
  program::Presence presence_;
  std::uint64_t instance_ = 0;  // of this process, once the name is claimed
  bool claimed_ = false;
  bool following_ = false;
  bool delivering_ = false;
  bool was_under_way_ = false;  // while following the present route
  bool undelivered_ = false;    // an earlier teaching was not delivered
  Time deliver_at_{};
  Teleoperation* teleoperation_ = nullptr;  // while it teaches
  std::optional<State> told_;               // of the mission under way
  mission::WaitsFor told_waits_for_{};
  std::string told_why_;
  mission::Task driven_;  // the task being followed
  // Where that task ends, and that it ends at once because the robot changes its path.
  std::atomic<double> end_m_ = 0.0;
  std::atomic<bool> turned_off_ = false;
  // The task after it, which the link's thread passes to the control loop, and the one for which
  // that then prepares.
  Mailbox<std::optional<mission::Task>> tasks_after_{4};
  std::optional<mission::Task> task_after_;
  std::string made_ready_;
  std::unique_ptr<NextPath> next_;  // the path on which the robot drives on
  struct Visited {
    route::RouteInfo route;
    refresh::Visit visit;
  };
  std::vector<Visited> visited_;  // visits by which routes are refreshed once the robot stands
  std::string missed_;            // why it stands until it is sent another path; empty if it need
                                  // not
  Relocalisation relocalisation_;
  std::optional<ViewQuestion> question_;  // while it asks servers about its view
  std::optional<Time> told_until_;        // until when a robot that has found itself waits there
                                          // for a path
  std::optional<Time> wait_until_;
  std::unique_ptr<Turning> turning_;  // while it turns on the spot
  // How far it has turned to the left for an order that is not done. It turns back before anything
  // else.
  double turned_rad_ = 0.0;
  std::optional<OwnLens> lens_;  // from the last following
  std::string on_route_;         // where the last following ended
  std::optional<exchange::PlaceOnRoute> place_;
  Time stands_until_{};
  std::string last_ = "free";
  std::optional<Time> ails_since_;
  std::string ailment_;  // of the robot while nothing drives it
};

}  // namespace trailcast::agent
