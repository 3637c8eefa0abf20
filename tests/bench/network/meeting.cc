// How long until a route server is met, and until it answers.
#include <unistd.h>

#include <chrono>

#include "services/dds/dds_exchange.h"
#include "services/exchange/topics.h"
#include "services/fleet/ask.h"
#include "tests/bench/network/network_bench.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;

double Since_ms(Clock::time_point then) {
  return std::chrono::duration<double, std::milli>(Clock::now() - then).count();
}

bool IsServer(const exchange::Message& message) {
  const auto* status = std::get_if<exchange::AgentStatus>(&message);
  return status != nullptr && status->role == exchange::AgentRole::kServer;
}

}  // namespace

Result<void> MeasureMeeting(const MeetingOptions& options) {
  dds::DdsOptions dds;
  dds.self = AgentId(fmt::format("meeting-{}", getpid()));
  dds.network_interface = options.network_interface;
  dds.discovery = dds::Discovery::kStar;
  if (!options.server_address.empty()) dds.server_addresses = {options.server_address};
  const auto began = Clock::now();
  auto opened = dds::OpenDdsExchange(dds, exchange::ObserverTopics());
  if (!opened) return tl::unexpected(opened.error());
  exchange::RouteExchange& exchange = **opened;
  const auto patience = std::chrono::duration<double>(options.patience_s);
  for (bool met = false; !met;) {
    if (Clock::now() - began > patience) {
      return Fail(ErrorCode::kUnavailable, "no server was met within {} s", options.patience_s);
    }
    for (const exchange::Message& message : exchange.Take(std::chrono::milliseconds(50))) {
      met = met || IsServer(message);
    }
  }
  fmt::print("{:.0f}", Since_ms(began));
  std::vector<double> answered_ms;
  for (int i = 1; i <= options.queries; ++i) {
    const auto asked = Clock::now();
    const exchange::CatalogRequest question{.client = dds.self,
                                            .request = static_cast<std::uint64_t>(i),
                                            .query = {.name = "hall", .page_size = 10}};
    const auto reply = fleet::Ask<exchange::CatalogReply>(
        exchange, dds.self, question.request, question,
        std::chrono::duration_cast<std::chrono::milliseconds>(patience));
    if (!reply) return tl::unexpected(reply.error());
    answered_ms.push_back(Since_ms(asked));
  }
  fmt::print(" {:.1f} {:.1f}\n", Percentile(answered_ms, 0.5), Percentile(answered_ms, 0.99));
  return {};
}

}  // namespace trailcast::bench
