#pragma once

#include <string>

#include "services/base/result.h"
#include "services/security/src/openssl_ptr.h"

namespace trailcast::security {

// The first certificate, private key, or revocation list in PEM text. kInvalidArgument when there
// is none; what is under a password counts as none, and nobody is asked for it.
[[nodiscard]] Result<CertificatePtr> ParseCertificate(const std::string& text);
[[nodiscard]] Result<KeyPtr> ParseKey(const std::string& text);
[[nodiscard]] Result<RevocationsPtr> ParseRevocations(const std::string& text);

}  // namespace trailcast::security
