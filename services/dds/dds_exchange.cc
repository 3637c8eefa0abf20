#include "services/dds/dds_exchange.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "services/dds/domain_config.h"
#include "services/dds/entities.h"
#include "services/dds/qos_table.h"
#include "services/dds/wire.h"
#include "services/exchange/batches.h"
#include "services/exchange/bounds.h"
#include "services/exchange/topics.h"

namespace trailcast::dds {
namespace {

using exchange::Message;

// One Take returns at most so many samples of a topic, so that a flood does not starve the others.
constexpr std::size_t kMaxSamplesPerTake = 1024;

class DdsExchange : public exchange::RouteExchange {
 public:
  DdsExchange(Domain domain, Participant participant, WaitSet wait_set, const DdsOptions& options)
      : options_(options),
        domain_(std::move(domain)),
        participant_(std::move(participant)),
        wait_set_(std::move(wait_set)) {}
  ~DdsExchange() override { SayGoodBye(); }
  DdsExchange(const DdsExchange&) = delete;
  DdsExchange& operator=(const DdsExchange&) = delete;

  Result<void> OpenTopics(const exchange::TopicUse& use);

  Result<void> Publish(const Message& message) override;
  std::vector<Message> Take(std::chrono::milliseconds max_wait) override;
  [[nodiscard]] std::uint64_t dropped() const override { return dropped_; }

 private:
  Result<Topic*> Find(exchange::Topic topic);
  Result<void> Write(exchange::Topic topic, const Message& message);
  void TakeFrom(exchange::Topic topic, std::vector<Message>& messages);
  void SayGoodBye();

  DdsOptions options_;
  Domain domain_;
  Participant participant_;
  std::map<exchange::Topic, Topic> topics_;
  std::map<exchange::Topic, Writer> writers_;
  std::map<exchange::Topic, Reader> readers_;
  WaitSet wait_set_;
  std::map<std::string, exchange::AgentStatus> said_;  // by instance: to be disposed at the end
  std::uint64_t dropped_ = 0;
};

Result<Topic*> DdsExchange::Find(exchange::Topic topic) {
  if (const auto found = topics_.find(topic); found != topics_.end()) return &found->second;
  auto made = Topic::Create(participant_, TypeOf(topic), exchange::NameOf(topic));
  if (!made) return tl::unexpected(made.error());
  return &topics_.emplace(topic, *std::move(made)).first->second;
}

Result<void> DdsExchange::OpenTopics(const exchange::TopicUse& use) {
  for (const exchange::Topic topic : use.write) {
    const auto found = Find(topic);
    if (!found) return tl::unexpected(found.error());
    auto writer =
        Writer::Create(participant_, **found, MakeQos(QosOf(topic), options_.write_timeout));
    if (!writer) return Wrap(writer.error(), exchange::NameOf(topic));
    writers_.emplace(topic, *std::move(writer));
  }
  for (const exchange::Topic topic : use.read) {
    const auto found = Find(topic);
    if (!found) return tl::unexpected(found.error());
    auto reader =
        Reader::Create(participant_, **found, MakeQos(QosOf(topic), options_.write_timeout));
    if (!reader) return Wrap(reader.error(), exchange::NameOf(topic));
    if (auto ok = wait_set_.Attach(*reader); !ok) return Wrap(ok.error(), exchange::NameOf(topic));
    readers_.emplace(topic, *std::move(reader));
  }
  return {};
}

Result<void> DdsExchange::Publish(const Message& message) {
  const std::optional<exchange::Topic> topic = exchange::TopicOf(message);
  if (!topic || !writers_.contains(*topic)) {
    return Fail(ErrorCode::kInvalidArgument, "{} was not opened for writing",
                topic ? exchange::NameOf(*topic) : "AgentGone is no topic and");
  }
  if (auto ok = exchange::CheckBounds(message); !ok) return ok;
  if (const auto* batch = std::get_if<exchange::SegmentBatch>(&message)) {
    for (exchange::SegmentBatch& part : exchange::SplitBatch(*batch)) {
      if (auto ok = Write(*topic, std::move(part)); !ok) return ok;
    }
    return {};
  }
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    said_.insert_or_assign(exchange::InstanceOf(message), *status);
  }
  return Write(*topic, message);
}

Result<void> DdsExchange::Write(exchange::Topic topic, const Message& message) {
  Writer& writer = writers_.at(topic);
  // Replies are an instance for each client, and clients that ask once come by the thousand: their
  // instances would be kept for ever.
  const bool last_word = topic == exchange::Topic::kCatalogReplies;
  auto written = WithWire(message, [&](const void* sample) {
    auto done = writer.Write(sample);
    return done && last_word ? writer.Unregister(sample) : done;
  });
  if (!written) return Wrap(written.error(), exchange::NameOf(topic));
  return {};
}

std::vector<Message> DdsExchange::Take(std::chrono::milliseconds max_wait) {
  std::vector<Message> messages;
  // A failed wait leaves nothing to take, and is tried again with the next call.
  if (!wait_set_.Wait(max_wait)) return messages;
  for (const auto& [topic, reader] : readers_) TakeFrom(topic, messages);
  return messages;
}

void DdsExchange::TakeFrom(exchange::Topic topic, std::vector<Message>& messages) {
  struct Received {
    dds_time_t sent_at;
    Message message;
  };
  std::vector<Received> received;
  const bool agents = topic == exchange::Topic::kAgents;
  const auto keep = [&](dds_time_t sent_at, auto message) {
    if (message) {
      received.push_back({sent_at, *std::move(message)});
    } else {
      ++dropped_;
    }
  };
  const auto taken = readers_.at(topic).Take(
      kMaxSamplesPerTake, [&](const void* sample, const dds_sample_info_t& info) {
        if (info.valid_data) keep(info.source_timestamp, FromWire(topic, sample));
        const bool last_of_instance = info.sample_rank == 0;
        if (agents && last_of_instance && info.instance_state != DDS_IST_ALIVE) {
          keep(info.source_timestamp, GoneFromWire(sample));
        }
      });
  if (!taken) ++dropped_;
  // Cyclone gives keyed samples key by key: back to the order in which they were sent.
  if (TypeOf(topic).m_nkeys > 0) {
    std::stable_sort(received.begin(), received.end(),
                     [](const Received& a, const Received& b) { return a.sent_at < b.sent_at; });
  }
  for (Received& one : received) messages.push_back(std::move(one.message));
}

void DdsExchange::SayGoodBye() {
  if (const auto agents = writers_.find(exchange::Topic::kAgents); agents != writers_.end()) {
    for (const auto& [instance, status] : said_) {
      // Best effort: without it the others notice when the lease is over.
      (void)WithWire(status, [&](const void* sample) { return agents->second.Dispose(sample); });
    }
  }
  const auto deadline = std::chrono::steady_clock::now() + options_.close_timeout;
  for (auto& [topic, writer] : writers_) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    (void)writer.WaitForAcks(std::max(left, std::chrono::milliseconds(0)));
  }
}

}  // namespace

Result<std::unique_ptr<exchange::RouteExchange>> OpenDdsExchange(const DdsOptions& options,
                                                                 const exchange::TopicUse& use) {
  if (!IsValidName(options.self.value())) {
    return Fail(ErrorCode::kInvalidArgument,
                "the agent's name is not 1 to 64 of letters, digits, '_', '.', '-'");
  }
  // Read once at start-up, before any thread of ours exists.
  const char* uri = std::getenv("CYCLONEDDS_URI");  // NOLINT(concurrency-mt-unsafe)
  const auto config = DomainConfig(options, uri == nullptr ? "" : uri);
  if (!config) return tl::unexpected(config.error());
  auto domain = Domain::Create(*config);
  if (!domain) return tl::unexpected(domain.error());
  auto participant = Participant::Create(*domain, options.self.value());
  if (!participant) return tl::unexpected(participant.error());
  auto wait_set = WaitSet::Create(*participant);
  if (!wait_set) return tl::unexpected(wait_set.error());
  auto exchange = std::make_unique<DdsExchange>(*std::move(domain), *std::move(participant),
                                                *std::move(wait_set), options);
  if (auto ok = exchange->OpenTopics(use); !ok) return tl::unexpected(ok.error());
  return exchange;
}

}  // namespace trailcast::dds
