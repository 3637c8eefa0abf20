#pragma once

#include <string>

#include "services/base/result.h"
#include "services/security/documents.h"

namespace trailcast::security {

// Keys (prime256v1) and certificates, as PEM text. Errors: kInvalidArgument for
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

}  // namespace trailcast::security
