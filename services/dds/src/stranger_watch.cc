#include "services/dds/src/stranger_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace trailcast::dds {
namespace {

// Strangers can make up any number of names.
constexpr std::size_t kMostStrangers = 1000;

// A refusal may be heard so long before its participant is seen.
constexpr std::chrono::seconds kAhead{2};

// Returns the text between two marks in a line, or nothing if they are not there.
std::optional<std::string> Between(std::string_view line, std::string_view from,
                                   std::string_view to) {
  const std::size_t begin = line.find(from);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t start = begin + from.size();
  const std::size_t end = std::min(line.find(to, start), line.size());
  return std::string(line.substr(start, end - start));
}

constexpr const char* kOtherRules = "security_attributes mismatch";

// These are OpenSSL's and Cyclone's words, and their meaning for a fleet.
constexpr std::pair<const char*, const char*> kReasons[] = {
    {"unable to get local issuer certificate", "its keys are of another authority"},
    {"certificate signature failure", "its keys are of another authority"},
    {"self-signed certificate", "its keys are of another authority"},
    {"certificate has expired", "its keys have expired"},
    {"certificate revoked", "its keys were revoked"},
    {"certificate is not yet valid", "its keys are not valid yet: are the clocks right?"},
    {"Subject name is invalid", "its permissions are not for its certificate"},
    {"Permissions validity period expired", "its permissions have expired"},
    {"denied by default rule", "its role does not allow it"},
    {kOtherRules, "it does not follow the fleet's governance"},
};

std::string Meaning(std::string_view line) {
  for (const auto& [words, meaning] : kReasons) {
    if (line.find(words) != std::string_view::npos) return meaning;
  }
  return std::string(line);
}

// Returns "b4bcbdad:8cb94d6f:9f600af6" of the GUID that follows `mark`.
std::optional<std::string> ParticipantAfter(std::string_view line, std::string_view mark) {
  const std::size_t at = line.find(mark);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view guid = line.substr(at + mark.size());
  std::size_t end = 0;
  for (int colons = 0; end < guid.size(); ++end) {
    if (guid[end] == ':' && ++colons == 3) return std::string(guid.substr(0, end));
  }
  return std::nullopt;
}

// The words before a GUID, and what they say its participant was kept from.
struct Kept {
  const char* mark;
  const char* doing;
};
constexpr Kept kKept[] = {
    {"does not allow remote writer ", "may not write "},
    {"does not allow remote reader ", "may not read "},
    {"match_remote_writer ", "may not write"},
    {"match_remote_reader ", "may not read"},
    {"does not allow remote participant ", "may not take part"},
    {"Could not get remote participant ", "may not take part"},
};

}  // namespace

void StrangerWatch::See(const std::string& participant, const Peers::SaidOfItself& said, Time now) {
  if (participants_.size() >= kMostStrangers) {
    std::erase_if(participants_, [](const auto& each) { return !each.second.proven; });
  }
  auto [at, is_new] = participants_.try_emplace(
      participant, Participant{.about = said.about, .seen_at = now, .names_itself = said.names});
  if (at->second.about.empty()) at->second.about = said.about;
}

void StrangerWatch::Prove(const std::string& participant, const std::string& about) {
  // Its writers may be known a moment before the participant itself.
  Participant& proven = participants_[participant];
  proven.proven = true;
  if (!about.empty()) proven.about = about;
}

void StrangerWatch::Lose(const std::string& participant) { participants_.erase(participant); }

bool StrangerWatch::HandleWarning(std::string_view line, Time now) {
  if (auto subject = Between(line, "; subject: /", "(code")) {
    if (subject->starts_with("CN=")) subject->erase(0, 3);  // ours begin so
    if (refused_.size() >= kMostStrangers) refused_.clear();
    refused_.try_emplace(*subject, Refused{.first_at = now}).first->second.last_at = now;
    Tell(*subject, Meaning(line), now);
    return true;
  }
  for (const Kept& kept : kKept) {
    const auto participant = ParticipantAfter(line, kept.mark);
    if (!participant) continue;
    if (const auto found = participants_.find(*participant); found != participants_.end()) {
      found->second.told = true;
    }
    // The line has "...: trailcast/routes denied by default rule(code: 1)".
    const auto topic = Between(line, ": trailcast/", " ");
    // A participant with other rules is kept from everything, which is reported once.
    const std::string from =
        line.find(kOtherRules) != std::string_view::npos
            ? ""
            : fmt::format("{}{}: ", kept.doing, topic ? "trailcast/" + *topic : "");
    Tell(Describe(*participant), from + Meaning(line), now);
    return true;
  }
  // Cyclone says this of every unknown participant, even of members that are just arriving.
  const bool is_common = line.find("onsecure") != std::string_view::npos ||
                         line.find("secure remote") != std::string_view::npos ||
                         line.find("secure participant") != std::string_view::npos;
  return is_common;
}

void StrangerWatch::HandleMisuse(const std::string& who, const std::string& why, Time now) {
  Tell(who, why, now);
}

void StrangerWatch::Tell(const std::string& who, const std::string& why, Time now) {
  if (!told_.IsDue(who + "\n" + why, now)) return;
  lines_.push_back(fmt::format("kept out: {}: {}", who, why));
}

// A certificate's owner is one of the participants that did not prove themselves. It is taken to be
// the one that was seen closest to the first refusal.
bool StrangerWatch::IsExplained(const Participant& participant) {
  for (auto& [subject, refused] : refused_) {
    if (refused.matched || refused.last_at + kAhead < participant.seen_at) continue;
    if (OwnerOf(refused) != &participant) continue;
    refused.matched = true;
    return true;
  }
  return false;
}

const StrangerWatch::Participant* StrangerWatch::OwnerOf(const Refused& refused) const {
  const Participant* owner = nullptr;
  const auto apart = [&](const Participant& one) {
    return std::chrono::abs(refused.first_at - one.seen_at);
  };
  for (const auto& [name, one] : participants_) {
    // An owner of a certificate hardly tells its name unencrypted.
    if (one.proven || one.told || one.names_itself) continue;
    if (owner == nullptr || apart(one) < apart(*owner)) owner = &one;
  }
  return owner;
}

std::string StrangerWatch::Describe(const std::string& participant) const {
  const auto found = participants_.find(participant);
  return found == participants_.end() || found->second.about.empty() ? "participant " + participant
                                                                     : found->second.about;
}

std::vector<std::string> StrangerWatch::Tick(Time now) {
  for (auto& [name, participant] : participants_) {
    if (participant.proven || participant.told || now < participant.seen_at + kPatience) continue;
    const bool explained = IsExplained(participant);
    participant.told = true;
    if (explained) continue;
    Tell(Describe(name), "has not proven that it is a member: no keys, or of another authority",
         now);
  }
  std::erase_if(refused_, [&](const auto& each) { return now >= each.second.last_at + kAgain; });
  return std::exchange(lines_, {});
}

}  // namespace trailcast::dds
