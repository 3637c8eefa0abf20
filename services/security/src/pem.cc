#include "services/security/src/pem.h"

namespace trailcast::security {
namespace {

int NoPassword(char*, int, int, void*) { return 0; }

}  // namespace

Result<CertificatePtr> ParseCertificate(const std::string& text) {
  const BioPtr in = ReadingFrom(text);
  CertificatePtr certificate(PEM_read_bio_X509(in.get(), nullptr, NoPassword, nullptr));
  ERR_clear_error();
  if (!certificate) return Fail(ErrorCode::kInvalidArgument, "is no certificate in PEM form");
  return certificate;
}

Result<KeyPtr> ParseKey(const std::string& text) {
  const BioPtr in = ReadingFrom(text);
  KeyPtr key(PEM_read_bio_PrivateKey(in.get(), nullptr, NoPassword, nullptr));
  ERR_clear_error();
  if (!key) return Fail(ErrorCode::kInvalidArgument, "is no private key in PEM form");
  return key;
}

Result<RevocationsPtr> ParseRevocations(const std::string& text) {
  const BioPtr in = ReadingFrom(text);
  RevocationsPtr list(PEM_read_bio_X509_CRL(in.get(), nullptr, NoPassword, nullptr));
  ERR_clear_error();
  if (!list) return Fail(ErrorCode::kInvalidArgument, "is no revocation list in PEM form");
  return list;
}

}  // namespace trailcast::security
