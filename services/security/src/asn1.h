#pragma once

#include <openssl/asn1.h>
#include <openssl/bn.h>

#include <ctime>
#include <memory>
#include <string>

#include "services/base/result.h"
#include "services/security/documents.h"
#include "services/security/src/openssl_ptr.h"

namespace trailcast::security {

// These convert the numbers and dates of certificates and revocation lists.
using NumberPtr = std::unique_ptr<BIGNUM, Freer<BN_free>>;
using IntegerPtr = std::unique_ptr<ASN1_INTEGER, Freer<ASN1_INTEGER_free>>;
using TimePtr = std::unique_ptr<ASN1_TIME, Freer<ASN1_TIME_free>>;

[[nodiscard]] std::string Hexadecimal(const ASN1_INTEGER* number);
// Returns null if the text is no hexadecimal number.
[[nodiscard]] IntegerPtr IntegerFrom(const std::string& hexadecimal);

[[nodiscard]] std::time_t Seconds(Time time);
[[nodiscard]] Result<Time> FromAsn1(const ASN1_TIME* time);

}  // namespace trailcast::security
