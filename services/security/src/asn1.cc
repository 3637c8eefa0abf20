#include "services/security/src/asn1.h"

namespace trailcast::security {

std::string Hexadecimal(const ASN1_INTEGER* number) {
  const NumberPtr parsed(ASN1_INTEGER_to_BN(number, nullptr));
  if (!parsed) return "";
  const std::unique_ptr<char, void (*)(char*)> text(BN_bn2hex(parsed.get()),
                                                    [](char* each) { OPENSSL_free(each); });
  return text ? text.get() : "";
}

IntegerPtr IntegerFrom(const std::string& hexadecimal) {
  BIGNUM* parsed = nullptr;
  if (BN_hex2bn(&parsed, hexadecimal.c_str()) == 0) return nullptr;
  const NumberPtr number(parsed);
  return IntegerPtr(BN_to_ASN1_INTEGER(number.get(), nullptr));
}

std::time_t Seconds(Time time) { return std::chrono::system_clock::to_time_t(time); }

Result<Time> FromAsn1(const ASN1_TIME* time) {
  std::tm parts{};
  if (time == nullptr || ASN1_TIME_to_tm(time, &parts) != 1) {
    return OpenSslFailed("reading the dates");
  }
  return std::chrono::system_clock::from_time_t(timegm(&parts));
}

}  // namespace trailcast::security
