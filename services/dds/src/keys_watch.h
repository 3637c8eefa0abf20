#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "services/base/told_lately.h"
#include "services/security/member_keys.h"

namespace trailcast::dds {

// Sees to it that a running program goes by its keys' folder as it is now, and by the newest list
// of revoked certificates that it has heard of. No DDS: who drives it joins anew with what it
// returns.
class KeysWatch {
 public:
  using Clock = std::chrono::steady_clock;
  using Tell = std::function<void(const std::string& line)>;

  // `tell` may be null.
  KeysWatch(const security::MemberKeys& keys, Tell tell)
      : tell_(std::move(tell)), version_(security::KeysVersion(keys.folder)) {}

  // The keys to join anew with, if the folder's files changed and can be used. The list in `held`
  // stays if it is newer than the folder's, and is written there.
  [[nodiscard]] std::optional<security::MemberKeys> Look(const security::MemberKeys& held);

  // A list of revoked certificates that `from` gave. True if it is one of the fleet's and newer
  // than the one in `held`, which then has it and is to be joined anew with. It is written into the
  // folder, too; where that cannot be written it holds for this run.
  [[nodiscard]] bool TakeList(const std::string& text, const std::string& from,
                              security::MemberKeys& held);

  // Of the keys; not twice in a row.
  void TellOnce(const std::string& line);

 private:
  [[nodiscard]] bool Keep(const security::RevocationList& list, const security::MemberKeys& held);
  void TellUnusable(const std::string& version, const std::string& why);

  Tell tell_;
  std::string version_;           // of the files in use
  std::string unusable_version_;  // of files that changed, and cannot be used
  Clock::time_point unusable_since_{};
  std::string told_;  // last
  ToldLately refused_{std::chrono::minutes(10)};
};

}  // namespace trailcast::dds
