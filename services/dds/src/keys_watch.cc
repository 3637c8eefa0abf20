#include "services/dds/src/keys_watch.h"

#include <fmt/format.h>

namespace trailcast::dds {
namespace {

// Copying a folder may take so long.
constexpr auto kCopying = std::chrono::seconds(10);

}  // namespace

std::optional<security::MemberKeys> KeysWatch::Look(const security::MemberKeys& held) {
  const std::string version = security::KeysVersion(held.folder);
  if (version == version_) return std::nullopt;
  auto keys = security::LoadMemberKeys(held.folder, std::chrono::system_clock::now());
  // While a folder is being copied, its files do not belong together, and the old keys stay in use.
  if (!keys || keys->name != held.name) {
    TellUnusable(version,
                 keys ? fmt::format("they are those of '{}'", keys->name) : keys.error().message);
    return std::nullopt;
  }
  if (keys->authority == held.authority && IsNewer(held.revoked, keys->revoked)) {
    if (Keep(held.revoked, held)) return std::nullopt;  // wait for the next look
    keys->revoked = held.revoked;
  }
  version_ = version;
  told_.clear();
  return *std::move(keys);
}

void KeysWatch::TellUnusable(const std::string& version, const std::string& why) {
  if (version != unusable_version_) {
    unusable_version_ = version;
    unusable_since_ = Clock::now();
  } else if (Clock::now() >= unusable_since_ + kCopying) {
    TellOnce("the keys' files changed and cannot be used, going on with the old ones: " + why);
  }
}

bool KeysWatch::TakeList(const std::string& text, const std::string& from,
                         security::MemberKeys& held) {
  auto list =
      security::CheckOffered(text, held.authority, held.revoked, std::chrono::system_clock::now());
  if (!list) {
    const std::string line = fmt::format("refused what {} sent: {}", from, list.error().message);
    if (tell_ && refused_.IsDue(line, Clock::now())) tell_(line);
    return false;
  }
  if (!IsNewer(*list, held.revoked)) return false;
  if (tell_) tell_(fmt::format("{} came from {}", Describe(*list), from));
  const bool in_use = security::KeysVersion(held.folder) == version_;
  // The change of the folder is our own, so it need not be taken up.
  if (Keep(*list, held) && in_use) version_ = security::KeysVersion(held.folder);
  held.revoked = *std::move(list);
  return true;
}

bool KeysWatch::Keep(const security::RevocationList& list, const security::MemberKeys& held) {
  const auto kept = security::KeepRevocationList(held.folder, list);
  if (!kept && tell_) {
    tell_(fmt::format("{} holds for this run alone: {}", Describe(list), kept.error().message));
  }
  return kept.has_value();
}

void KeysWatch::TellOnce(const std::string& line) {
  if (line != told_ && tell_) tell_(line);
  told_ = line;
}

}  // namespace trailcast::dds
