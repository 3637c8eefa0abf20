// Robots that are only played.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <thread>
#include <variant>

#include "services/dds/dds_exchange.h"
#include "services/exchange/topics.h"
#include "services/program/presence.h"
#include "services/program/stop_signal.h"
#include "tests/bench/console_bench.h"

namespace trailcast::bench {
namespace {

using std::chrono::steady_clock;

constexpr double kSpeed_mps = 0.4;
constexpr std::uint32_t kStandsEach = 10;  // robots, of which one stands

class PlayedRobot {
 public:
  PlayedRobot(std::uint32_t number, std::uint32_t robots,
              std::unique_ptr<exchange::RouteExchange> exchange)
      : number_(number), route_(ConsoleRoute(number, robots)), exchange_(std::move(exchange)) {
    status_.agent = AgentId(fmt::format("robot{:03}", number));
    status_.instance = number + 1;
    status_.role = exchange::AgentRole::kFollower;
    status_.route = route_.name;
    status_.segments = route_.segment_count;
    status_.on_duty = true;
    status_.software = "0.1.0";
    status_.battery_percent = static_cast<std::uint8_t>(100 - number % 80);
    status_.link_percent = static_cast<std::uint8_t>(40 + number % 60);
    if (number % kStandsEach == 0) status_.detail = "a cart stands in its way";
  }

  void Speak(double at_s) {
    for (const exchange::Message& message : exchange_->Take(std::chrono::milliseconds(0))) {
      const auto* mission = std::get_if<mission::Mission>(&message);
      if (mission != nullptr && mission->agent == status_.agent) Begin(*mission);
    }
    const bool stands = number_ % kStandsEach == 0;
    const double length_m = route_.length_m;
    const double along_m =
        std::fmod(number_ * length_m / 7.0 + (stands ? 0.0 : kSpeed_mps * at_s), length_m);
    status_.mode = stands ? exchange::AgentMode::kWaiting : exchange::AgentMode::kReplaying;
    status_.progress = along_m / length_m;
    status_.segment = static_cast<std::uint32_t>(status_.segments * status_.progress);
    status_.speed_mps = stands ? 0.0 : kSpeed_mps + 0.05 * std::sin(at_s);
    status_.features = 40 + static_cast<std::uint32_t>(10.0 * (1.0 + std::sin(0.7 * at_s)));
    // Now and then less sure than a page remembers.
    status_.place = {route_.key, along_m, 0.05 * std::sin(0.3 * at_s),
                     0.3 + 0.28 * std::sin(0.01 * at_s + number_)};
    (void)exchange_->Publish(status_);  // the next one follows
  }

 private:
  void Begin(const mission::Mission& mission) {
    if (mission.id == mission_) return;
    mission_ = mission.id;
    mission::Report report{.agent = status_.agent, .mission = mission.id};
    for (const auto state : {mission::State::kAccepted, mission::State::kUnderWay}) {
      ++report.change;
      report.state = state;
      (void)exchange_->Publish(report);
    }
  }

  std::uint32_t number_;
  route::RouteInfo route_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  exchange::AgentStatus status_;
  std::string mission_;
};

}  // namespace

Result<void> PlayFleet(const PlayedFleetOptions& options) {
  const program::StopSignal stop;
  const auto shared = std::make_shared<dds::SharedDomain>();
  std::deque<PlayedRobot> robots;
  for (std::uint32_t n = 0; n < options.robots; ++n) {
    dds::DdsOptions joins;
    joins.self = AgentId(fmt::format("robot{:03}", n));
    joins.network_interface = options.network_interface;
    joins.discovery = dds::Discovery::kStar;
    joins.shared_domain = shared;
    auto exchange = dds::OpenDdsExchange(joins, program::WithAgents(exchange::OnDutyTopics()));
    if (!exchange) return tl::unexpected(exchange.error());
    robots.emplace_back(n, options.robots, *std::move(exchange));
  }
  const auto began = steady_clock::now();
  const std::chrono::duration<double> each = program::Presence::kForEachAgent;
  for (std::uint64_t turn = 0; !program::StopSignal::requested(); ++turn) {
    const auto told = each * static_cast<double>(turn);
    robots[turn % robots.size()].Speak(options.still ? 0.0 : told.count());
    const auto due = began + std::chrono::duration_cast<steady_clock::duration>(told);
    std::this_thread::sleep_until(due);
  }
  return {};
}

}  // namespace trailcast::bench
