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

// A member's folder as `trailcast keys add` wrote it, checked: everything that a program needs to
// join the fleet as that member.
struct MemberKeys {
  std::filesystem::path folder{};  // absolute
  std::string name{};
  std::string name_key{};  // the fleet's, which tells ids from names
  Member member{};
  Time expires{};
  bool scoped = false;       // its permissions allow partitions below its own (PartitionOf)
  bool revocations = false;  // and the topic on which servers distribute revocations
  std::set<exchange::Topic> lacks{};  // newer topics of its role that they do not name
  std::string authority{};            // the certificate of the fleet's authority, PEM
  RevocationList revoked{};           // signed by the authority; the folder's list, or a newer one
};

// Loads and checks a folder. Errors say which file is wrong and what to do: kNotFound for a missing
// one, kCorrupt for files that the authority did not sign or that do not belong together, kConflict
// for a folder that is the authority's own or is open to everybody, kUnavailable for one that is
// not valid at `now`.
[[nodiscard]] Result<MemberKeys> LoadMemberKeys(const std::filesystem::path& folder, Time now);

// Reads only the name; the folder may be wrong in other ways.
[[nodiscard]] Result<std::string> NameInKeys(const std::filesystem::path& folder);

// Returns a text that changes when one of the folder's files does, as after a renewal or when
// others are revoked.
[[nodiscard]] std::string KeysVersion(const std::filesystem::path& folder);

}  // namespace trailcast::security
