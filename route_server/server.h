#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "route_server/fleet/fleet_news.h"
#include "route_server/fleet/mission_registry.h"
#include "route_server/fleet/photo_registry.h"
#include "route_server/fleet/route_followers.h"
#include "route_server/fleet/schedule_registry.h"
#include "route_server/junctions/junction_finder.h"
#include "route_server/network/charging.h"
#include "route_server/network/network_registry.h"
#include "route_server/network/replanning.h"
#include "route_server/network/zone_admission.h"
#include "route_server/routes/history.h"
#include "route_server/routes/holders.h"
#include "route_server/routes/mirror_watch.h"
#include "route_server/routes/outdated.h"
#include "route_server/routes/quotas.h"
#include "route_server/routes/refresh_watch.h"
#include "route_server/routes/request_queue.h"
#include "route_server/routes/upkeep.h"
#include "route_server/status/http_page.h"
#include "route_server/status/journal.h"
#include "route_server/status/metrics.h"
#include "services/catalog/view_catalog.h"
#include "services/exchange/mirror.h"
#include "services/exchange/network_state.h"
#include "services/exchange/route_keeper.h"
#include "services/program/presence.h"
#include "services/store/route_store.h"

namespace trailcast::server {

// Keeps the routes of a swarm. It stores scouts' segments, acknowledges them once they are on disk,
// answers questions to the catalog, and sends segments to those that lack them. It runs on the
// caller's thread.
class Server {
 public:
  // Loads the store. Errors name it.
  [[nodiscard]] static Result<std::unique_ptr<Server>> Open(
      const AgentId& name, std::unique_ptr<store::RouteStore> store,
      std::unique_ptr<exchange::RouteExchange> exchange);

  // Deletes, from now on, what the policy does not keep, by `ages`.
  void Retain(const catalog::RetentionPolicy& policy, std::unique_ptr<store::AgeStore> ages) {
    outdated_.emplace(*store_, policy, std::move(ages), std::chrono::steady_clock::now());
  }
  // Limits, from now on, what each member may use.
  void Limit(const QuotaOptions& options);
  // Keeps missions from now on. Without it, this server does not handle them.
  [[nodiscard]] Result<void> KeepMissions(std::unique_ptr<store::MissionStore> store);
  // Keeps the network likewise.
  [[nodiscard]] Result<void> KeepNetwork(std::unique_ptr<store::NetworkStore> store);
  // Keeps the changes of both likewise.
  [[nodiscard]] Result<void> KeepHistory(std::unique_ptr<store::HistoryStore> store);
  // Keeps photos that robots take on missions likewise.
  void KeepPhotos(std::unique_ptr<photos::PhotoFolder> folder);
  // Turns sure proposals into junctions without asking an operator.
  void TakeSureJunctions() { takes_sure_junctions_ = true; }
  // Watches the state of the exchange's network from now on. Without it, the network is assumed to
  // be up.
  void Mind(std::shared_ptr<const exchange::NetworkState> network) {
    network_state_ = std::move(network);
  }
  // Keeps /metrics and /health up to date from now on.
  void ShowOn(std::unique_ptr<HttpPage> page) { page_ = std::move(page); }

  // Claims the name, then serves until `stop` returns true. kConflict means that another running
  // process has the name.
  [[nodiscard]] Result<void> Run(const std::function<bool()>& stop);

 private:
  Server(const AgentId& name, std::unique_ptr<store::RouteStore> store,
         std::unique_ptr<exchange::RouteExchange> exchange);

  void WaitForNetwork(const std::function<bool()>& stop);
  void Receive(exchange::Message message);
  // Says whether a message waits for its turn, and counts as one of its member's requests.
  [[nodiscard]] bool IsRequest(const exchange::Message& message) const;
  void ReceiveRequest(const exchange::Message& request);
  // Passes on operators' commands and robots' answers, because they may not hear each other.
  [[nodiscard]] bool PassOn(const exchange::Message& message);
  [[nodiscard]] Result<void> Enqueue(const exchange::Message& request);
  // Returns the part of a message that its sender's quotas allow, or nothing.
  [[nodiscard]] std::optional<exchange::Message> WithinQuotas(const exchange::Message& message);
  [[nodiscard]] exchange::SegmentBatch WithinQuotas(const exchange::SegmentBatch& batch);
  [[nodiscard]] Result<void> RouteWithinQuotas(const AgentId& scout, const route::RouteKey& key);
  [[nodiscard]] Result<Quotas::Stored> LookUp(const AgentId& scout);
  void Serve();
  [[nodiscard]] std::chrono::milliseconds WaitForMessages() const;
  void ServeRequests();
  void Serve(const exchange::Message& request);
  // Publishes what is due, and returns it.
  [[nodiscard]] std::vector<exchange::Message> Say(std::chrono::steady_clock::time_point now);
  void TellTroubles();
  [[nodiscard]] exchange::CatalogReply AnswerCatalog(const AgentId& name,
                                                     const exchange::CatalogRequest& request);
  void TellAgents();
  void TellMissions();
  // Sends scheduled missions, and answers and changes what is asked of schedules. Returns false for
  // a request that is about something else.
  [[nodiscard]] Result<void> OpenSchedules();
  void TellSchedules();
  void SendToCharge();
  [[nodiscard]] bool ServeSchedules(const exchange::Message& request);
  // Takes photos from robots and gives them to operators, or answers a question about them. Returns
  // false for a message that is about something else.
  [[nodiscard]] bool ServePhotos(const exchange::Message& message);
  void TellKeptPhotos();
  [[nodiscard]] bool AnswerPhotos(const exchange::Message& request);
  [[nodiscard]] std::string ClosedIn(const std::string& orders);
  void Replan(const AgentId& agent);
  void KeepWays();
  void NoteViews(const exchange::RouteAnnouncement& announcement);
  void FillViews(const std::vector<exchange::Message>& outgoing);
  // These feed the history: with announcements, with planned changes before and after they are
  // made, and with changes of the network.
  void NoteAnnounced(const std::vector<exchange::Message>& outgoing);
  void NotePlanned(std::span<const route::RouteInfo> planned);
  void NoteDone(const std::string& by);
  void NoteMade();
  void AnswerHistory(const exchange::NetworkRequest& request, std::int64_t since_unix_ms);
  void NoteOfNetwork(const route::RouteInfo& info);
  void KeepLookingForJunctions(std::chrono::steady_clock::time_point now);
  void LookAtRefreshed();
  void KeepWhatIsLearnt();
  void Propose(const Meeting& meeting);
  void Tell(const Crossing& crossing, std::chrono::steady_clock::time_point now);
  void DeleteOutdated();
  // Returns what is wrong although everybody is served, or an empty text.
  [[nodiscard]] std::string Degraded() const;
  // Returns why nobody can be served, or an empty text.
  [[nodiscard]] std::string Trouble() const;
  void ShowMetricsIfDue(std::chrono::steady_clock::time_point now);
  void ShowWhatItDoes();
  void ShowStatus(exchange::AgentMode mode, const std::string& detail);

  std::unique_ptr<store::RouteStore> store_;
  catalog::ViewCatalog views_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  std::shared_ptr<const exchange::NetworkState> network_state_ =
      std::make_shared<exchange::NetworkState>();
  std::unique_ptr<exchange::RouteKeeper> keeper_;
  exchange::Mirror mirror_;
  MirrorWatch mirror_watch_;
  std::optional<Upkeep> upkeep_;  // once there is a keeper
  program::Presence presence_;
  Journal journal_;
  Holders holders_;
  std::optional<Quotas> quotas_;  // without it there are no limits
  RequestQueue requests_;
  std::vector<exchange::Message> replies_;  // to requests that the keeper does not answer
  FleetNews fleet_;
  FollowerRegistry followers_;
  std::unique_ptr<MissionRegistry> missions_;    // null if it keeps none
  std::unique_ptr<ScheduleRegistry> schedules_;  // in the missions' store
  std::optional<PhotoRegistry> photos_;          // without it, it keeps none
  std::unique_ptr<NetworkRegistry> network_;     // null if it keeps none
  std::unique_ptr<JunctionFinder> junctions_;    // for that
  bool takes_sure_junctions_ = false;
  RefreshWatch refreshes_;
  std::uint64_t refresh_request_;                        // of the server's own next edit
  std::unique_ptr<History> history_;                     // null if it keeps none
  std::vector<route::RouteKey> planned_;                 // to be changed
  std::chrono::steady_clock::time_point keeping_due_{};  // for what is learnt of the network
  std::optional<Replanning> replanning_;                 // with missions and network
  std::optional<ZoneAdmission> lanes_;                   // likewise
  std::optional<Charging> charging_;                     // likewise
  std::uint64_t told_dropped_ = 0;
  bool views_wait_ = false;  // for the store
  Metrics metrics_;
  std::unique_ptr<HttpPage> page_;  // null if nobody asked for one
  std::chrono::steady_clock::time_point metrics_due_{};
  std::optional<Outdated> outdated_;  // without it everything is kept
  std::chrono::steady_clock::time_point retention_due_{};
  std::chrono::steady_clock::time_point tell_held_back_at_{};
};

}  // namespace trailcast::server
