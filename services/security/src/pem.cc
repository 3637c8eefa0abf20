#include "services/security/src/pem.h"

namespace trailcast::security {

Result<CertificatePtr> ParseCertificate(const std::string& text) {
  const BioPtr in = ReadingFrom(text);
  CertificatePtr certificate(PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr));
  ERR_clear_error();
  if (!certificate) return Fail(ErrorCode::kInvalidArgument, "is no certificate in PEM form");
  return certificate;
}

Result<KeyPtr> ParseKey(const std::string& text) {
  const BioPtr in = ReadingFrom(text);
  const auto no_password = [](char*, int, int, void*) { return 0; };
  KeyPtr key(PEM_read_bio_PrivateKey(in.get(), nullptr, no_password, nullptr));
  ERR_clear_error();
  if (!key) return Fail(ErrorCode::kInvalidArgument, "is no private key in PEM form");
  return key;
}

}  // namespace trailcast::security
