#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "services/base/unix_time.h"
#include "services/dds/dds_exchange.h"
#include "services/fleet/now_client.h"
#include "tests/bench/network/network_bench.h"

namespace trailcast::bench {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kStopPatience{10'000};

Result<void> Obeyed(exchange::RouteExchange& exchange, const AgentId& self,
                    exchange::NowOrder order, const std::string& robot) {
  const auto words = fleet::TellRobots(exchange, self, order, {{exchange::NowWhom::kRobot, robot}},
                                       "", kStopPatience);
  if (!words) return tl::unexpected(words.error());
  if (words->front().answered && !words->front().refused) return {};
  return Fail(ErrorCode::kUnavailable, "{}", fleet::WordsText(*words));
}

}  // namespace

Result<void> MeasureStops(const std::string& robot, int samples) {
  dds::DdsOptions options;
  options.network_interface = "eth0";
  options.self = AgentId("desk");
  options.discovery = dds::Discovery::kStar;  // as operators' commands where there is a server
  auto exchange = dds::OpenDdsExchange(options, exchange::DispatcherTopics());
  if (!exchange) return tl::unexpected(exchange.error());
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same each time
  // At any moment between two pictures, and of the server's loop; driving again, and standing, by
  // then.
  std::uniform_int_distribution<int> drive_ms(700, 1300);
  constexpr milliseconds kStand{500};
  for (int i = 0; i < samples; ++i) {
    if (auto drives = Obeyed(**exchange, options.self, exchange::NowOrder::kResume, robot);
        !drives) {
      return drives;
    }
    std::this_thread::sleep_for(milliseconds(drive_ms(random)));
    const std::int64_t told_ms = NowUnixMs();
    const auto began = std::chrono::steady_clock::now();
    auto stands = Obeyed(**exchange, options.self, exchange::NowOrder::kPause, robot);
    if (!stands) return stands;
    const auto answered =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began);
    fmt::print("{} {:.1f}\n", told_ms, answered.count());
    std::fflush(stdout);
    std::this_thread::sleep_for(kStand);
  }
  return {};
}

}  // namespace trailcast::bench
