#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/security/certificates.h"
#include "services/security/documents.h"

namespace trailcast::security {

// The list of a fleet's certificates that are no longer valid: an X.509 CRL signed by its
// authority. Each list has all of them, so only the newest matters.
struct RevocationList {
  std::string text{};                  // PEM, with nothing around it
  std::uint64_t number = 0;            // rises with each list; 0 is one from before lists had
                                       // numbers
  Time issued{};                       // less the margin for slow clocks
  std::vector<std::string> serials{};  // hexadecimal
};

// Enough for some 20 000 certificates.
inline constexpr std::size_t kMaxRevocationListBytes = 1U << 20U;

// Returns a list as PEM text. It holds until `validity` ends; after that no certificate is accepted
// at all. kUnavailable means that there are too many.
[[nodiscard]] Result<std::string> MakeRevocationList(const Identity& authority,
                                                     const std::vector<std::string>& serials,
                                                     std::uint64_t number,
                                                     const Validity& validity);
// Errors: kInvalidArgument for text that is no list, or too long; kCorrupt if `authority`, a
// certificate, did not sign it.
[[nodiscard]] Result<RevocationList> ReadRevocationList(const std::string& text,
                                                        const std::string& authority);
// Reads the list in a member's folder, or the authority's own; errors name the file.
[[nodiscard]] Result<RevocationList> RevocationListIn(const std::filesystem::path& folder);

// Compares two lists of one authority.
[[nodiscard]] bool IsNewer(const RevocationList& list, const RevocationList& than);

// Returns "list 3 of revoked keys (2 certificates, 2026-11-22T16:00:00Z)".
[[nodiscard]] std::string Describe(const RevocationList& list);

// Checks a list that another member offers to one that has `held`; the same list is offered again
// and again. Errors say what is wrong and what to do: those of ReadRevocationList, kConflict for an
// older list, and kUnavailable for one issued after `now`, with which nobody would accept anybody
// until then.
[[nodiscard]] Result<RevocationList> CheckOffered(const std::string& text,
                                                  const std::string& authority,
                                                  const RevocationList& held, Time now);

// Writes the list into a member's folder, whole or not at all, unless one at least as new is there.
// kUnavailable means that it cannot be written.
[[nodiscard]] Result<void> KeepRevocationList(const std::filesystem::path& folder,
                                              const RevocationList& list);

}  // namespace trailcast::security
