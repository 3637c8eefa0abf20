#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "route_server/junctions/meeting.h"
#include "route_server/network/followed_lately.h"
#include "services/base/newest_map.h"
#include "services/exchange/messages.h"
#include "services/mission/orders.h"
#include "services/network/changes.h"
#include "services/network/passing.h"
#include "services/network/words.h"
#include "services/records/network_store.h"
#include "services/store/route_store.h"

namespace trailcast::server {

// Keeps the network as operators define it: junctions, conditions and names of places; and plans
// paths over it. A junction is between two revisions, at their metres, and is used while both are
// those that robots follow. A named place is likewise on one revision. Closures and limits apply to
// whichever revision is followed. Junctions that were found are proposed while both revisions are
// followed, until an operator has confirmed or refused them. It has no clock of its own.
class NetworkRegistry {
 public:
  // Strangers can make up names, so beyond this number the one with the oldest news is forgotten.
  static constexpr std::size_t kMostAgents = 4096;
  // Junctions, or places on a route, within so many metres are the same.
  static constexpr double kSame_m = network::kSame_m;
  // Two meetings found within this distance are one, and one this near to a junction is not needed.
  static constexpr double kSameMeeting_m = 2.0;
  // Including refused ones and those that became junctions.
  static constexpr std::size_t kMostOfAPair = 8;

  // `routes` must outlive this.
  [[nodiscard]] static Result<std::unique_ptr<NetworkRegistry>> Open(
      AgentId server, std::unique_ptr<store::NetworkStore> store, store::RouteStore& routes);

  // Makes an edit, which is on the disk when this returns. A repeated request is answered again,
  // but carried out once.
  [[nodiscard]] exchange::NetworkReply Change(const exchange::NetworkEdit& edit,
                                              std::int64_t now_unix_ms);
  [[nodiscard]] exchange::NetworkReply Answer(const exchange::NetworkRequest& request);
  // Hears where robots stand, by their own reports.
  void Hear(const exchange::AgentStatus& status);
  // Holds robots' reports on how they follow.
  [[nodiscard]] FollowedLately& followed() { return followed_; }
  // Plans paths by these reports from now on, and writes them to the disk.
  [[nodiscard]] Result<void> KeepFollowed(std::int64_t now_unix_ms);
  // Notes that the knowledge of a revision may have changed.
  void Note(const route::RouteInfo& info);

  struct Proposed {
    std::string line{};  // as it is listed
    bool taken = false;
  };
  // Returns the proposal that a meeting adds. There is none if a junction is near, if one was
  // proposed there before, whatever became of it, if a revision is not followed, or if there is no
  // room. From the confidence `take_from` on, it becomes a junction at once.
  [[nodiscard]] Result<std::optional<Proposed>> Propose(const Meeting& meeting, double take_from,
                                                        std::int64_t now_unix_ms);
  // Says whether a revision was searched for meetings.
  [[nodiscard]] bool WasSearched(const route::RouteKey& key) const;
  // Marks are saved many at a time. Lost marks cause another search.
  void MarkSearched(const route::RouteKey& key);
  [[nodiscard]] Result<void> SaveSearched();
  // Returns how many proposals await an operator's decision, of revisions followed or not.
  [[nodiscard]] std::size_t open_proposals() const;
  // Returns the edits since the last call, with their authors, as they are listed.
  [[nodiscard]] std::vector<network::Change> TakeMade() { return std::exchange(made_, {}); }
  // The following is for robots under way. Their places and sections are of revisions that are
  // followed ("ID/TEACHING").
  //
  // Returns a number that rises with whatever may have changed a path.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  struct Stand {
    network::Place place{};
    double speed_mps = 0.0;
    bool now = false;  // its last report had it
  };
  // Returns where a robot last reported itself, or null if it has not.
  [[nodiscard]] const Stand* StandOf(const AgentId& agent) const { return places_.Find(agent); }
  // Returns the section of one of the orders, which must be to follow a part of a route.
  [[nodiscard]] Result<network::Section> SectionOf(std::span<const mission::Task> tasks,
                                                   std::size_t number);
  [[nodiscard]] mission::Task TaskOf(const network::Section& section) const;
  // Returns conditions as the network has them.
  [[nodiscard]] Result<std::optional<network::Condition>> FirstClosed(
      const network::Section& section);
  [[nodiscard]] Result<std::optional<network::Condition>> ClosedAround(const network::Place& place);
  [[nodiscard]] std::string Called(const network::Condition& closed) const;  // "hall 3..7"
  [[nodiscard]] Result<std::vector<network::Section>> WayOn(const network::Place& from,
                                                            const std::string& goal);
  // Returns the same place on other routes, by junctions that were found, as far as the routes run
  // together.
  [[nodiscard]] Result<std::vector<network::Place>> AlsoAt(const network::Place& place);

  // Mutex zones, by their indices here, which are valid until one is made or removed (changes()),
  // and their holders. Changes are on the disk when the call returns.
  using LaneSet = std::set<std::size_t>;
  [[nodiscard]] bool HasLanes() const { return !lanes_.empty(); }
  // Returns zones of revisions that are followed.
  [[nodiscard]] Result<std::vector<network::Lane>> Lanes();
  [[nodiscard]] const std::set<AgentId>& HoldersOf(std::size_t lane) const {
    return lanes_[lane].holders;
  }
  [[nodiscard]] LaneSet HeldBy(const AgentId& agent) const;
  [[nodiscard]] Result<void> Hold(const LaneSet& lanes, const AgentId& agent);
  [[nodiscard]] Result<void> Release(const LaneSet& lanes, const AgentId& agent);
  [[nodiscard]] std::string Called(std::size_t lane) const;  // named after its first part
  // Returns the robots whose reported places an operator has contradicted since the last call.
  [[nodiscard]] std::set<AgentId> TakeVacated() { return std::exchange(vacated_, {}); }
  // Docks, of revisions that are followed.
  struct Dock {
    std::string name{};
    std::vector<network::Place> places{};  // on each route that passes there, as far as is known
    std::set<AgentId> holders{};
  };
  [[nodiscard]] Result<std::vector<Dock>> Docks();
  // Returns the robots of which an operator has said since the last call that they are not at
  // docks.
  [[nodiscard]] std::set<AgentId> TakeSentOff() { return std::exchange(sent_off_, {}); }
  // This is on the disk when it returns.
  [[nodiscard]] Result<void> HoldDock(const std::string& name, const std::set<AgentId>& holders);
  [[nodiscard]] const std::optional<network::ChargeLimits>& charge_limits() const {
    return charge_limits_;
  }
  // Lists from now on that these robots charge, or why they do not yet.
  void Show(std::vector<network::Charging> charging) { charging_ = std::move(charging); }
  // Returns the place that a destination means; fails for "home".
  [[nodiscard]] Result<network::Place> PlaceOf(const std::string& goal) const;

  // Returns a path as a mission has it: it waits before zones that are not open to it
  // (network::LegsOf).
  [[nodiscard]] Result<std::vector<mission::Task>> TasksOf(std::span<const network::Section> way,
                                                           const LaneSet& open);
  [[nodiscard]] std::vector<mission::Task> TasksOf(std::span<const network::Leg> legs) const;

 private:
  // A route's revision that robots follow, if there is one.
  struct Known {
    std::optional<route::RouteInfo> followed;
    std::string called;  // its name, or its id if the name may mean others, too
  };
  NetworkRegistry(AgentId server, std::unique_ptr<store::NetworkStore> store,
                  store::RouteStore& routes)
      : server_(std::move(server)),
        store_(std::move(store)),
        routes_(routes),
        followed_([this](const route::RouteKey& key) { return LengthOf(key); }) {}

  [[nodiscard]] Result<std::vector<std::string>> Carry(const network::Edit& edit,
                                                       const std::string& by,
                                                       std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Join(network::Junction junction,
                                                      const std::string& by,
                                                      std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Part(const network::Junction& junction);
  [[nodiscard]] Result<std::vector<std::string>> Set(network::Edit edit, const std::string& by,
                                                     std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Name(network::NamedPlace named,
                                                      const std::string& by,
                                                      std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Forget(const std::string& name);
  [[nodiscard]] Result<std::vector<std::string>> SetCharge(
      const std::optional<network::ChargeLimits>& limits);
  // Takes the docks there from the robots that hold them, and returns a line on each.
  [[nodiscard]] Result<std::vector<std::string>> VacateDocks(const network::Condition& where);
  [[nodiscard]] Result<std::vector<std::string>> Narrow(network::Lane lane, const std::string& by,
                                                        std::int64_t now_unix_ms);
  // A robot that reverses would meet those that come the other way, so the section becomes a mutex
  // zone, too.
  [[nodiscard]] Result<std::vector<std::string>> LetBack(const network::Edit& edit,
                                                         const std::string& by,
                                                         std::int64_t now_unix_ms);
  // Carries out kWide and kVacate.
  [[nodiscard]] Result<std::vector<std::string>> Leave(const network::Edit& edit);
  [[nodiscard]] std::vector<std::int64_t> NumbersOf(const LaneSet& lanes) const;
  [[nodiscard]] network::Lane CalledLane(const store::KeptLane& kept) const;
  // Confirms or refuses proposals.
  [[nodiscard]] Result<std::vector<std::string>> Settle(const network::Edit& edit,
                                                        const std::string& by,
                                                        std::int64_t now_unix_ms);
  // Returns the indices of the listed proposals that await a decision: both revisions are followed,
  // and there is no junction.
  [[nodiscard]] std::vector<std::size_t> Open() const;
  [[nodiscard]] Result<std::vector<std::size_t>> OpenAt(const network::Junction& junction) const;
  void DropProposals(const route::RouteKey& key);
  [[nodiscard]] Result<std::vector<std::string>> All();
  [[nodiscard]] std::vector<std::string> ChargingLines() const;
  // Answers a question; an empty one means everything.
  [[nodiscard]] Result<std::vector<std::string>> Answered(const std::string& words);
  [[nodiscard]] Result<std::vector<std::string>> WayTo(const network::Question& question);
  // Goes by junctions that are used or proposed. For those that were found, it reaches as far as
  // the routes run together; for others, as far as the junction's own place.
  [[nodiscard]] Result<std::vector<std::string>> WhatPasses(const network::Goal& goal);
  // Adds where the other route of a junction passes at `place`, if it does and is not in the list
  // yet.
  void AddPassing(const network::Place& place, const network::Junction& junction, double shared_m,
                  std::optional<double> confidence, std::vector<network::Passing>& found) const;
  // Returns how many metres its routes run together, as far as was found, or 0 if that is not
  // known.
  [[nodiscard]] double SharedBy(const network::Junction& junction) const;

  // Returns the complete revision, with a length, that ROUTE[@REVISION] means.
  [[nodiscard]] Result<route::RouteInfo> Meant(const std::string& words) const;
  [[nodiscard]] Result<network::Place> Resolve(const network::Place& named) const;
  [[nodiscard]] Result<network::Place> Resolve(const network::Goal& goal) const;
  // Returns the places that a goal means: all homes, if it is "home" and no place is called so.
  [[nodiscard]] Result<std::vector<network::Place>> PlacesOf(const network::Goal& goal) const;
  // Returns the shortest of the paths that `find` finds to each of these places, or the error of
  // the first of them.
  template <typename Find>
  [[nodiscard]] Result<network::Way> NearestOf(const std::vector<network::Place>& places,
                                               const Find& find) const;
  // Looks up the routes that are joined or have named places, and the ones asked for, if they are
  // not known yet.
  [[nodiscard]] Result<void> Know(const std::set<RouteId>& asked);
  [[nodiscard]] Result<Known> LookUp(const RouteId& route) const;
  [[nodiscard]] std::optional<double> LengthOf(const route::RouteKey& key) const;
  [[nodiscard]] std::vector<network::Condition> CostsOfPoor() const;
  [[nodiscard]] std::vector<std::string> PoorLines() const;
  void NoteChange();
  [[nodiscard]] bool IsUsed(const network::Place& place) const;
  // Return how people see it: "hall@12", or "hall@1@12" for a revision that is not followed.
  [[nodiscard]] Result<network::Place> Called(const network::Place& place) const;
  [[nodiscard]] Result<network::Junction> Called(network::Junction junction) const;
  [[nodiscard]] Result<network::NamedPlace> Called(network::NamedPlace named) const;
  [[nodiscard]] std::string Called(const RouteId& route) const;

  AgentId server_;
  std::unique_ptr<store::NetworkStore> store_;
  store::RouteStore& routes_;
  std::vector<network::Junction> junctions_;          // of revisions: "ID/TEACHING"
  std::vector<network::Condition> conditions_;        // of routes: "ID"
  std::map<std::string, network::NamedPlace> named_;  // of revisions
  std::map<std::string, std::set<AgentId>> dock_holders_;
  std::optional<network::ChargeLimits> charge_limits_;
  std::vector<network::Charging> charging_;
  std::vector<store::ProposedJunction> proposed_;  // of revisions
  std::vector<store::KeptLane> lanes_;             // of routes
  std::set<AgentId> vacated_;
  std::set<AgentId> sent_off_;
  FollowedLately followed_;
  std::vector<FollowedLately::Poor> poor_;  // sections by which paths are planned
  std::set<std::string> searched_;          // revisions
  std::vector<std::string> unsaved_;        // those of them that are not on the disk
  std::map<RouteId, Known> known_;
  std::set<std::string> names_;              // of those routes
  std::optional<network::Network> network_;  // of those, by revision
  std::uint64_t changes_ = 1;
  std::vector<network::Change> made_;  // not reported yet
  NewestMap<AgentId, Stand> places_{kMostAgents};
  // The answers to the last edits.
  NewestMap<std::pair<AgentId, std::uint64_t>, std::optional<exchange::NetworkReply>> answered_{64};
};

}  // namespace trailcast::server
