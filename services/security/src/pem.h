#pragma once

#include <string>

#include "services/base/result.h"
#include "services/security/src/openssl_ptr.h"

namespace trailcast::security {

// These return the first certificate, private key, or revocation list in PEM text. kInvalidArgument
// means that there is none. An object under a password counts as none; nobody is asked for the
// password.
[[nodiscard]] Result<CertificatePtr> ParseCertificate(const std::string& text);
[[nodiscard]] Result<KeyPtr> ParseKey(const std::string& text);
[[nodiscard]] Result<RevocationsPtr> ParseRevocations(const std::string& text);

}  // namespace trailcast::security
