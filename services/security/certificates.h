#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/security/documents.h"

namespace trailcast::security {

// Keys (prime256v1), certificates and revocation lists, as PEM text. Errors: kInvalidArgument for
// text that is none, kInternal for what OpenSSL refuses.

struct Identity {
  std::string certificate;
  std::string key;
};

// An authority that signs itself.
[[nodiscard]] Result<Identity> MakeAuthority(const std::string& common_name,
                                             const Validity& validity);
// A member's new key, and its certificate by the authority.
[[nodiscard]] Result<Identity> Issue(const Identity& authority, const std::string& common_name,
                                     const Validity& validity);

struct CertificateFacts {
  std::string common_name;
  std::string serial;  // hexadecimal
  Validity validity;
};
[[nodiscard]] Result<CertificateFacts> ReadCertificate(const std::string& certificate);

// True if `authority` signed the certificate; its dates are not looked at.
[[nodiscard]] Result<bool> IsSignedBy(const std::string& certificate, const std::string& authority);
// True if the key is the one in the certificate.
[[nodiscard]] Result<bool> KeyFits(const Identity& identity);

// The list of certificates that nobody shall believe any more, by serial; holds until `validity`
// ends, after which no certificate is believed at all.
[[nodiscard]] Result<std::string> MakeRevocationList(const Identity& authority,
                                                     const std::vector<std::string>& serials,
                                                     const Validity& validity);
// kCorrupt if `authority`, a certificate, did not sign it.
[[nodiscard]] Result<std::vector<std::string>> ReadRevocationList(const std::string& list,
                                                                  const std::string& authority);

}  // namespace trailcast::security
