#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "services/base/told_lately.h"
#include "services/security/member_keys.h"

namespace trailcast::dds {

// Keeps a running program up to date with its keys' folder, and with the newest list of revoked
// certificates that it has heard of. It knows no DDS; its caller joins again with the keys that it
// returns.
class KeysWatch {
 public:
  using Clock = std::chrono::steady_clock;
  using Tell = std::function<void(const std::string& line)>;

  // `tell` may be null.
  KeysWatch(const security::MemberKeys& keys, Tell tell)
      : tell_(std::move(tell)), version_(security::KeysVersion(keys.folder)) {}

  // Returns the keys with which to join again if the folder's files changed and can be used. The
  // list in `held` stays if it is newer than the folder's, and is then written there.
  [[nodiscard]] std::optional<security::MemberKeys> Look(const security::MemberKeys& held);

  // Takes a list of revoked certificates from `from`. Returns true if it is one of the fleet's and
  // newer than the one in `held`; it is then in `held`, with which the caller has to join again. It
  // is also written into the folder. If that cannot be written, the list holds for this run.
  [[nodiscard]] bool TakeList(const std::string& text, const std::string& from,
                              security::MemberKeys& held);

  // Leaves out a line that equals the last one.
  void TellOnce(const std::string& line);

 private:
  [[nodiscard]] bool Keep(const security::RevocationList& list, const security::MemberKeys& held);
  void TellUnusable(const std::string& version, const std::string& why);

  Tell tell_;
  std::string version_;           // of the files in use
  std::string unusable_version_;  // of changed files that cannot be used
  Clock::time_point unusable_since_{};
  std::string told_;  // the last line
  ToldLately refused_{std::chrono::minutes(10)};
};

}  // namespace trailcast::dds
