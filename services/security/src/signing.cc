#include "services/security/src/signing.h"

#include "services/security/src/openssl_ptr.h"
#include "services/security/src/pem.h"

namespace trailcast::security {

Result<std::string> Sign(const std::string& text, const Identity& authority) {
  const auto certificate = ParseCertificate(authority.certificate);
  if (!certificate) return Wrap(certificate.error(), "the authority's certificate");
  const auto key = ParseKey(authority.key);
  if (!key) return Wrap(key.error(), "the authority's key");
  constexpr int kReadable = PKCS7_DETACHED | PKCS7_TEXT;
  const BioPtr in = ReadingFrom(text);
  const Pkcs7Ptr signature(
      PKCS7_sign(certificate->get(), key->get(), nullptr, in.get(), kReadable));
  const BioPtr again = ReadingFrom(text);
  const BioPtr out = Memory();
  if (!signature || SMIME_write_PKCS7(out.get(), signature.get(), again.get(), kReadable) != 1) {
    return OpenSslFailed("signing");
  }
  return TextIn(out.get());
}

Result<std::string> OpenSigned(const std::string& signed_text, const std::string& authority) {
  const auto certificate = ParseCertificate(authority);
  if (!certificate) return Wrap(certificate.error(), "the authority's certificate");
  const BioPtr in = ReadingFrom(signed_text);
  BIO* content = nullptr;
  const Pkcs7Ptr signature(SMIME_read_PKCS7(in.get(), &content));
  const BioPtr content_owner(content);
  if (!signature || content == nullptr) {
    ERR_clear_error();
    return Fail(ErrorCode::kCorrupt, "is no signed document");
  }
  const TrustPtr trust(X509_STORE_new());
  // Dates are checked where they matter, in the member's own certificate.
  if (!trust || X509_STORE_add_cert(trust.get(), certificate->get()) != 1 ||
      X509_STORE_set_flags(trust.get(), X509_V_FLAG_NO_CHECK_TIME) != 1) {
    return OpenSslFailed("trusting the authority");
  }
  const BioPtr out = Memory();
  if (PKCS7_verify(signature.get(), nullptr, trust.get(), content, out.get(), PKCS7_TEXT) != 1) {
    ERR_clear_error();
    return Fail(ErrorCode::kCorrupt,
                "was not signed by the fleet's authority, or was changed afterwards");
  }
  return TextIn(out.get());
}

}  // namespace trailcast::security
