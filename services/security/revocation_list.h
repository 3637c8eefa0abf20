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

// The list of a fleet's certificates that nobody shall believe any more: an X.509 CRL, which its
// authority signs. Each names all of them, so the newest is all that anybody needs.
struct RevocationList {
  std::string text{};                  // PEM, with nothing around it
  std::uint64_t number = 0;            // one more with each; 0: of before lists had numbers
  Time issued{};                       // less the margin for clocks that are behind
  std::vector<std::string> serials{};  // hexadecimal
};

// Some 20 000 certificates.
inline constexpr std::size_t kMaxRevocationListBytes = 1U << 20U;

// Holds until `validity` ends, after which no certificate is believed at all. As PEM text.
// kUnavailable if there are too many.
[[nodiscard]] Result<std::string> MakeRevocationList(const Identity& authority,
                                                     const std::vector<std::string>& serials,
                                                     std::uint64_t number,
                                                     const Validity& validity);
// kInvalidArgument for text that is no list, or too long; kCorrupt if `authority`, a certificate,
// did not sign it.
[[nodiscard]] Result<RevocationList> ReadRevocationList(const std::string& text,
                                                        const std::string& authority);
// In a member's folder, or the authority's own; errors name the file.
[[nodiscard]] Result<RevocationList> RevocationListIn(const std::filesystem::path& folder);

// Of one authority.
[[nodiscard]] bool IsNewer(const RevocationList& list, const RevocationList& than);

// "list 3 of revoked keys (2 certificates, 2026-11-22T16:00:00Z)"
[[nodiscard]] std::string Describe(const RevocationList& list);

// A list that another member gave to one who holds `held`; the same one comes again and again.
// Errors say what is wrong and what to do: as ReadRevocationList has them, kConflict for an older
// one, kUnavailable for one from after `now`, which would have nobody believe anybody until then.
[[nodiscard]] Result<RevocationList> CheckOffered(const std::string& text,
                                                  const std::string& authority,
                                                  const RevocationList& held, Time now);

// Puts the list into a member's folder, whole or not at all, unless one that is as new is there.
// kUnavailable if it cannot be written.
[[nodiscard]] Result<void> KeepRevocationList(const std::filesystem::path& folder,
                                              const RevocationList& list);

}  // namespace trailcast::security
