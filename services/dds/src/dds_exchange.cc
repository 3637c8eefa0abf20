#include "services/dds/dds_exchange.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <thread>
#include <utility>

#include "services/base/newest_map.h"
#include "services/dds/src/arrivals.h"
#include "services/dds/src/domain/cyclone_uri.h"
#include "services/dds/src/domain/interfaces.h"
#include "services/dds/src/domain/joined.h"
#include "services/dds/src/domain/network_watch.h"
#include "services/dds/src/domain/server_names.h"
#include "services/dds/src/domain/star_or_mesh.h"
#include "services/dds/src/keys_watch.h"
#include "services/dds/src/reminders.h"
#include "services/dds/src/stranger_watch.h"
#include "services/dds/src/version_watch.h"
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

// The network, the keys' folder and the present members are checked this often.
constexpr auto kLookEvery = std::chrono::seconds(1);

// Joining is tried again this soon. Looking up a name's address may take seconds.
constexpr auto kTriesAgain = std::chrono::seconds(1);
constexpr auto kTriesAgainAtMost = std::chrono::seconds(8);

// Others take so long to notice that a member has ended. Members that were heard before this
// exchange joined again have this time to be heard.
constexpr auto kHeardAgain = std::chrono::seconds(10);
constexpr std::size_t kMostHeard = 20'000;  // strangers can make up names

NetworkWatch WatchFor(const DdsOptions& options) {
  const bool cyclone = options.network_interface.empty() && ChoosesInterfaces(UriXml(CycloneUri()));
  return NetworkWatch(options.network_interface,
                      cyclone ? NetworkWatch::By::kCyclone : NetworkWatch::By::kOne);
}

double RandomShare() {
  std::random_device random;
  return std::uniform_real_distribution<double>(0.0, 1.0)(random);
}

class DdsExchange : public exchange::RouteExchange {
 public:
  DdsExchange(const DdsOptions& options, exchange::TopicUse use)
      : options_(options),
        use_(std::move(use)),
        network_(WatchFor(options)),
        servers_(options.server_addresses),
        star_or_mesh_(options.discovery, RandomShare()),
        versions_(options.protocol_version, options.keys.has_value()) {
    if (options_.keys) keys_watch_.emplace(*options_.keys, options_.tell_of_stranger);
  }
  ~DdsExchange() override { SayGoodBye(); }
  DdsExchange(const DdsExchange&) = delete;
  DdsExchange& operator=(const DdsExchange&) = delete;

  Result<void> Open();

  Result<void> Publish(const Message& message) override;
  void Gather() override { gathers_ = true; }
  void Flush() override;
  std::vector<Message> Take(std::chrono::milliseconds max_wait) override;
  Result<void> Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) override;
  [[nodiscard]] std::uint64_t dropped() const override { return dropped_; }

 private:
  Result<void> OpenOrWait(Clock::time_point now);
  Result<void> Join();
  void TryToJoin(Clock::time_point now);
  void LookAtNetwork(Clock::time_point now);
  void LookForServers(Clock::time_point now);
  void TellOfNetwork(const std::string& line);
  [[nodiscard]] std::string WhyNotJoined() const;
  void ShowNetworkState();
  void TellWhoIsMissing(Clock::time_point now);
  Result<void> Write(exchange::Topic topic, const Message& message);
  Result<void> OpenForSegmentsOf(const route::RouteKey& route);
  Result<void> OpenScopes(exchange::Topic topic);
  void TakeFrom(const Place& place, Reader& reader, std::vector<Message>& messages);
  // Keeps what belongs to routes that are listened to; returns false if nothing does.
  [[nodiscard]] bool KeepListenedTo(const Place& place, Message& message) const;
  void NoteWhoIsHeard(const Message& message);
  void SayGoodBye();

  void KeepWatch();
  void Remind(Clock::time_point now);
  [[nodiscard]] bool WaitForSamples(std::chrono::milliseconds max_wait);
  void Leave();
  void MeetOthers(Clock::time_point now);
  void TellOfDiscovery(const std::string& line);

  void LookAtPeers(Clock::time_point now);

  // These are for exchanges with keys.
  void TakeUpNewKeys();
  void LeaveForNewKeys();
  void TakeRevocations();
  void TellOfWarnings(Clock::time_point now);
  void TellOfStrangers(Clock::time_point now);
  [[nodiscard]] bool IsAuthentic(const Reader& reader, dds_instance_handle_t writer,
                                 Message& message);

  DdsOptions options_;
  exchange::TopicUse use_;
  std::optional<Joined> joined_;
  std::map<exchange::Topic, std::set<route::RouteKey>> listening_;
  std::map<std::string, exchange::AgentStatus> said_;  // by instance, to be disposed of at the end
  std::uint64_t dropped_ = 0;
  bool gathers_ = false;
  std::set<Place> gathered_;  // writers that have something to flush
  Reminders reminders_;       // for a star

  NetworkWatch network_;
  ServerNames servers_;
  std::string line_;     // about the network, reported once it has joined
  std::string why_not_;  // why joining failed; empty if it did not
  Clock::time_point try_at_{};
  Clock::duration tries_again_ = kTriesAgain;
  std::uint64_t joins_ = 0;

  // The instances that were heard and are not gone.
  NewestMap<std::string, exchange::AgentGone> heard_{kMostHeard};
  // Members that were heard before this exchange left but not since, and until when they may be
  // heard again.
  std::map<std::string, std::pair<exchange::AgentGone, Clock::time_point>> missing_;
  std::vector<Message> gone_;  // for the next Take
  StarOrMesh star_or_mesh_;
  Clock::time_point look_at_{};

  CycloneWarnings warnings_;
  std::optional<KeysWatch> keys_watch_;  // with keys only
  bool keys_changed_ = false;            // since it last joined
  StrangerWatch strangers_;
  VersionWatch versions_;
  Arrivals arrivals_;
};

Result<void> DdsExchange::Open() {
  auto opened = OpenOrWait(Clock::now());
  ShowNetworkState();
  return opened;
}

Result<void> DdsExchange::OpenOrWait(Clock::time_point now) {
  network_.Begin(Interfaces(), now);
  if (network_.chosen().empty()) {
    if (!options_.waits_for_network) return Fail(ErrorCode::kUnavailable, "{}", network_.trouble());
    TellOfNetwork("waiting for the network: " + network_.trouble());
    return {};
  }
  auto joined = Join();
  if (joined || !options_.waits_for_network || joined.error().code != ErrorCode::kUnavailable) {
    return joined;
  }
  why_not_ = joined.error().message;
  TellOfNetwork("waiting for the network: " + why_not_);
  return {};
}

std::string DdsExchange::WhyNotJoined() const {
  if (joined_) return "";
  return network_.chosen().empty() ? network_.trouble() : why_not_;
}

void DdsExchange::ShowNetworkState() {
  if (options_.network_state) *options_.network_state = {WhyNotJoined(), joins_};
}

Result<void> DdsExchange::Join() {
  joined_.reset();
  const auto found = servers_.FindAll();
  const std::vector<std::string> servers = servers_.addresses();
  if (!found && (servers.empty() || !options_.waits_for_network)) return found;
  if (!found) TellOfNetwork(found.error().message + "; going by the others");
  auto joined = Joined::Open(options_, use_,
                             {.star = star_or_mesh_.star(),
                              .address = network_.chosen().front().address,
                              .servers = servers});
  if (!joined) return tl::unexpected(joined.error());
  joined_ = *std::move(joined);
  versions_.Forget();
  arrivals_.Forget();
  star_or_mesh_.Begin(Clock::now());
  if (options_.serves && !joined_->meeting.fixed_ports) {
    TellOfDiscovery(
        "another program has a route server's ports of this domain: robots that are told this "
        "machine's address do not find this server; those with multicast do");
  }
  for (const exchange::Topic topic : use_.listen) {
    if (auto opened = OpenScopes(topic); !opened) {
      joined_.reset();
      return opened;
    }
  }
  ++joins_;
  return {};
}

Result<void> DdsExchange::Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) {
  if (!use_.Listens(topic)) {
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
  if (!joined_ || !MayUse(options_, topic)) return {};
  std::set<std::string> scopes;
  for (const route::RouteKey& route : listening_[topic]) scopes.insert(ScopeOf(route));
  return joined_->Listen(topic, scopes, options_);
}

void DdsExchange::Leave() {
  reminders_.Clear();
  joined_.reset();
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
  if (!topic || !use_.Writes(*topic)) {
    return Fail(ErrorCode::kInvalidArgument, "{} was not opened for writing",
                topic ? exchange::NameOf(*topic) : "AgentGone is no topic and");
  }
  if (auto ok = exchange::CheckBounds(message); !ok) return ok;
  if (!joined_) return Fail(ErrorCode::kUnavailable, "not on the network: {}", WhyNotJoined());
  if (!MayUse(options_, *topic)) {
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
    said.star = joined_->meeting.star;
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
  for (const exchange::Topic topic : use_.write) {
    if (!exchange::IsOfRoutes(topic)) continue;
    const auto writer = joined_->WriterIn({topic, ScopeOf(route)}, options_);
    if (!writer) return tl::unexpected(writer.error());
  }
  return {};
}

Result<void> DdsExchange::Write(exchange::Topic topic, const Message& message) {
  const route::RouteKey* route = exchange::RouteOf(message);
  const Place place{topic, route == nullptr ? kEverybody : ScopeOf(*route)};
  const auto writer = joined_->WriterIn(place, options_);
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
  const bool star = joined_->meeting.star || options_.serves;
  if (star && waited_for) reminders_.NoteWritten(place, Clock::now());
  if (!written) return Wrap(written.error(), exchange::NameOf(topic));
  return {};
}

void DdsExchange::Flush() {
  gathers_ = false;
  for (const Place& place : std::exchange(gathered_, {})) joined_->writers.at(place).Flush();
}

void DdsExchange::Remind(Clock::time_point now) {
  reminders_.Tick(
      now,
      [this](const Place& place) {
        return joined_->writers.at(place).WaitForAcks(std::chrono::milliseconds(0)).has_value();
      },
      [this](const Place& place) { joined_->writers.at(place).Remind(); });
}

// Waits until something comes, or a reminder is due. A failed wait leaves nothing to take; the next
// call tries again.
bool DdsExchange::WaitForSamples(std::chrono::milliseconds max_wait) {
  const auto now = Clock::now();
  Remind(now);
  return joined_->wait_set.Wait(reminders_.Wait(now, max_wait)).has_value();
}

std::vector<Message> DdsExchange::Take(std::chrono::milliseconds max_wait) {
  KeepWatch();
  std::vector<Message> messages = std::exchange(gone_, {});
  if (!joined_) {
    std::this_thread::sleep_for(max_wait);
    return messages;
  }
  if (!WaitForSamples(max_wait)) return messages;
  for (auto& [place, reader] : joined_->readers) TakeFrom(place, reader, messages);
  TakeRevocations();
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
      status->arrival = arrivals_.Of(reader, info);
    }
    if (KeepListenedTo(place, *message) && IsAuthentic(reader, info.publication_handle, *message)) {
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
  star_or_mesh_.Hear(message);
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
  if (!joined_) return;
  auto& writers = joined_->writers;
  if (const auto agents = writers.find({exchange::Topic::kAgents}); agents != writers.end()) {
    for (const auto& [instance, status] : said_) {
      // This is best effort: without it, the others notice when the lease is over.
      (void)WithWire(status, [&](const void* sample) { return agents->second.Dispose(sample); });
    }
  }
  const auto deadline = Clock::now() + options_.close_timeout;
  for (auto& [place, writer] : writers) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    (void)writer.WaitForAcks(std::max(left, std::chrono::milliseconds(0)));
  }
}

void DdsExchange::KeepWatch() {
  const auto now = Clock::now();
  if (now < look_at_) return;
  look_at_ = now + kLookEvery;
  LookAtNetwork(now);
  if (options_.keys) TakeUpNewKeys();
  if (joined_) LookAtPeers(now);
  if (joined_) LookForServers(now);
  if (joined_ && options_.discovery != Discovery::kMesh) MeetOthers(now);
  if (!joined_ && !network_.chosen().empty() && now >= try_at_) TryToJoin(now);
  TellWhoIsMissing(now);
  ShowNetworkState();
}

// There is no good-bye, because the way to the others is gone, or soon changes.
void DdsExchange::LookAtNetwork(Clock::time_point now) {
  const NetworkWatch::Step step = network_.Look(Interfaces(), now);
  if (step == NetworkWatch::Step::kNone) return;
  Leave();
  try_at_ = {};
  why_not_.clear();
  if (step == NetworkWatch::Step::kLeave) {
    TellOfNetwork(network_.change());
  } else {
    line_ = network_.change();
  }
}

// Looks whether a server that was given by name is elsewhere now. All that was heard of it is gone
// then; the other members are told good-bye.
void DdsExchange::LookForServers(Clock::time_point now) {
  const auto hears = [this](const std::string& address) {
    return arrivals_.IsPresent(ServerAt(address, options_.domain_id));
  };
  std::string change = servers_.Look(hears, now);
  if (change.empty()) return;
  SayGoodBye();
  Leave();
  try_at_ = {};
  line_ = std::move(change);
}

void DdsExchange::TryToJoin(Clock::time_point now) {
  if (const auto joined = Join(); !joined) {
    try_at_ = now + tries_again_;
    tries_again_ = std::min<Clock::duration>(2 * tries_again_, kTriesAgainAtMost);
    const std::string& why = joined.error().message;
    if (keys_changed_) {
      keys_watch_->TellOnce("cannot join with the changed keys: " + why);
    } else if (why != why_not_) {
      TellOfNetwork("cannot join, trying again: " + why);
    }
    why_not_ = why;
    return;
  }
  tries_again_ = kTriesAgain;
  if (std::exchange(keys_changed_, false)) {
    keys_watch_->TellOnce("joined anew with the keys as they are now, and " +
                          Describe(options_.keys->revoked));
  } else if (line_.empty() && !why_not_.empty()) {
    line_ = "on the network";
  }
  if (!line_.empty()) TellOfNetwork(std::exchange(line_, {}));
  why_not_.clear();
}

void DdsExchange::TellOfNetwork(const std::string& line) {
  if (options_.tell_of_network) options_.tell_of_network(line);
}

void DdsExchange::MeetOthers(Clock::time_point now) {
  const StarOrMesh::Step step = star_or_mesh_.Look(joined_->Look(), now);
  // A call that fails is repeated later.
  if (step == StarOrMesh::Step::kCall) (void)joined_->participant.Call();
  if (step != StarOrMesh::Step::kJoinAnew) return;
  SayGoodBye();
  Leave();
  TellOfDiscovery(star_or_mesh_.star() ? "a route server is there: going by it alone"
                                       : "no route server is there: looking for everybody");
}

void DdsExchange::TellOfDiscovery(const std::string& line) {
  if (options_.tell_of_discovery) options_.tell_of_discovery(line);
}

void DdsExchange::TakeUpNewKeys() {
  if (auto keys = keys_watch_->Look(*options_.keys)) {
    options_.keys = *std::move(keys);
    LeaveForNewKeys();
  }
  if (!joined_ || std::chrono::system_clock::now() < options_.keys->expires) return;
  keys_watch_->TellOnce("the keys expired on " + security::ToText(options_.keys->expires) +
                        ": nobody believes this program any more until they are renewed");
}

void DdsExchange::LeaveForNewKeys() {
  SayGoodBye();
  Leave();
  keys_changed_ = true;
  try_at_ = {};
}

void DdsExchange::TakeRevocations() {
  if (!joined_->revocations) return;
  bool newer = false;
  for (const auto& [from, text] : joined_->revocations->Take()) {
    newer = keys_watch_->TakeList(text, from, *options_.keys) || newer;
  }
  if (!newer) return;
  LeaveForNewKeys();
  look_at_ = {};  // the next Take joins again
}

void DdsExchange::LookAtPeers(Clock::time_point now) {
  // Anything that cannot be read now will be read the next time.
  (void)joined_->peers.Look({.seen =
                                 [&](const auto& participant, const auto& said) {
                                   arrivals_.See(participant, said.address);
                                   if (options_.keys) strangers_.See(participant, said, now);
                                   versions_.See(participant, said);
                                 },
                             .proven =
                                 [&](const auto& participant) {
                                   strangers_.Prove(participant, "");
                                   versions_.Prove(participant);
                                 },
                             .gone =
                                 [&](const auto& participant) {
                                   arrivals_.Lose(participant);
                                   strangers_.Lose(participant);
                                   versions_.Lose(participant);
                                 }});
  TellOfWarnings(now);
  if (options_.keys) TellOfStrangers(now);
  for (const std::string& line : versions_.Tick(now)) {
    if (options_.tell_of_version) options_.tell_of_version(line);
  }
}

void DdsExchange::TellOfWarnings(Clock::time_point now) {
  if (!joined_->log) return;
  for (const std::string& line : joined_->log->Take()) {
    if (options_.keys && strangers_.HandleWarning(line, now)) continue;
    const std::string told = warnings_.Note(line, now);
    if (told.empty()) continue;
    if (options_.tell_of_network) {
      options_.tell_of_network("the DDS library: " + told);
    } else {
      std::fprintf(stderr, "%s\n", told.c_str());
    }
  }
}

void DdsExchange::TellOfStrangers(Clock::time_point now) {
  for (const std::string& line : strangers_.Tick(now)) {
    if (options_.tell_of_stranger) options_.tell_of_stranger(line);
  }
}

bool DdsExchange::IsAuthentic(const Reader& reader, dds_instance_handle_t writer,
                              Message& message) {
  if (!options_.keys) return true;
  const security::Member* sender = joined_->senders.Of(reader, writer);
  if (sender == nullptr) return false;
  const auto own = CheckSender(*sender, options_.keys->name_key, message);
  if (!own) {
    strangers_.HandleMisuse(fmt::format("{} {}", security::NameOf(sender->role), sender->id),
                            own.error().message, Clock::now());
  }
  return own.has_value();
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
