// Cyclone alone, as one would use it without a protocol of one's own.
#include <dds/dds.h>

#include <chrono>
#include <numeric>

#include "services/dds/src/entities.h"
#include "services/dds/src/wire.h"
#include "tests/bench/network/network_bench.h"
#include "tests/support/pieces.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kLocalBytes = 4096;
constexpr const char* kTopic = "plain_segments";

dds::Qos KeepAll() {
  dds::Qos qos = dds::MakeQos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  return qos;
}

struct Plain {
  dds::Domain domain;
  dds::Participant participant;
  dds::Topic topic;
};

// With CYCLONEDDS_URI, and Cyclone's defaults for the rest.
Result<Plain> Join(const std::string& name) {
  const char* uri = std::getenv("CYCLONEDDS_URI");  // NOLINT(concurrency-mt-unsafe)
  auto domain = dds::Domain::Create(uri == nullptr ? "" : uri);
  if (!domain) return tl::unexpected(domain.error());
  auto participant = dds::Participant::Create(*domain, name);
  if (!participant) return tl::unexpected(participant.error());
  auto topic = dds::Topic::Create(*participant, dds::TypeOf(exchange::Topic::kSegments), kTopic);
  if (!topic) return tl::unexpected(topic.error());
  return Plain{*std::move(domain), *std::move(participant), *std::move(topic)};
}

}  // namespace

Result<void> WriteTransientLocal(int samples) {
  auto plain = Join("plain-writer");
  if (!plain) return tl::unexpected(plain.error());
  auto writer = dds::Writer::Create(plain->participant, plain->topic, KeepAll());
  if (!writer) return tl::unexpected(writer.error());
  for (int i = 0; i < samples; ++i) {
    const exchange::SegmentBatch batch{
        .sender = AgentId("plain"),
        .pieces = {test::PieceOf(test::KeyNumber(1), static_cast<std::uint32_t>(i), kLocalBytes)}};
    auto written = dds::WithWire(batch, [&](const void* sample) { return writer->Write(sample); });
    if (!written) return written;
  }
  fmt::print("written\n");
  std::fflush(stdout);
  pause();  // until killed
  return {};
}

Result<void> ReadTransientLocal(int samples) {
  constexpr std::chrono::seconds kPatience{120};
  auto plain = Join("plain-reader");
  if (!plain) return tl::unexpected(plain.error());
  auto reader = dds::Reader::Create(plain->participant, plain->topic, KeepAll());
  auto waiting = dds::WaitSet::Create(plain->participant);
  if (!reader) return tl::unexpected(reader.error());
  if (!waiting) return tl::unexpected(waiting.error());
  if (auto attached = waiting->Attach(*reader); !attached) return attached;
  // Matched, not started: finding each other is not what is measured.
  const auto deadline = Clock::now() + kPatience;
  dds_subscription_matched_status_t matched{};
  while (matched.current_count == 0 && Clock::now() < deadline) {
    (void)dds_get_subscription_matched_status(reader->handle(), &matched);
    dds_sleepfor(DDS_USECS(200));
  }
  const auto began = Clock::now();
  int got = 0;
  while (got < samples && Clock::now() < deadline) {
    if (auto waited = waiting->Wait(std::chrono::milliseconds(1000)); !waited) return waited;
    auto taken = reader->Take(static_cast<std::size_t>(samples),
                              [&](const void*, const dds_sample_info_t&) { ++got; });
    if (!taken) return taken;
  }
  const std::chrono::duration<double> took = Clock::now() - began;
  if (got < samples) {
    return Fail(ErrorCode::kUnavailable, "{} of {} samples came within {} s", got, samples,
                kPatience.count());
  }
  fmt::print("seconds={:.3f}\n", took.count());
  return {};
}

}  // namespace trailcast::bench
