#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "services/base/result.h"
#include "services/exchange/route_exchange.h"
#include "services/security/documents.h"
#include "services/security/member.h"
#include "services/security/revocation_list.h"

namespace trailcast::security {

// A member's folder as `trailcast keys add` wrote it, looked through: what a program needs to join
// the fleet as that member.
struct MemberKeys {
  std::filesystem::path folder{};  // absolute
  std::string name{};
  std::string name_key{};  // the fleet's: which id stands for which name
  Member member{};
  Time expires{};
  bool scoped = false;       // its permissions allow partitions below its own (PartitionOf)
  bool revocations = false;  // and the topic on which servers spread revocations
  std::set<exchange::Topic> lacks{};  // topics of its role that they do not name: newer ones
  std::string authority{};            // the fleet's: its certificate, PEM
  RevocationList revoked{};           // by the authority; that of the folder, or a newer one
};

// Errors say which file is wrong, and what to do: kNotFound for what is not there, kCorrupt for
// what was not signed by the authority or does not belong together, kConflict for a folder that is
// the authority's own or is open to everybody, kUnavailable for what is not valid at `now`.
[[nodiscard]] Result<MemberKeys> LoadMemberKeys(const std::filesystem::path& folder, Time now);

// Only the name; the folder may be wrong in other ways.
[[nodiscard]] Result<std::string> NameInKeys(const std::filesystem::path& folder);

// Changes when one of the folder's files does, as after a renewal or when others are revoked.
[[nodiscard]] std::string KeysVersion(const std::filesystem::path& folder);

}  // namespace trailcast::security
