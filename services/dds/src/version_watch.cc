#include "services/dds/src/version_watch.h"

#include <fmt/format.h>

#include <utility>

#include "services/base/ids.h"
#include "services/base/process_name.h"
#include "services/dds/protocol_version.h"
#include "services/dds/src/domain/user_data.h"

namespace trailcast::dds {
namespace {

// Anybody on the network can make up any number of names.
constexpr std::size_t kMostVersions = 1000;

constexpr std::size_t kMostNamed = 5;

std::string Named(const std::vector<std::string>& all) {
  std::string text;
  for (std::size_t i = 0; i < all.size() && i < kMostNamed; ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", all[i]);
  }
  if (all.size() > kMostNamed) text += fmt::format(" and {} more", all.size() - kMostNamed);
  return text + (all.size() == 1 ? " speaks" : " speak");
}

std::string Line(const std::vector<std::string>& who, std::uint32_t theirs, std::uint32_t own) {
  return fmt::format(
      "{} {} of Trailcast's protocol, this program version {}: what has changed between them is "
      "not heard; update {}",
      Named(who),
      theirs < kFirstVersionSaid ? fmt::format("a version before {}", kFirstVersionSaid)
                                 : fmt::format("version {}", theirs),
      own, theirs > own ? "this program" : (who.size() == 1 ? "it" : "them"));
}

}  // namespace

VersionWatch::Participant* VersionWatch::Find(const std::string& participant) {
  if (participants_.size() >= kMostVersions && !participants_.contains(participant)) {
    return nullptr;
  }
  return &participants_[participant];
}

void VersionWatch::See(const std::string& participant, const Peers::SaidOfItself& said) {
  const bool is_ours =
      keys_ || (IsValidName(said.name) && (said.version || said.name != kRobotsEnd));
  Participant* const seen = Find(participant);
  if (seen == nullptr) return;
  // A command has its process's number in its name, but must not be reported at every call.
  std::string who = keys_ ? said.about : fmt::format("'{}'", WithoutProcess(said.name));
  seen->who = is_ours ? std::move(who) : std::string();
  seen->version = said.version.value_or(kFirstVersionSaid - 1);
}

void VersionWatch::Prove(const std::string& participant) {
  if (Participant* const proven = Find(participant); proven != nullptr) proven->proven = true;
}

void VersionWatch::Lose(const std::string& participant) { participants_.erase(participant); }

std::vector<std::string> VersionWatch::Tick(Time now) {
  std::map<std::uint32_t, std::vector<std::string>> others;
  for (const auto& [id, one] : participants_) {
    if (one.who.empty() || one.version == own_ || (keys_ && !one.proven)) continue;
    if (!told_.IsDue(fmt::format("{} {}", one.who, one.version), now)) continue;
    others[one.version].push_back(one.who);
  }
  std::vector<std::string> lines;
  for (const auto& [version, who] : others) lines.push_back(Line(who, version, own_));
  return lines;
}

}  // namespace trailcast::dds
