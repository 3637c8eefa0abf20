#include "services/dds/dds_exchange.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "services/base/newest_map.h"
#include "services/dds/src/domain/joined.h"
#include "services/dds/src/membership.h"
#include "services/dds/src/reminders.h"
#include "services/dds/src/wire.h"
#include "services/exchange/batches.h"
#include "services/exchange/bounds.h"
#include "services/exchange/topics.h"

namespace trailcast::dds {
namespace {

using exchange::Message;
using Clock = std::chrono::steady_clock;

// One Take returns at most so many samples of a topic, so that a flood does not starve the others.
constexpr std::size_t kMaxSamplesPerTake = 1024;

// Others take so long to notice that a member has ended. Members that were heard before this
// exchange joined again have this time to be heard.
constexpr auto kHeardAgain = std::chrono::seconds(10);
constexpr std::size_t kMostHeard = 20'000;  // strangers can make up names

class DdsExchange : public exchange::RouteExchange {
 public:
  DdsExchange(const DdsOptions& options, exchange::TopicUse use)
      : member_(options, std::move(use),
                {.joined = [this] { return OpenAllScopes(); },
                 .says_good_bye = [this] { SayGoodBye(); },
                 .leaves = [this] { ForgetWhoIsHeard(); }}) {}
  ~DdsExchange() override { SayGoodBye(); }
  DdsExchange(const DdsExchange&) = delete;
  DdsExchange& operator=(const DdsExchange&) = delete;

  Result<void> Open() { return member_.Open(); }

  Result<void> Publish(const Message& message) override;
  void Gather() override { gathers_ = true; }
  void Flush() override;
  std::vector<Message> Take(std::chrono::milliseconds max_wait) override;
  Result<void> Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) override;
  [[nodiscard]] std::uint64_t dropped() const override { return dropped_; }

 private:
  [[nodiscard]] const DdsOptions& options() const { return member_.options(); }
  [[nodiscard]] Joined& joined() { return *member_.joined(); }
  void TellWhoIsMissing(Clock::time_point now);
  Result<void> Write(exchange::Topic topic, const Message& message);
  Result<void> OpenForSegmentsOf(const route::RouteKey& route);
  Result<void> OpenScopes(exchange::Topic topic);
  Result<void> OpenAllScopes();
  void TakeFrom(const Place& place, Reader& reader, std::vector<Message>& messages);
  // Keeps what belongs to routes that are listened to; returns false if nothing does.
  [[nodiscard]] bool KeepListenedTo(const Place& place, Message& message) const;
  void NoteWhoIsHeard(const Message& message);
  void ForgetWhoIsHeard();
  void SayGoodBye();
  void Remind(Clock::time_point now);
  [[nodiscard]] bool WaitForSamples(std::chrono::milliseconds max_wait);

  Membership member_;
  std::map<exchange::Topic, std::set<route::RouteKey>> listening_;
  std::map<std::string, exchange::AgentStatus> said_;  // by instance, to be disposed of at the end
  std::uint64_t dropped_ = 0;
  bool gathers_ = false;
  std::set<Place> gathered_;  // writers that have something to flush
  Reminders reminders_;       // for a star

  // The instances that were heard and are not gone.
  NewestMap<std::string, exchange::AgentGone> heard_{kMostHeard};
  // Members that were heard before this exchange left but not since, and until when they may be
  // heard again.
  std::map<std::string, std::pair<exchange::AgentGone, Clock::time_point>> missing_;
  std::vector<Message> gone_;  // for the next Take
};

Result<void> DdsExchange::Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) {
  if (!member_.use().Listens(topic)) {
    return Fail(ErrorCode::kInvalidArgument, "{} was not opened for listening",
                exchange::NameOf(topic));
  }
  std::set<route::RouteKey>& listening = listening_[topic];
  if (routes == listening) return {};
  listening = routes;
  auto opened = OpenScopes(topic);
  if (!opened) listening.clear();  // to be tried again
  return opened;
}

Result<void> DdsExchange::OpenScopes(exchange::Topic topic) {
  if (!member_.joined() || !MayUse(options(), topic)) return {};
  std::set<std::string> scopes;
  for (const route::RouteKey& route : listening_[topic]) scopes.insert(ScopeOf(route));
  return joined().Listen(topic, scopes, options());
}

Result<void> DdsExchange::OpenAllScopes() {
  for (const exchange::Topic topic : member_.use().listen) {
    if (auto opened = OpenScopes(topic); !opened) return opened;
  }
  return {};
}

void DdsExchange::ForgetWhoIsHeard() {
  reminders_.Clear();
  const auto until = Clock::now() + kHeardAgain;
  for (const auto& [instance, gone] : heard_) missing_.try_emplace(instance, gone, until);
  heard_ = NewestMap<std::string, exchange::AgentGone>(kMostHeard);
}

// Nobody else reports members that ended while this exchange joined again.
void DdsExchange::TellWhoIsMissing(Clock::time_point now) {
  std::erase_if(missing_, [&](const auto& entry) {
    const auto& [gone, until] = entry.second;
    if (now >= until) gone_.emplace_back(gone);
    return now >= until;
  });
}

Result<void> DdsExchange::Publish(const Message& message) {
  const std::optional<exchange::Topic> topic = exchange::TopicOf(message);
  if (!topic || !member_.use().Writes(*topic)) {
    return Fail(ErrorCode::kInvalidArgument, "{} was not opened for writing",
                topic ? exchange::NameOf(*topic) : "AgentGone is no topic and");
  }
  if (auto ok = exchange::CheckBounds(message); !ok) return ok;
  if (!member_.joined())
    return Fail(ErrorCode::kUnavailable, "not on the network: {}", member_.WhyNotJoined());
  if (!MayUse(options(), *topic)) {
    return Fail(ErrorCode::kUnavailable, "the keys are of before there was {}: renew them",
                exchange::NameOf(*topic));
  }
  if (const auto* batch = std::get_if<exchange::SegmentBatch>(&message)) {
    for (exchange::SegmentBatch& part : exchange::SplitBatch(*batch)) {
      if (auto ok = Write(*topic, std::move(part)); !ok) return ok;
    }
    return {};
  }
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    said_.insert_or_assign(exchange::InstanceOf(message), *status);
  }
  if (const auto* report = std::get_if<exchange::ReachReport>(&message);
      report != nullptr && !report->relayed) {
    exchange::ReachReport said = *report;
    said.star = joined().meeting.star;
    return Write(*topic, said);
  }
  if (const auto* announcement = std::get_if<exchange::RouteAnnouncement>(&message)) {
    if (auto opened = OpenForSegmentsOf(announcement->info.key); !opened) return opened;
  }
  return Write(*topic, message);
}

// The announcer of a route is soon asked for its segments, so its writer must be discovered by
// then.
Result<void> DdsExchange::OpenForSegmentsOf(const route::RouteKey& route) {
  for (const exchange::Topic topic : member_.use().write) {
    if (!exchange::IsOfRoutes(topic)) continue;
    const auto writer = joined().WriterIn({topic, ScopeOf(route)}, options());
    if (!writer) return tl::unexpected(writer.error());
  }
  return {};
}

Result<void> DdsExchange::Write(exchange::Topic topic, const Message& message) {
  const route::RouteKey* route = exchange::RouteOf(message);
  const Place place{topic, route == nullptr ? kEverybody : ScopeOf(*route)};
  const auto writer = joined().WriterIn(place, options());
  if (!writer) return tl::unexpected(writer.error());
  // Each client has an instance of replies. Clients that ask once come by the thousand, and their
  // instances would stay for ever.
  const bool last_word = topic == exchange::Topic::kCatalogReplies;
  auto written = WithWire(message, [&](const void* sample) {
    auto done = gathers_ ? (*writer)->Gather(sample) : (*writer)->Write(sample);
    return done && last_word ? (*writer)->Unregister(sample) : done;
  });
  if (gathers_) gathered_.insert(place);
  const bool waited_for =
      topic == exchange::Topic::kSegments || topic == exchange::Topic::kSegmentRequests;
  const bool star = joined().meeting.star || options().serves;
  if (star && waited_for) reminders_.NoteWritten(place, Clock::now());
  if (!written) return Wrap(written.error(), exchange::NameOf(topic));
  return {};
}

void DdsExchange::Flush() {
  gathers_ = false;
  for (const Place& place : std::exchange(gathered_, {})) joined().writers.at(place).Flush();
}

void DdsExchange::Remind(Clock::time_point now) {
  reminders_.Tick(
      now,
      [this](const Place& place) {
        return joined().writers.at(place).WaitForAcks(std::chrono::milliseconds(0)).has_value();
      },
      [this](const Place& place) { joined().writers.at(place).Remind(); });
}

// Waits until something comes, or a reminder is due. A failed wait leaves nothing to take; the next
// call tries again.
bool DdsExchange::WaitForSamples(std::chrono::milliseconds max_wait) {
  const auto now = Clock::now();
  Remind(now);
  return joined().wait_set.Wait(reminders_.Wait(now, max_wait)).has_value();
}

std::vector<Message> DdsExchange::Take(std::chrono::milliseconds max_wait) {
  member_.KeepWatch();
  TellWhoIsMissing(Clock::now());
  std::vector<Message> messages = std::exchange(gone_, {});
  if (!member_.joined()) {
    std::this_thread::sleep_for(max_wait);
    return messages;
  }
  if (!WaitForSamples(max_wait)) return messages;
  for (auto& [place, reader] : joined().readers) TakeFrom(place, reader, messages);
  member_.TakeRevocations();
  return messages;
}

// Routes share scopes, and a batch written for everybody may have several routes.
bool DdsExchange::KeepListenedTo(const Place& place, Message& message) const {
  if (place.scope == kEverybody) return true;
  const std::set<route::RouteKey>& listening = listening_.at(place.topic);
  auto* batch = std::get_if<exchange::SegmentBatch>(&message);
  if (batch == nullptr) return listening.contains(*exchange::RouteOf(message));
  std::erase_if(batch->pieces, [&](const auto& piece) { return !listening.contains(piece.key); });
  return !batch->pieces.empty();
}

void DdsExchange::TakeFrom(const Place& place, Reader& reader, std::vector<Message>& messages) {
  const exchange::Topic topic = place.topic;
  struct Received {
    dds_time_t sent_at;
    Message message;
  };
  std::vector<Received> received;
  const bool agents = topic == exchange::Topic::kAgents;
  const auto keep = [&](const dds_sample_info_t& info, Result<Message> message) {
    if (!message) {
      ++dropped_;
      return;
    }
    if (auto* status = std::get_if<exchange::AgentStatus>(&*message)) {
      status->arrival = member_.arrivals().Of(reader, info);
    }
    if (KeepListenedTo(place, *message) &&
        member_.IsAuthentic(reader, info.publication_handle, *message)) {
      received.push_back({info.source_timestamp, *std::move(message)});
    }
  };
  const auto taken =
      reader.Take(kMaxSamplesPerTake, [&](const void* sample, const dds_sample_info_t& info) {
        if (info.valid_data) keep(info, FromWire(topic, sample));
        const bool last_of_instance = info.sample_rank == 0;
        if (agents && last_of_instance && info.instance_state != DDS_IST_ALIVE) {
          keep(info, GoneFromWire(sample));
        }
      });
  if (!taken) ++dropped_;
  // Cyclone delivers keyed samples key by key, so they are sorted back into the order in which they
  // were sent.
  if (TypeOf(topic).m_nkeys > 0) {
    std::stable_sort(received.begin(), received.end(),
                     [](const Received& a, const Received& b) { return a.sent_at < b.sent_at; });
  }
  for (Received& one : received) {
    if (agents) NoteWhoIsHeard(one.message);
    messages.push_back(std::move(one.message));
  }
}

void DdsExchange::NoteWhoIsHeard(const Message& message) {
  member_.Hear(message);
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    const std::string instance = exchange::InstanceOf(message);
    heard_.Touch(instance) = exchange::AgentGone{status->agent, status->instance};
    missing_.erase(instance);
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    const std::string instance = exchange::InstanceOf(
        exchange::AgentStatus{.agent = gone->agent, .instance = gone->instance});
    heard_.Erase(instance);
    missing_.erase(instance);
  }
}

void DdsExchange::SayGoodBye() {
  if (!member_.joined()) return;
  auto& writers = joined().writers;
  if (const auto agents = writers.find({exchange::Topic::kAgents}); agents != writers.end()) {
    for (const auto& [instance, status] : said_) {
      // This is best effort: without it, the others notice when the lease is over.
      (void)WithWire(status, [&](const void* sample) { return agents->second.Dispose(sample); });
    }
  }
  const auto deadline = Clock::now() + options().close_timeout;
  for (auto& [place, writer] : writers) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
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
  auto exchange = std::make_unique<DdsExchange>(options, use);
  if (auto opened = exchange->Open(); !opened) return tl::unexpected(opened.error());
  return exchange;
}

}  // namespace trailcast::dds
