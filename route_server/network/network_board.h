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

#include "route_server/joints/meeting.h"
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

// How routes are joined and what places are called, as operators say, and which ways that makes. A
// joint is one of two revisions, whose metres it names: it is used while both are those that robots
// follow; a name is that of a place on one revision likewise. What is
// closed or limited is so on whichever revision is followed. Joints that were found are proposed
// while both revisions are followed, until an operator has confirmed or refused them. No clock of
// its own.
class NetworkBoard {
 public:
  // Strangers can make up names: beyond it the one is forgotten that was not heard of for longest.
  static constexpr std::size_t kMostAgents = 4096;
  // Within so many metres a joint, or a place on a route, is the same.
  static constexpr double kSame_m = network::kSame_m;
  // Two found so near each other are one, and nobody needs one so near to a joint.
  static constexpr double kSameMeeting_m = 2.0;
  // Refused ones counted, and those that became joints.
  static constexpr std::size_t kMostOfAPair = 8;

  // `routes` outlives this.
  [[nodiscard]] static Result<std::unique_ptr<NetworkBoard>> Open(
      AgentId server, std::unique_ptr<store::NetworkStore> store, store::RouteStore& routes);

  // On the disk when it returns. The same request asked again is answered again, and carried out
  // once.
  [[nodiscard]] exchange::NetworkReply Change(const exchange::NetworkEdit& edit,
                                              std::int64_t now_unix_ms);
  [[nodiscard]] exchange::NetworkReply Answer(const exchange::NetworkRequest& request);
  // Where robots say that they stand.
  void Hear(const exchange::AgentStatus& status);
  // What robots say of how they follow.
  [[nodiscard]] FollowedLately& followed() { return followed_; }
  // From now on ways lead by what was heard of that, and it is on the disk.
  [[nodiscard]] Result<void> KeepFollowed(std::int64_t now_unix_ms);
  // What is known of a revision may have changed.
  void Note(const route::RouteInfo& info);

  struct Proposed {
    std::string line{};  // as it is listed
    bool taken = false;
  };
  // What this adds to what is proposed: nothing where a joint is near, or one was proposed before,
  // whatever became of it; where a revision is not followed; or where there is no more room.
  // `take_from`: of this confidence on it is made a joint at once.
  [[nodiscard]] Result<std::optional<Proposed>> Propose(const Meeting& meeting, double take_from,
                                                        std::int64_t now_unix_ms);
  // Whether a revision's meetings were looked for.
  [[nodiscard]] bool WasSearched(const route::RouteKey& key) const;
  // Durable once it is saved, many at a time; what is lost is looked for again.
  void MarkSearched(const route::RouteKey& key);
  [[nodiscard]] Result<void> SaveSearched();
  // Proposals that wait for an operator's word, of revisions followed or not.
  [[nodiscard]] std::size_t open_proposals() const;
  // What was changed since the last call, and by whom: edits, as they are listed.
  [[nodiscard]] std::vector<network::Change> TakeMade() { return std::exchange(made_, {}); }
  // For robots under way. Places and stretches are of revisions that are followed ("ID/TEACHING").
  //
  // Counts up with whatever may have changed a way.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  struct Stand {
    network::Place place{};
    double speed_mps = 0.0;
    bool now = false;  // its last word had it
  };
  // Where a robot last said that it is; null: it has not.
  [[nodiscard]] const Stand* StandOf(const AgentId& agent) const { return places_.Find(agent); }
  // Of orders that one to follow a part of a route.
  [[nodiscard]] Result<network::Stretch> StretchOf(std::span<const mission::Task> tasks,
                                                   std::size_t number);
  [[nodiscard]] mission::Task TaskOf(const network::Stretch& stretch) const;
  // As the network has them.
  [[nodiscard]] Result<std::optional<network::Condition>> FirstClosed(
      const network::Stretch& stretch);
  [[nodiscard]] Result<std::optional<network::Condition>> ClosedAround(const network::Place& place);
  [[nodiscard]] std::string Called(const network::Condition& closed) const;  // "hall 3..7"
  [[nodiscard]] Result<std::vector<network::Stretch>> WayOn(const network::Place& from,
                                                            const std::string& goal);
  // Where it is on other routes: of joints that were found, as far as the routes run together.
  [[nodiscard]] Result<std::vector<network::Place>> AlsoAt(const network::Place& place);

  // Narrow places, by their positions here until one is made or goes (changes()), and who has them:
  // on the disk when it returns.
  using LaneSet = std::set<std::size_t>;
  [[nodiscard]] bool HasLanes() const { return !lanes_.empty(); }
  // Of revisions that are followed.
  [[nodiscard]] Result<std::vector<network::Lane>> Lanes();
  [[nodiscard]] const std::set<AgentId>& HoldersOf(std::size_t lane) const {
    return lanes_[lane].holders;
  }
  [[nodiscard]] LaneSet HeldBy(const AgentId& agent) const;
  [[nodiscard]] Result<void> Hold(const LaneSet& lanes, const AgentId& agent);
  [[nodiscard]] Result<void> Release(const LaneSet& lanes, const AgentId& agent);
  [[nodiscard]] std::string Called(std::size_t lane) const;  // by its first part
  // Whose word on where they are an operator has contradicted, since this was asked last.
  [[nodiscard]] std::set<AgentId> TakeVacated() { return std::exchange(vacated_, {}); }
  // As a mission has a way: it waits before lanes that are not open to it (network::LegsOf).
  [[nodiscard]] Result<std::vector<mission::Task>> TasksOf(std::span<const network::Stretch> way,
                                                           const LaneSet& open);
  [[nodiscard]] std::vector<mission::Task> TasksOf(std::span<const network::Leg> legs) const;

 private:
  // Of a route the revision that robots follow, if there is one.
  struct Known {
    std::optional<route::RouteInfo> followed;
    std::string called;  // its name, or its id where that may mean others, too
  };
  NetworkBoard(AgentId server, std::unique_ptr<store::NetworkStore> store,
               store::RouteStore& routes)
      : server_(std::move(server)),
        store_(std::move(store)),
        routes_(routes),
        followed_([this](const route::RouteKey& key) { return LengthOf(key); }) {}

  [[nodiscard]] Result<std::vector<std::string>> Carry(const network::Edit& edit,
                                                       const std::string& by,
                                                       std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Join(network::Joint joint, const std::string& by,
                                                      std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Part(const network::Joint& joint);
  [[nodiscard]] Result<std::vector<std::string>> Set(network::Edit edit, const std::string& by,
                                                     std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Name(network::NamedPlace named,
                                                      const std::string& by,
                                                      std::int64_t now_unix_ms);
  [[nodiscard]] Result<std::vector<std::string>> Forget(const std::string& name);
  [[nodiscard]] Result<std::vector<std::string>> Narrow(network::Lane lane, const std::string& by,
                                                        std::int64_t now_unix_ms);
  // Whoever drives backwards would meet those that come the other way: it is narrow there, too.
  [[nodiscard]] Result<std::vector<std::string>> LetBack(const network::Edit& edit,
                                                         const std::string& by,
                                                         std::int64_t now_unix_ms);
  // Of kWide and kVacate.
  [[nodiscard]] Result<std::vector<std::string>> Leave(const network::Edit& edit);
  [[nodiscard]] std::vector<std::int64_t> NumbersOf(const LaneSet& lanes) const;
  [[nodiscard]] network::Lane CalledLane(const store::KeptLane& kept) const;
  // Confirms, or refuses, what is proposed.
  [[nodiscard]] Result<std::vector<std::string>> Settle(const network::Edit& edit,
                                                        const std::string& by,
                                                        std::int64_t now_unix_ms);
  // Those that wait for a word on them and are listed: of revisions that are followed, where no
  // joint is. Positions.
  [[nodiscard]] std::vector<std::size_t> Open() const;
  [[nodiscard]] Result<std::vector<std::size_t>> OpenAt(const network::Joint& joint) const;
  void DropProposals(const route::RouteKey& key);
  [[nodiscard]] Result<std::vector<std::string>> All();
  // To words that ask; without any, all.
  [[nodiscard]] Result<std::vector<std::string>> Answered(const std::string& words);
  [[nodiscard]] Result<std::vector<std::string>> WayTo(const network::Question& question);
  // By joints that are used and that are proposed: of those that were found as far as the routes
  // run together, of others as far as one is the same joint.
  [[nodiscard]] Result<std::vector<std::string>> WhatPasses(const network::Goal& goal);
  // Where the other route of a joint passes at `place`, if it does and is not found yet.
  void AddPassing(const network::Place& place, const network::Joint& joint, double shared_m,
                  std::optional<double> confidence, std::vector<network::Passing>& found) const;
  // Metres that its routes run together, as they were found to; 0: nobody knows.
  [[nodiscard]] double SharedBy(const network::Joint& joint) const;

  // The complete revision that ROUTE[@REVISION] means, of some length.
  [[nodiscard]] Result<route::RouteInfo> Meant(const std::string& words) const;
  [[nodiscard]] Result<network::Place> Resolve(const network::Place& named) const;
  [[nodiscard]] Result<network::Place> Resolve(const network::Goal& goal) const;
  // Looks up what is not known of the routes that are joined or have named places, and of these.
  [[nodiscard]] Result<void> Know(const std::set<RouteId>& asked);
  [[nodiscard]] Result<Known> LookUp(const RouteId& route) const;
  [[nodiscard]] std::optional<double> LengthOf(const route::RouteKey& key) const;
  [[nodiscard]] std::vector<network::Condition> CostsOfPoor() const;
  [[nodiscard]] std::vector<std::string> PoorLines() const;
  void NoteChange();
  [[nodiscard]] bool IsUsed(const network::Place& place) const;
  // As people are shown it: "hall@12", "hall@1@12" of a revision that is not followed.
  [[nodiscard]] Result<network::Place> Called(const network::Place& place) const;
  [[nodiscard]] Result<network::Joint> Called(network::Joint joint) const;
  [[nodiscard]] Result<network::NamedPlace> Called(network::NamedPlace named) const;
  [[nodiscard]] std::string Called(const RouteId& route) const;

  AgentId server_;
  std::unique_ptr<store::NetworkStore> store_;
  store::RouteStore& routes_;
  std::vector<network::Joint> joints_;           // of revisions: "ID/TEACHING"
  std::vector<network::Condition> conditions_;   // of routes: "ID"
  std::map<std::string, network::Place> named_;  // of revisions
  std::vector<store::ProposedJoint> proposed_;   // of revisions
  std::vector<store::KeptLane> lanes_;           // of routes
  std::set<AgentId> vacated_;
  FollowedLately followed_;
  std::vector<FollowedLately::Poor> poor_;  // by which ways lead
  std::set<std::string> searched_;          // revisions
  std::vector<std::string> unsaved_;        // of these
  std::map<RouteId, Known> known_;
  std::set<std::string> names_;              // of those
  std::optional<network::Network> network_;  // of those, by revision
  std::uint64_t changes_ = 1;
  std::vector<network::Change> made_;  // that nobody was told of yet
  NewestMap<AgentId, Stand> places_{kMostAgents};
  // What the last edits were answered with.
  NewestMap<std::pair<AgentId, std::uint64_t>, std::optional<exchange::NetworkReply>> answered_{64};
};

}  // namespace trailcast::server
