#include "services/exchange/mirror.h"

#include <algorithm>
#include <utility>

#include "services/exchange/bounds.h"
#include "services/route/digest.h"
#include "services/route/info_codec.h"
#include "services/route/labels.h"

namespace trailcast::exchange {
namespace {

using route::RouteInfo;
using route::RouteKey;

constexpr std::size_t kWholeId = 32;     // digits
constexpr std::size_t kReadAtOnce = 32;  // parts of the store, in one turn of the loop

std::string TwoDigits(std::size_t part) { return fmt::format("{:02x}", part); }

// Returns the part by the two digits behind the first `at`, or nothing for what is no route's id.
std::optional<std::size_t> PartOf(const RouteId& route, std::size_t at) {
  if (route.value().size() < at + 2) return std::nullopt;
  std::size_t part = 0;
  for (const char digit : route.value().substr(at, 2)) {
    if ((digit < '0' || digit > '9') && (digit < 'a' || digit > 'f')) return std::nullopt;
    part = part * 16 + static_cast<std::size_t>(digit <= '9' ? digit - '0' : digit - 'a' + 10);
  }
  return part;
}

}  // namespace

std::uint64_t MirrorDigest(const RouteInfo& info) {
  const bool teaching = info.state == route::RouteState::kTeaching;
  RouteInfo told = info;
  if (info.standing == route::Standing::kDeleted) {
    told = RouteInfo();
    told.key = info.key;
    told.standing = route::Standing::kDeleted;
  } else if (teaching && info.segment_count == 0) {
    return 0;
  } else if (teaching) {
    told.length_m = 0.0;  // these are estimates
    told.bytes = 0;
    told.manifest_digest = {};
  }
  std::uint64_t first = 0;
  const route::Digest digest = route::Sha256(route::EncodeInfo(told));
  for (std::size_t i = 0; i < sizeof(first); ++i) first = first << 8U | digest[i];
  return std::max<std::uint64_t>(first, 1);
}

void Mirror::Handle(const Message& message, Time now) {
  if (const auto* summary = std::get_if<StoreSummary>(&message)) {
    HandleSummary(*summary, now);
  } else if (const auto* announcement = std::get_if<RouteAnnouncement>(&message)) {
    HandleAnnouncement(*announcement, now);
    if (store_.shared()) NoteStored(announcement->info.key);  // other processes put routes there
  } else {
    NoteServers(message, now);
  }
}

void Mirror::NoteServers(const Message& message, Time now) {
  const auto* status = std::get_if<AgentStatus>(&message);
  const bool of_server = status != nullptr && status->role == AgentRole::kServer;
  if (!of_server && !std::holds_alternative<AgentGone>(message)) return;
  const auto before = servers_.Names();
  servers_.Handle(message);
  const auto after = servers_.Names();
  if (before == after) return;
  const bool said_goodbye = status != nullptr && status->mode == AgentMode::kStopped;
  if (said_goodbye) others_.erase(status->agent);
  for (auto& [server, other] : others_) {
    if (after.contains(server)) continue;  // it is present once it is compared
    other.there = false;
    if (!other.differs_since) other.differs_since = now;
  }
  if (after.size() > before.size()) say_soon_ = true;
}

void Mirror::HandleSummary(const StoreSummary& summary, Time now) {
  if (summary.server == self_) return;
  if (summary.parts.empty()) {
    if (summary.prefix.empty()) return;  // of all routes, parts are told
    CompareEntries(summary, now);
    return;
  }
  if (summary.prefix.empty()) {
    if (ReadParts()) Compare(summary, parts_, now);
    return;
  }
  const auto infos = store_.FindRoutesWithin(summary.prefix);
  if (!infos) return;  // the store's trouble is reported elsewhere
  Parts ours{};
  for (const RouteInfo& info : *infos) {
    if (const auto part = PartOf(info.key.route, summary.prefix.size())) {
      ours.at(*part) ^= MirrorDigest(info);
    }
  }
  Compare(summary, ours, now);
}

void Mirror::Compare(const StoreSummary& theirs, const Parts& ours, Time now) {
  std::vector<std::size_t> differing;
  for (std::size_t i = 0; i < kParts; ++i) {
    if (theirs.parts[i] != ours.at(i)) differing.push_back(i);
  }
  if (theirs.prefix.empty()) {
    if (others_.size() < ServersThere::kMost || others_.contains(theirs.server)) {
      Other& other = others_[theirs.server];
      other.there = true;
      other.differing = differing.size();
      ++other.compared;
      if (differing.empty()) other.differs_since.reset();
      if (!differing.empty() && !other.differs_since) other.differs_since = now;
    }
    // The parts take turns, since some may differ for good, as those that a full disk lacks.
    const auto next = std::lower_bound(differing.begin(), differing.end(), first_compared_);
    std::rotate(differing.begin(), next, differing.end());
    differing.resize(std::min(differing.size(), options_.parts_at_once));
    if (!differing.empty()) first_compared_ = (differing.back() + 1) % kParts;
  }
  differing.resize(std::min(differing.size(), options_.parts_at_once));
  for (const std::size_t part : differing) Tell(theirs.prefix + TwoDigits(part), now);
}

void Mirror::CompareEntries(const StoreSummary& theirs, Time now) {
  const auto infos = store_.FindRoutesWithin(theirs.prefix);
  if (!infos) return;
  std::map<RouteKey, std::uint64_t> ours;
  for (const RouteInfo& info : *infos) {
    if (const std::uint64_t digest = MirrorDigest(info); digest != 0)
      ours.emplace(info.key, digest);
  }
  for (const StoreSummary::Entry& entry : theirs.entries) {
    const auto own = ours.find(entry.key);
    const bool same = own != ours.end() && own->second == entry.digest;
    if (!same) Want(entry.key, entry.digest, now);
    if (same) ours.erase(own);
  }
  if (!ours.empty()) Tell(theirs.prefix, now);  // the others lack something of it
}

void Mirror::Want(const RouteKey& key, std::uint64_t theirs, Time now) {
  if (under_way_.contains(key)) return;
  const Asked* asked = asked_.Find(key);
  if (asked != nullptr && asked->theirs == theirs && now < asked->next) return;
  if (wanted_.size() < options_.most_wanted) wanted_.insert_or_assign(key, theirs);
}

void Mirror::Tell(const std::string& prefix, Time now) {
  const Time* told = told_.Find(prefix);
  if (told != nullptr && now < *told + options_.part_again) return;
  const auto infos = store_.FindRoutesWithin(prefix);
  if (!infos) return;
  told_.Touch(prefix) = now;
  StoreSummary summary{.server = self_, .prefix = prefix};
  if (infos->size() <= options_.in_full || prefix.size() >= kWholeId) {
    for (const RouteInfo& info : *infos) {
      if (summary.entries.size() == kMaxEntriesTold) break;
      const std::uint64_t digest = MirrorDigest(info);
      if (digest != 0) summary.entries.push_back({info.key, digest});
    }
  } else {
    summary.parts.resize(kParts);
    for (const RouteInfo& info : *infos) {
      if (const auto part = PartOf(info.key.route, prefix.size())) {
        summary.parts[*part] ^= MirrorDigest(info);
      }
    }
  }
  out_.emplace_back(std::move(summary));
}

// A holder that announces no more than what is here has nothing more to give.
void Mirror::HandleAnnouncement(const RouteAnnouncement& announcement, Time now) {
  const auto at = under_way_.find(announcement.info.key);
  if (at == under_way_.end() || !servers_.Contains(announcement.holder)) return;
  const auto own = store_.FindRoute(at->first);
  if (!own || !*own) return;
  const auto after = route::AfterNews(**own, announcement.info);
  if (after && *after != **own) return;
  GiveUp(at->first, at->second, now);
  under_way_.erase(at);
}

void Mirror::NoteStored(const RouteKey& key) {
  if (const auto part = PartOf(key.route, 0)) unread_.set(*part);
}

std::vector<Message> Mirror::Tick(Time now) {
  if (servers_.empty()) {
    wanted_.clear();
    return std::exchange(out_, {});
  }
  See(now);
  if (now >= look_due_) {
    look_due_ = now + options_.look_every;
    unread_.set(looked_at_);
    looked_at_ = (looked_at_ + 1) % kParts;
  }
  const bool due =
      !said_at_ || now >= *said_at_ + (say_soon_ ? options_.say_at_most : options_.say_every);
  if (due && ReadParts()) {
    out_.emplace_back(
        StoreSummary{.server = self_, .prefix = "", .parts = {parts_.begin(), parts_.end()}});
    said_at_ = now;
    say_soon_ = false;
  }
  return std::exchange(out_, {});
}

bool Mirror::ReadParts() {
  std::size_t read = 0;
  for (std::size_t part = 0; part < kParts && read < kReadAtOnce && unread_.any(); ++part) {
    if (!unread_.test(part)) continue;
    const auto infos = store_.FindRoutesWithin(TwoDigits(part));
    if (!infos) return false;
    parts_.at(part) = 0;
    for (const RouteInfo& info : *infos) parts_.at(part) ^= MirrorDigest(info);
    unread_.reset(part);
    ++read;
  }
  return unread_.none();
}

// Removes routes that have come, and asks for the next ones.
void Mirror::See(Time now) {
  constexpr std::chrono::milliseconds kEvery{200};
  if (now < see_due_) return;
  see_due_ = now + kEvery;
  const bool was_busy = !under_way_.empty();
  for (auto at = under_way_.begin(); at != under_way_.end();) {
    Wanted& wanted = at->second;
    const std::uint64_t ours = OurDigest(at->first);
    if (ours != wanted.ours) {
      wanted.ours = ours;
      wanted.patient_until = now + options_.stuck_after;
    }
    if (ours == wanted.theirs) {
      asked_.Erase(at->first);
      at = under_way_.erase(at);
    } else if (now >= wanted.patient_until) {
      GiveUp(at->first, wanted, now);
      at = under_way_.erase(at);
    } else {
      ++at;
    }
  }
  while (!wanted_.empty() && under_way_.size() < options_.under_way) {
    const auto next = wanted_.extract(wanted_.begin());
    const std::uint64_t ours = OurDigest(next.key());
    if (ours == next.mapped()) continue;
    under_way_[next.key()] = {next.mapped(), ours, now + options_.answered_within};
    out_.emplace_back(SegmentRequest{.requester = self_, .key = next.key()});
    ++asked_count_;
  }
  if (was_busy && under_way_.empty()) say_soon_ = true;
}

void Mirror::GiveUp(const RouteKey& key, const Wanted& wanted, Time now) {
  Asked& asked = asked_.Touch(key);
  const bool again = asked.theirs == wanted.theirs && asked.wait.count() > 0;
  asked.wait = again ? std::min(2 * asked.wait, options_.ask_at_least) : options_.ask_again;
  asked.theirs = wanted.theirs;
  asked.next = now + asked.wait;
}

std::uint64_t Mirror::OurDigest(const RouteKey& key) {
  const auto info = store_.FindRoute(key);
  return info && *info ? MirrorDigest(**info) : 0;
}

}  // namespace trailcast::exchange
