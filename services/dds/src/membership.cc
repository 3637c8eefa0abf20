#include "services/dds/src/membership.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

#include "services/dds/src/domain/cyclone_uri.h"
#include "services/dds/src/domain/discovery_config.h"
#include "services/dds/src/domain/interfaces.h"
#include "services/dds/src/senders.h"

namespace trailcast::dds {
namespace {

// The network, the keys' folder and the present members are checked this often.
constexpr auto kLookEvery = std::chrono::seconds(1);

// Joining is tried again this soon. Looking up a name's address may take seconds.
constexpr auto kTriesAgain = std::chrono::seconds(1);
constexpr auto kTriesAgainAtMost = std::chrono::seconds(8);

NetworkWatch WatchFor(const DdsOptions& options) {
  const bool cyclone = options.network_interface.empty() && ChoosesInterfaces(UriXml(CycloneUri()));
  return NetworkWatch(options.network_interface,
                      cyclone ? NetworkWatch::By::kCyclone : NetworkWatch::By::kOne);
}

double RandomShare() {
  std::random_device random;
  return std::uniform_real_distribution<double>(0.0, 1.0)(random);
}

}  // namespace

Membership::Membership(const DdsOptions& options, exchange::TopicUse use, Hooks hooks)
    : options_(options),
      use_(std::move(use)),
      hooks_(std::move(hooks)),
      network_(WatchFor(options)),
      servers_(options.server_addresses),
      tries_again_(kTriesAgain),
      star_or_mesh_(options.discovery, RandomShare()),
      versions_(options.protocol_version, options.keys.has_value()) {
  if (options_.keys) keys_watch_.emplace(*options_.keys, options_.tell_of_stranger);
}

Result<void> Membership::Open() {
  auto opened = OpenOrWait(Clock::now());
  ShowNetworkState();
  return opened;
}

Result<void> Membership::OpenOrWait(Clock::time_point now) {
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

std::string Membership::WhyNotJoined() const {
  if (joined_) return "";
  return network_.chosen().empty() ? network_.trouble() : why_not_;
}

void Membership::ShowNetworkState() {
  if (options_.network_state) *options_.network_state = {WhyNotJoined(), joins_};
}

Result<void> Membership::Join() {
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
  if (auto opened = hooks_.joined(); !opened) {
    joined_.reset();
    return opened;
  }
  ++joins_;
  return {};
}

void Membership::Leave() {
  hooks_.leaves();
  joined_.reset();
}

void Membership::KeepWatch() {
  const auto now = Clock::now();
  if (now < look_at_) return;
  look_at_ = now + kLookEvery;
  LookAtNetwork(now);
  if (options_.keys) TakeUpNewKeys();
  if (joined_) LookAtPeers(now);
  if (joined_) LookForServers(now);
  if (joined_ && options_.discovery != Discovery::kMesh) MeetOthers(now);
  if (!joined_ && !network_.chosen().empty() && now >= try_at_) TryToJoin(now);
  ShowNetworkState();
}

// There is no good-bye, because the way to the others is gone, or soon changes.
void Membership::LookAtNetwork(Clock::time_point now) {
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
void Membership::LookForServers(Clock::time_point now) {
  const auto hears = [this](const std::string& address) {
    return arrivals_.IsPresent(ServerAt(address, options_.domain_id));
  };
  std::string change = servers_.Look(hears, now);
  if (change.empty()) return;
  hooks_.says_good_bye();
  Leave();
  try_at_ = {};
  line_ = std::move(change);
}

void Membership::TryToJoin(Clock::time_point now) {
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

void Membership::TellOfNetwork(const std::string& line) {
  if (options_.tell_of_network) options_.tell_of_network(line);
}

void Membership::MeetOthers(Clock::time_point now) {
  const StarOrMesh::Step step = star_or_mesh_.Look(joined_->Look(), now);
  // A call that fails is repeated later.
  if (step == StarOrMesh::Step::kCall) (void)joined_->participant.Call();
  if (step != StarOrMesh::Step::kJoinAnew) return;
  hooks_.says_good_bye();
  Leave();
  TellOfDiscovery(star_or_mesh_.star() ? "a route server is there: going by it alone"
                                       : "no route server is there: looking for everybody");
}

void Membership::TellOfDiscovery(const std::string& line) {
  if (options_.tell_of_discovery) options_.tell_of_discovery(line);
}

void Membership::TakeUpNewKeys() {
  if (auto keys = keys_watch_->Look(*options_.keys)) {
    options_.keys = *std::move(keys);
    LeaveForNewKeys();
  }
  if (!joined_ || std::chrono::system_clock::now() < options_.keys->expires) return;
  keys_watch_->TellOnce("the keys expired on " + security::ToText(options_.keys->expires) +
                        ": nobody believes this program any more until they are renewed");
}

void Membership::LeaveForNewKeys() {
  hooks_.says_good_bye();
  Leave();
  keys_changed_ = true;
  try_at_ = {};
}

void Membership::TakeRevocations() {
  if (!joined_->revocations) return;
  bool newer = false;
  for (const auto& [from, text] : joined_->revocations->Take()) {
    newer = keys_watch_->TakeList(text, from, *options_.keys) || newer;
  }
  if (!newer) return;
  LeaveForNewKeys();
  look_at_ = {};  // the next Take joins again
}

void Membership::LookAtPeers(Clock::time_point now) {
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

void Membership::TellOfWarnings(Clock::time_point now) {
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

void Membership::TellOfStrangers(Clock::time_point now) {
  for (const std::string& line : strangers_.Tick(now)) {
    if (options_.tell_of_stranger) options_.tell_of_stranger(line);
  }
}

bool Membership::IsAuthentic(const Reader& reader, dds_instance_handle_t writer,
                             exchange::Message& message) {
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

}  // namespace trailcast::dds
