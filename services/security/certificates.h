#pragma once

#include <string>

#include "services/base/result.h"
#include "services/security/documents.h"

namespace trailcast::security {

// A key (prime256v1) and its certificate, as PEM text. Errors: kInvalidArgument for text that is
// not PEM, kInternal if OpenSSL refuses.

struct Identity {
  std::string certificate;
  std::string key;
};

// Makes an authority that signs itself.
[[nodiscard]] Result<Identity> MakeAuthority(const std::string& common_name,
                                             const Validity& validity);
// Makes a member's new key, and its certificate signed by the authority.
[[nodiscard]] Result<Identity> Issue(const Identity& authority, const std::string& common_name,
                                     const Validity& validity);

struct CertificateFacts {
  std::string common_name;
  std::string serial;  // hexadecimal
  Validity validity;
};
[[nodiscard]] Result<CertificateFacts> ReadCertificate(const std::string& certificate);

// Says whether `authority` signed the certificate. Dates are not checked.
[[nodiscard]] Result<bool> IsSignedBy(const std::string& certificate, const std::string& authority);
// Says whether the key is the certificate's.
[[nodiscard]] Result<bool> KeyFits(const Identity& identity);

}  // namespace trailcast::security
