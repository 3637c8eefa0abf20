#include <unistd.h>

#include <chrono>

#include "services/dds/dds_exchange.h"
#include "tests/bench/network_bench.h"
#include "tests/support/pieces.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

Result<std::unique_ptr<exchange::RouteExchange>> Open(const char* name,
                                                      const exchange::TopicUse& use) {
  dds::DdsOptions options;
  options.discovery_tag = fmt::format("latency-{}", getpid());
  options.network_interface = "lo";
  options.self = AgentId(name);
  return dds::OpenDdsExchange(options, use);
}

// The segment of this index; earlier ones may come before it.
bool Came(exchange::RouteExchange& follower, std::uint32_t index) {
  const auto deadline = Clock::now() + milliseconds(100);
  while (Clock::now() < deadline) {
    for (const exchange::Message& message : follower.Take(milliseconds(100))) {
      const auto* batch = std::get_if<exchange::SegmentBatch>(&message);
      if (batch != nullptr && batch->pieces.back().index.value() == index) return true;
    }
  }
  return false;
}

}  // namespace

Result<void> MeasureLatency(int samples) {
  constexpr std::size_t kBytes = 4096;
  constexpr std::chrono::seconds kPatience{60};
  using exchange::Topic;
  auto scout = Open("scout", {.write = {Topic::kSegments}, .read = {}});
  auto follower = Open("follower", {.write = {}, .read = {Topic::kSegments}});
  if (!scout) return tl::unexpected(scout.error());
  if (!follower) return tl::unexpected(follower.error());
  std::vector<double> taken_us;
  const auto deadline = Clock::now() + kPatience;
  for (std::uint32_t index = 0; static_cast<int>(taken_us.size()) < samples; ++index) {
    if (Clock::now() > deadline) {
      return Fail(ErrorCode::kUnavailable, "only {} of {} segments came", taken_us.size(), samples);
    }
    const exchange::SegmentBatch batch{
        .sender = AgentId("scout"), .pieces = {test::PieceOf(test::KeyNumber(1), index, kBytes)}};
    const auto published = Clock::now();
    if (auto sent = (*scout)->Publish(batch); !sent) return sent;
    // The first ones are lost, the endpoints have not found each other yet.
    if (!Came(**follower, index)) continue;
    const std::chrono::duration<double, std::micro> took = Clock::now() - published;
    taken_us.push_back(took.count());
  }
  fmt::print("{} segments of {} bytes: p50 {:.0f} us, p99 {:.0f} us\n", samples, kBytes,
             Percentile(taken_us, 0.5), Percentile(taken_us, 0.99));
  return {};
}

}  // namespace trailcast::bench
