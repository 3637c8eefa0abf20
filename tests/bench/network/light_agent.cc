// A robot's agent without its robot: status, catalog, fetch.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <deque>
#include <future>
#include <optional>
#include <set>
#include <utility>

#include "services/dds/dds_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_fetcher.h"
#include "services/program/command_line.h"
#include "services/program/presence.h"
#include "services/program/stop_signal.h"
#include "services/route/digest.h"
#include "tests/bench/network/network_bench.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;

exchange::AgentStatus Beginning(const std::string& name) {
  exchange::AgentStatus status;
  status.agent = AgentId(name);
  status.role = exchange::AgentRole::kFollower;
  return status;
}

// A route that nobody taught, on which all followers are.
const route::RouteKey kFollowed{RouteId(std::string(32, 'f')), TeachingId(1)};

double Now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

class LightAgent {
 public:
  LightAgent(const LightAgentOptions& options, exchange::RouteExchange& exchange)
      : options_(options),
        self_(options.name),
        exchange_(exchange),
        presence_(exchange, Beginning(options.name)) {}

  Result<void> Run(const std::function<bool()>& stop) {
    Say("joined");
    const auto hear = [this](const exchange::Message& message) { Hear(message); };
    if (auto claimed = presence_.Claim(hear, stop); !claimed) return claimed;
    if (options_.follow) {
      if (auto listens = exchange_.Listen(exchange::Topic::kNeighbours, {kFollowed}); !listens)
        return listens;
    }
    while (!stop()) {
      for (const exchange::Message& message : exchange_.Take(std::chrono::milliseconds(100))) {
        presence_.Handle(message);
        Hear(message);
      }
      Act(Clock::now());
    }
    return {};
  }

  // Returns the age of each report of its neighbours. The next returns how often they came.
  [[nodiscard]] const std::vector<double>& ages_s() const { return ages_s_; }
  [[nodiscard]] double told_every_s() const {
    return times_told_ < 2 ? 0.0 : (last_told_s_ - first_told_s_) / (times_told_ - 1);
  }

 private:
  void Say(const char* what) {
    fmt::print("{} {:.3f}\n", what, Now_s());
    std::fflush(stdout);
  }
  void Hear(const exchange::Message& message) {
    if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
      const bool server = status->role == exchange::AgentRole::kServer;
      if (server && !std::exchange(met_, true)) Say("met");
      const bool last = others_.insert(status->agent.value()).second && others_.size() == others();
      if (last) Say("heard-all");
    }
    const auto* reply = std::get_if<exchange::CatalogReply>(&message);
    if (reply != nullptr && reply->client == self_ && !fetcher_ && !reply->page.routes.empty()) {
      Say("answered");
      const route::RouteInfo& info = reply->page.routes.front();
      fetcher_.emplace(self_, info.key, std::vector<exchange::RouteFetcher::Held>{},
                       exchange::Integrity{route::CheckDigest, route::ManifestDigest},
                       Clock::now());
      fetcher_->Learn(info, Clock::now());
      (void)exchange_.Listen(exchange::Topic::kSegments,
                             {info.key});  // unheard, it never says "fetched"
    }
    if (fetcher_) fetcher_->Handle(message, Clock::now());
    if (const auto* told = std::get_if<exchange::RouteFollowers>(&message)) Hear(*told);
  }
  void Hear(const exchange::RouteFollowers& told) {
    last_told_s_ = Now_s();
    if (times_told_++ == 0) first_told_s_ = last_told_s_;
    for (const exchange::RouteFollower& one : told.followers) {
      if (one.agent != self_) ages_s_.push_back(last_told_s_ - one.along_m);
    }
  }
  void Act(Clock::time_point now) {
    std::vector<exchange::Message> outgoing;
    if (fetcher_) {
      outgoing = fetcher_->Tick(now);
      [[maybe_unused]] const auto arrived = fetcher_->TakeArrived();
      if (fetcher_->Complete() && !std::exchange(fetched_, true)) {
        Say("fetched");
        (void)exchange_.Listen(exchange::Topic::kSegments, {});
      }
    } else if (!options_.route.empty() && now >= ask_at_) {
      constexpr std::chrono::seconds kAskAgain{1};
      outgoing.emplace_back(
          exchange::CatalogRequest{.client = self_,
                                   .request = ++asked_,
                                   .query = {.name = options_.route, .page_size = 10}});
      ask_at_ = now + kAskAgain;
    }
    // A request that cannot be sent is repeated.
    (void)exchange::PublishAll(exchange_, outgoing);
    exchange::AgentStatus status = presence_.status();
    status.mode = exchange::AgentMode::kWaiting;
    // One clock for all processes of this machine: how old what is told of it is can be seen.
    if (options_.follow) status.place = exchange::PlaceOnRoute{kFollowed, Now_s()};
    presence_.Set(std::move(status));
    presence_.Tick(now);
  }
  // All agents and the server, without itself.
  [[nodiscard]] std::size_t others() const { return options_.agents; }

  LightAgentOptions options_;
  AgentId self_;
  exchange::RouteExchange& exchange_;
  program::Presence presence_;
  std::set<std::string> others_;
  bool met_ = false;
  std::optional<exchange::RouteFetcher> fetcher_;
  bool fetched_ = false;
  std::uint64_t asked_ = 0;
  Clock::time_point ask_at_{};
  std::vector<double> ages_s_;
  int times_told_ = 0;
  double first_told_s_ = 0.0;
  double last_told_s_ = 0.0;
};

void TellOfNeighbours(const std::vector<LightAgent*>& agents) {
  std::vector<double> ages_s;
  std::vector<double> every_s;
  for (const LightAgent* agent : agents) {
    ages_s.insert(ages_s.end(), agent->ages_s().begin(), agent->ages_s().end());
    every_s.push_back(agent->told_every_s());
  }
  if (ages_s.empty()) return;
  fmt::print("neighbours told every {:.2f} s (p99 {:.2f}), age p50 {:.2f} s, p99 {:.2f} s\n",
             Percentile(every_s, 0.5), Percentile(every_s, 0.99), Percentile(ages_s, 0.5),
             Percentile(ages_s, 0.99));
}

}  // namespace

Result<void> RunLightAgents(const LightAgentOptions& options) {
  const program::StopSignal stop;
  std::deque<LightAgentOptions> each;
  std::deque<std::unique_ptr<exchange::RouteExchange>> exchanges;
  std::deque<LightAgent> agents;
  std::vector<LightAgent*> all;
  std::vector<std::future<Result<void>>> running;
  const auto shared = std::make_shared<dds::SharedDomain>();
  for (std::size_t i = 0; i < options.count; ++i) {
    LightAgentOptions& own = each.emplace_back(options);
    if (options.count > 1) own.name += fmt::format("-{}", i);
    dds::DdsOptions joins;
    joins.self = AgentId(own.name);
    joins.network_interface = options.network_interface;
    joins.discovery = options.discovery == "star" ? dds::Discovery::kStar : dds::Discovery::kMesh;
    if (options.count > 1) joins.shared_domain = shared;
    auto exchange = dds::OpenDdsExchange(joins, program::WithAgents(exchange::FollowerTopics()));
    if (!exchange) return tl::unexpected(exchange.error());
    exchanges.push_back(*std::move(exchange));
    all.push_back(&agents.emplace_back(own, *exchanges.back()));
    running.push_back(std::async(std::launch::async, [agent = all.back()] {
      return agent->Run([] { return program::StopSignal::requested(); });
    }));
  }
  Result<void> result;
  for (std::future<Result<void>>& one : running) {
    if (auto ended = one.get(); !ended) result = ended;
  }
  if (options.follow) TellOfNeighbours(all);
  return result;
}

}  // namespace trailcast::bench
