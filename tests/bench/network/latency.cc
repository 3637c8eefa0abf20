#include <unistd.h>

#include <chrono>
#include <optional>

#include "services/dds/dds_exchange.h"
#include "services/security/authority.h"
#include "services/security/member_keys.h"
#include "tests/bench/network/network_bench.h"
#include "tests/support/pieces.h"
#include "tests/support/temp_dir.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

using Keys = std::optional<security::MemberKeys>;

// A member of the name; nothing when `secured` is false.
Result<Keys> KeysFor(const char* name, security::Role role, bool secured,
                     const std::filesystem::path& folder) {
  if (!secured) return Keys();
  const auto now = std::chrono::system_clock::now();
  const auto authority = std::filesystem::exists(folder / "fleet")
                             ? security::Authority::Open(folder / "fleet")
                             : security::Authority::Create(folder / "fleet", now, 1);
  if (!authority) return tl::unexpected(authority.error());
  const auto given = authority->Add(name, role, now, 1);
  if (!given) return tl::unexpected(given.error());
  auto keys = security::LoadMemberKeys(*given, now);
  if (!keys) return tl::unexpected(keys.error());
  return Keys(*std::move(keys));
}

Result<std::unique_ptr<exchange::RouteExchange>> Open(const char* name,
                                                      const exchange::TopicUse& use,
                                                      const Result<Keys>& keys) {
  if (!keys) return tl::unexpected(keys.error());
  dds::DdsOptions options;
  options.discovery_tag = fmt::format("latency-{}", getpid());
  options.network_interface = "lo";
  options.self = AgentId(name);
  options.keys = *keys;
  return dds::OpenDdsExchange(options, use);
}

// The segment of this index; earlier ones may come before it.
bool Came(exchange::RouteExchange& follower, std::uint32_t index, milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  while (Clock::now() < deadline) {
    for (const exchange::Message& message : follower.Take(patience)) {
      const auto* batch = std::get_if<exchange::SegmentBatch>(&message);
      if (batch != nullptr && batch->pieces.back().index.value() == index) return true;
    }
  }
  return false;
}

}  // namespace

Result<void> MeasureLatency(int samples, bool secured) {
  constexpr std::size_t kBytes = 4096;
  constexpr std::chrono::seconds kPatience{60};
  using exchange::Topic;
  const test::TempDir folder;
  const auto scout_keys = KeysFor("scout", security::Role::kScout, secured, folder.path());
  const auto follower_keys = KeysFor("follower", security::Role::kFollower, secured, folder.path());
  auto scout = Open("scout", {.write = {Topic::kSegments}, .read = {}}, scout_keys);
  auto follower = Open("follower", {.write = {}, .read = {Topic::kSegments}}, follower_keys);
  const auto opened = Clock::now();
  std::optional<double> met_s;
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
    if (!Came(**follower, index, milliseconds(met_s ? 100 : 5))) continue;
    if (!met_s) met_s = std::chrono::duration<double>(Clock::now() - opened).count();
    const std::chrono::duration<double, std::micro> took = Clock::now() - published;
    taken_us.push_back(took.count());
  }
  fmt::print("{}{} segments of {} bytes: p50 {:.0f} us, p99 {:.0f} us; the first after {:.2f} s\n",
             secured ? "secured, " : "", samples, kBytes, Percentile(taken_us, 0.5),
             Percentile(taken_us, 0.99), met_s.value_or(0.0));
  return {};
}

}  // namespace trailcast::bench
