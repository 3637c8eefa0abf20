// A robot's agent without its robot: status, catalog, fetch.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <set>
#include <utility>

#include "services/exchange/publish.h"
#include "services/exchange/route_fetcher.h"
#include "services/program/command_line.h"
#include "services/program/open_exchange.h"
#include "services/program/presence.h"
#include "services/program/stop_signal.h"
#include "services/route/digest.h"
#include "tests/bench/network_bench.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;

exchange::AgentStatus Beginning(const std::string& name) {
  exchange::AgentStatus status;
  status.agent = AgentId(name);
  status.role = exchange::AgentRole::kFollower;
  return status;
}

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
    while (!stop()) {
      for (const exchange::Message& message : exchange_.Take(std::chrono::milliseconds(20))) {
        presence_.Handle(message);
        Hear(message);
      }
      Act(Clock::now());
    }
    return {};
  }

 private:
  void Say(const char* what) {
    const std::chrono::duration<double> since_boot = Clock::now().time_since_epoch();
    fmt::print("{} {:.3f}\n", what, since_boot.count());
    std::fflush(stdout);
  }
  void Hear(const exchange::Message& message) {
    if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
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
      (void)exchange_.Listen({info.key});  // unheard, it never says "fetched"
    }
    if (fetcher_) fetcher_->Handle(message, Clock::now());
  }
  void Act(Clock::time_point now) {
    std::vector<exchange::Message> outgoing;
    if (fetcher_) {
      outgoing = fetcher_->Tick(now);
      [[maybe_unused]] const auto arrived = fetcher_->TakeArrived();
      if (fetcher_->Complete() && !std::exchange(fetched_, true)) {
        Say("fetched");
        (void)exchange_.Listen({});
      }
    } else if (now >= ask_at_) {
      constexpr std::chrono::seconds kAskAgain{1};
      outgoing.emplace_back(
          exchange::CatalogRequest{.client = self_,
                                   .request = ++asked_,
                                   .query = {.name = options_.route, .page_size = 10}});
      ask_at_ = now + kAskAgain;
    }
    // What cannot be handed over is asked for again.
    (void)exchange::PublishAll(exchange_, outgoing);
    exchange::AgentStatus status = presence_.status();
    status.mode = exchange::AgentMode::kWaiting;
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
  std::optional<exchange::RouteFetcher> fetcher_;
  bool fetched_ = false;
  std::uint64_t asked_ = 0;
  Clock::time_point ask_at_{};
};

}  // namespace

Result<void> RunLightAgent(const LightAgentOptions& options) {
  program::CommonOptions common;
  common.name = options.name;
  common.network_interface = options.network_interface;
  const program::StopSignal stop;
  auto exchange = program::OpenExchange(common, program::WithAgents(exchange::FollowerTopics()));
  if (!exchange) return tl::unexpected(exchange.error());
  return LightAgent(options, **exchange).Run([] { return program::StopSignal::requested(); });
}

}  // namespace trailcast::bench
