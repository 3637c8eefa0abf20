#include "route_server/server.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "services/base/text.h"
#include "services/base/unix_time.h"
#include "services/catalog/editing.h"
#include "services/exchange/bounds.h"
#include "services/exchange/publish.h"
#include "services/route/digest.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kWait{50};
constexpr milliseconds kWaitAnswering{1};
constexpr milliseconds kStatusEvery{1000};
constexpr milliseconds kMetricsEvery{1000};
constexpr milliseconds kKeepingEvery{10'000};  // for what is learnt of the network
constexpr milliseconds kRetentionEvery{1000};  // for some routes at a time
constexpr std::size_t kViewsASlice = 100;      // segments, which take about 20 ms

exchange::AgentStatus ServerStatus(const AgentId& name) {
  exchange::AgentStatus status;
  status.agent = name;
  status.role = exchange::AgentRole::kServer;
  return status;
}

spdlog::level::level_enum LevelOf(exchange::Note::Severity severity) {
  switch (severity) {
    case exchange::Note::Severity::kInfo:
      return spdlog::level::info;
    case exchange::Note::Severity::kWarning:
      return spdlog::level::warn;
    case exchange::Note::Severity::kError:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

}  // namespace

Server::Server(const AgentId& name, std::unique_ptr<store::RouteStore> store,
               std::unique_ptr<exchange::RouteExchange> exchange)
    : store_(std::move(store)),
      views_(*store_),
      exchange_(std::move(exchange)),
      mirror_(name, *store_),
      presence_(*exchange_, ServerStatus(name), kStatusEvery),
      fleet_(name),
      followers_(name),
      refreshes_(*store_),
      refresh_request_(static_cast<std::uint64_t>(NowUnixMs())) {}

Result<std::unique_ptr<Server>> Server::Open(const AgentId& name,
                                             std::unique_ptr<store::RouteStore> store,
                                             std::unique_ptr<exchange::RouteExchange> exchange) {
  std::unique_ptr<Server> server(new Server(name, std::move(store), std::move(exchange)));
  exchange::RouteKeeper::Catalog catalog;
  catalog.answer = [name, self = server.get()](const exchange::CatalogRequest& request) {
    return self->AnswerCatalog(name, request);
  };
  catalog.plan = [self = server.get()](const route::RouteEdit& edit) {
    auto planned = catalog::PlanEdit(edit, *self->store_);
    if (planned) self->NotePlanned(*planned);
    return planned;
  };
  auto keeper =
      exchange::RouteKeeper::Open(name, *server->store_, std::move(catalog),
                                  exchange::Integrity{route::CheckDigest, route::ManifestDigest});
  if (!keeper) return tl::unexpected(keeper.error());
  server->keeper_ = std::move(*keeper);
  server->upkeep_.emplace(*server->store_, *server->keeper_);
  return server;
}

Result<void> Server::Run(const std::function<bool()>& stop) {
  WaitForNetwork(stop);
  const auto receive = [this](const exchange::Message& message) { Receive(message); };
  if (auto claimed = presence_.Claim(receive, stop); !claimed) return claimed;
  const auto routes = store_->QueryRoutes({.page_size = 1});
  if (!routes) return tl::unexpected(routes.error());
  if (auto noted = refreshes_.NoteStored(); !noted) return noted;
  spdlog::info("ready: {} routes in the store", routes->total);
  while (!stop()) Serve();
  KeepWhatIsLearnt();
  ShowStatus(exchange::AgentMode::kStopped, "stopped by a signal");
  presence_.Publish();
  const exchange::KeeperCounters& counters = keeper_->counters();
  spdlog::info(
      "stopped by a signal; since the start {} segments stored, {} received again, {} sent to "
      "followers",
      counters.appended, counters.duplicates, counters.answered);
  return {};
}

// The name is claimed afterwards, because its owner, and requests, can only be heard on a network.
void Server::WaitForNetwork(const std::function<bool()>& stop) {
  while (!stop() && !network_state_->trouble.empty()) {
    const auto now = steady_clock::now();
    presence_.Tick(now);
    ShowMetricsIfDue(now);
    for (exchange::Message& message : exchange_->Take(kWait)) Receive(std::move(message));
  }
}

Result<void> Server::KeepMissions(std::unique_ptr<store::MissionStore> store) {
  auto registry = MissionRegistry::Open(presence_.status().agent, std::move(store));
  if (!registry) return tl::unexpected(registry.error());
  missions_ = std::move(*registry);
  KeepWays();
  return OpenSchedules();
}

Result<void> Server::KeepNetwork(std::unique_ptr<store::NetworkStore> store) {
  auto registry = NetworkRegistry::Open(presence_.status().agent, std::move(store), *store_);
  if (!registry) return tl::unexpected(registry.error());
  network_ = std::move(*registry);
  junctions_ = std::make_unique<JunctionFinder>(
      *store_, views_, [this](const route::RouteKey& key) { return network_->WasSearched(key); });
  KeepWays();
  return {};
}

void Server::KeepWays() {
  if (!missions_ || !network_) return;
  replanning_.emplace(*missions_, *network_);
  lanes_.emplace(*missions_, *network_);
  missions_->PlanBy([this](const AgentId& agent, const std::string& goal) -> Result<bool> {
    const auto* stand = network_->StandOf(agent);
    if (stand == nullptr) {
      return Fail(ErrorCode::kNotFound,
                  "{} has not said where on a route it stands since this server was started",
                  agent.value());
    }
    const auto way = network_->WayOn(stand->place, goal);
    if (!way) return tl::unexpected(way.error());
    return !way->empty();
  });
  charging_.emplace(presence_.status().agent, *missions_, *network_);
  missions_->WaitBy([this](const mission::Record& first) { return charging_->WhyNot(first); });
  for (const std::string& line : lanes_->LookAtAll(steady_clock::now())) spdlog::info("{}", line);
}

void Server::Replan(const AgentId& agent) {
  if (!replanning_) return;
  const auto now = steady_clock::now();
  const std::string line = replanning_->Look(agent, now);
  if (!line.empty()) spdlog::warn("{}", line);
  for (const std::string& each : lanes_->Look(agent, now)) spdlog::info("{}", each);
}

void Server::Receive(exchange::Message message) {
  if (IsRequest(message)) {
    ReceiveRequest(message);
    return;
  }
  if (ServePhotos(message)) return;
  const bool passed_on = PassOn(message);
  if (missions_) {
    const auto now = steady_clock::now();
    // A command means the missions that were sent before it, including those that wait for their
    // turn.
    if (std::holds_alternative<exchange::NowCommand>(message)) {
      missions_->Take(requests_.TakeMissions(), now, NowUnixMs());
    }
    missions_->Handle(message, now, NowUnixMs());
    schedules_->Hear(message);
    if (charging_) charging_->Hear(message);
  }
  if (passed_on) return;
  presence_.Handle(message);
  fleet_.Handle(message);
  followers_.Handle(message, steady_clock::now());
  if (const auto line = journal_.Received(message)) spdlog::info("{}", *line);
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    holders_.Note(*status, steady_clock::now());
    if (network_) network_->Hear(*status);
    Replan(status->agent);
  }
  if (const auto* followed = std::get_if<exchange::FollowedSections>(&message);
      followed != nullptr && network_) {
    network_->followed().Hear(*followed, NowUnixMs());
  }
  if (const auto* announced = std::get_if<exchange::RouteAnnouncement>(&message)) {
    NoteViews(*announced);
    // Another server may have changed it in a shared store.
    if (network_ && store_->shared()) NoteOfNetwork(announced->info);
  }
  mirror_.Handle(message, steady_clock::now());
  if (!quotas_) {
    keeper_->Handle(std::move(message), steady_clock::now());
  } else if (auto allowed = WithinQuotas(message)) {
    keeper_->Handle(*std::move(allowed), steady_clock::now());
  }
}

// This happens at once, before any other work. Returns true for such a message.
bool Server::PassOn(const exchange::Message& message) {
  const auto pass = [this](auto copy) {
    if (copy.relayed) return;  // another server has passed it on
    if (const auto line = journal_.Received(copy)) spdlog::info("{}", *line);
    copy.relayed = true;
    // A message that cannot be sent now is repeated by its author.
    (void)exchange_->Publish(copy);
  };
  if (const auto* command = std::get_if<exchange::NowCommand>(&message)) {
    pass(*command);
  } else if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) {
    pass(*answer);
  } else {
    return false;
  }
  return true;
}

// Another server may have put it into a shared store.
void Server::NoteViews(const exchange::RouteAnnouncement& announcement) {
  const bool scouts = announcement.holder == announcement.info.scout;
  if (scouts || announcement.info.standing == route::Standing::kDeleted) return;
  views_.Note(announcement.info.key);
}

void Server::Serve() {
  for (exchange::Message& message : exchange_->Take(WaitForMessages())) Receive(std::move(message));
  ServeRequests();
  TellKeptPhotos();
  const auto now = steady_clock::now();
  const auto outgoing = Say(now);
  TellTroubles();
  NoteAnnounced(outgoing);
  FillViews(outgoing);
  KeepLookingForJunctions(now);
  LookAtRefreshed();
  if (now >= keeping_due_ && upkeep_->store_trouble().empty()) {
    keeping_due_ = now + kKeepingEvery;
    KeepWhatIsLearnt();
  }
  upkeep_->Tick(now);
  TellAgents();
  TellMissions();
  ShowWhatItDoes();
  presence_.Tick(now);
  if (outdated_ && now >= retention_due_) {
    retention_due_ = now + kRetentionEvery;
    DeleteOutdated();
  }
  ShowMetricsIfDue(now);
}

milliseconds Server::WaitForMessages() const {
  const bool views_due = !views_.Filled() && !views_wait_;
  const bool more = !requests_.empty() || keeper_->AnswersDue(steady_clock::now());
  if (views_due || more) return milliseconds(0);
  const milliseconds wait = keeper_->answering() ? kWaitAnswering : kWait;
  const auto junctions_due = junctions_ ? junctions_->due() : std::nullopt;
  if (!junctions_due) return wait;
  return std::clamp(std::chrono::ceil<milliseconds>(*junctions_due - steady_clock::now()),
                    milliseconds(0), wait);
}

std::vector<exchange::Message> Server::Say(steady_clock::time_point now) {
  auto outgoing = keeper_->Tick(now);
  for (const exchange::Message& message : outgoing) {
    const auto* announced = std::get_if<exchange::RouteAnnouncement>(&message);
    if (announced != nullptr) mirror_.NoteStored(announced->info.key);
  }
  for (exchange::Message& told : mirror_.Tick(now)) outgoing.push_back(std::move(told));
  for (exchange::Message& reply : std::exchange(replies_, {})) {
    outgoing.push_back(std::move(reply));
  }
  for (const exchange::Message& message : outgoing) {
    if (const auto line = journal_.Sent(message)) spdlog::info("{}", *line);
  }
  const auto told = [this, now](const exchange::Message& message, bool sent) {
    sent ? keeper_->Sent(message) : keeper_->NotSent(message, now);
  };
  if (auto sent = exchange::PublishAll(*exchange_, outgoing, told); !sent) {
    spdlog::debug("{}", sent.error().message);
  }
  return outgoing;
}

void Server::TellTroubles() {
  for (const exchange::Note& note : keeper_->TakeNotes()) {
    spdlog::log(LevelOf(note.severity), "{}", note.text);
  }
  for (const std::string& line : mirror_watch_.Look(mirror_, steady_clock::now())) {
    spdlog::info("{}", line);
  }
  if (exchange_->dropped() > told_dropped_) {
    told_dropped_ = exchange_->dropped();
    spdlog::warn("{} messages so far were out of bounds or unreadable, and dropped", told_dropped_);
  }
}

// Tells agents that hear nobody else what they need to know of each other.
void Server::TellAgents() {
  const auto now = steady_clock::now();
  std::vector<exchange::Message> told;
  if (auto fleet = fleet_.Due(now)) told.emplace_back(*std::move(fleet));
  for (exchange::RouteFollowers& followers : followers_.Due(now)) {
    told.emplace_back(std::move(followers));
  }
  // Anything that cannot be sent is soon repeated.
  (void)exchange::PublishAll(*exchange_, told);
  for (const std::string& note : fleet_.TakeNotes()) spdlog::warn("{}", note);
}

void Server::TellMissions() {
  if (!missions_) return;
  TellSchedules();
  SendToCharge();
  // Anything that cannot be sent is requested, or sent, again.
  (void)exchange::PublishAll(*exchange_, missions_->Tick(steady_clock::now(), NowUnixMs()));
  for (const MissionRegistry::Note& note : missions_->TakeNotes()) {
    spdlog::log(note.warning ? spdlog::level::warn : spdlog::level::info, "{}", note.text);
  }
}

void Server::SendToCharge() {
  if (!charging_) return;
  charging_->Tick(steady_clock::now(), NowUnixMs());
  for (const std::string& trouble : charging_->TakeTroubles()) spdlog::warn("{}", trouble);
}

// Segments that were appended are on the disk, and routes announced as deleted are not.
void Server::FillViews(const std::vector<exchange::Message>& outgoing) {
  for (const route::SegmentPiece& piece : keeper_->TakeAppended()) {
    if (const auto added = views_.Add(piece); !added) {
      spdlog::warn("left out of the index of views: {}", added.error().message);
    }
    upkeep_->NoteStored(piece.key, piece.index);
    if (junctions_) junctions_->NoteStored(piece.key, piece.index);
  }
  for (const auto& [key, segment] : keeper_->TakeDamaged()) upkeep_->NoteDamaged(key, segment);
  for (const exchange::Message& message : outgoing) {
    const auto* announced = std::get_if<exchange::RouteAnnouncement>(&message);
    if (announced != nullptr) refreshes_.Note(announced->info);
    if (announced != nullptr && network_) NoteOfNetwork(announced->info);
    if (announced != nullptr && announced->info.standing == route::Standing::kDeleted) {
      views_.Forget(announced->info.key);
    }
  }
  for (const auto& [key, segment] : views_.TakeDamaged()) {
    keeper_->NoteDamage(key, segment, steady_clock::now());
  }
  if (views_.Filled()) return;
  const auto filled = views_.Fill(kViewsASlice);
  const bool waited =
      std::exchange(views_wait_, !filled && filled.error().code == ErrorCode::kUnavailable);
  if (views_wait_) {
    if (!waited) spdlog::warn("the index of views waits: {}", filled.error().message);
  } else if (!filled) {
    spdlog::warn("left out of the index of views: {}", filled.error().message);
  }
  if (views_.Filled()) spdlog::debug("{} segments indexed by view", views_.index().size());
}

void Server::DeleteOutdated() {
  const auto outdated = outdated_->Next(steady_clock::now());
  if (!outdated) {
    spdlog::warn("looking for outdated revisions: {}", outdated.error().message);
    return;
  }
  if (outdated->empty()) return;
  NotePlanned(*outdated);
  if (auto deleted = keeper_->Relabel(*outdated, steady_clock::now()); !deleted) {
    spdlog::warn("deleting outdated revisions: {}", deleted.error().message);
    return;
  }
  NoteDone(presence_.status().agent.value());
  for (const route::RouteInfo& info : *outdated) {
    spdlog::info("outdated: revision {} of route '{}' deleted", info.revision.value(), info.name);
  }
}

std::string Server::Degraded() const {
  std::string degraded = upkeep_->Degraded();
  const auto add = [&](const char* what, const std::string& why) {
    if (why.empty()) return;
    degraded += fmt::format("{}{}: {}", degraded.empty() ? "" : "; ", what, why);
  };
  add("nothing that scouts send is stored", keeper_->untaken());
  if (missions_) add("no news of missions are stored", missions_->untaken());
  // Servers that share a store hold the same routes.
  if (!store_->shared()) add("not mirrored", MirrorWatch::Behind(mirror_, steady_clock::now()));
  return degraded;
}

std::string Server::Trouble() const {
  if (const std::string& store = upkeep_->store_trouble(); !store.empty()) {
    return "the store is away: " + store;
  }
  const std::string& network = network_state_->trouble;
  return network.empty() ? "" : "no network: " + network;
}

void Server::ShowMetricsIfDue(steady_clock::time_point now) {
  if (!page_ || now < metrics_due_) return;
  metrics_due_ = now + kMetricsEvery;
  metrics_.keeper = keeper_->counters();
  metrics_.dropped = exchange_->dropped();
  metrics_.backlog = keeper_->backlog();
  metrics_.agents = journal_.agents();
  if (const auto page = store_->QueryRoutes({.page_size = 1})) metrics_.routes = page->total;
  metrics_.store_reachable = upkeep_->store_trouble().empty() && keeper_->untaken().empty();
  metrics_.partial_routes = upkeep_->partial_routes();
  metrics_.lacking_segments = upkeep_->lacking_segments();
  metrics_.dropped_orphans = upkeep_->dropped_orphans();
  metrics_.on_network = network_state_->trouble.empty();
  metrics_.mirror = {mirror_.others().size(), 0, mirror_.under_way(), mirror_.asked()};
  for (const auto& [server, other] : mirror_.others()) {
    metrics_.mirror.same += other.there && !other.differs_since ? 1U : 0U;
  }
  metrics_.network_joins = network_state_->joins;
  if (network_) metrics_.junctions.open = network_->open_proposals();
  page_->Show({metrics_.Text(), Trouble(), Degraded()});
}

void Server::ShowWhatItDoes() {
  if (!upkeep_->store_trouble().empty()) {
    ShowStatus(
        exchange::AgentMode::kFault,
        PlainText("the store is away: " + upkeep_->store_trouble(), exchange::kMaxLineBytes));
    return;
  }
  std::string detail = fmt::format("serving: {} segments stored, {} sent",
                                   keeper_->counters().appended, keeper_->counters().answered);
  if (const std::string degraded = Degraded(); !degraded.empty()) detail += "; " + degraded;
  if (const std::string trouble = fleet_.NameTrouble(); !trouble.empty()) detail += "; " + trouble;
  ShowStatus(exchange::AgentMode::kWaiting, PlainText(detail, exchange::kMaxLineBytes));
}

void Server::ShowStatus(exchange::AgentMode mode, const std::string& detail) {
  exchange::AgentStatus status;
  status.mode = mode;
  status.detail = detail;
  status.on_duty = missions_ != nullptr;
  presence_.Set(std::move(status));
}

}  // namespace trailcast::server
