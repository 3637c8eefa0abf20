#include "services/security/certificates.h"

#include <openssl/x509v3.h>

#include <array>

#include "services/security/src/asn1.h"
#include "services/security/src/openssl_ptr.h"
#include "services/security/src/pem.h"

namespace trailcast::security {
namespace {

using ExtensionPtr = std::unique_ptr<X509_EXTENSION, Freer<X509_EXTENSION_free>>;

Result<std::string> KeyText(EVP_PKEY* key) {
  const BioPtr out = Memory();
  if (PEM_write_bio_PrivateKey(out.get(), key, nullptr, nullptr, 0, nullptr, nullptr) != 1) {
    return OpenSslFailed("writing a key");
  }
  return TextIn(out.get());
}

Result<std::string> CertificateText(X509* certificate) {
  const BioPtr out = Memory();
  if (PEM_write_bio_X509(out.get(), certificate) != 1) {
    return OpenSslFailed("writing a certificate");
  }
  return TextIn(out.get());
}

// The serial number has 127 random bits.
bool SetSerial(X509* certificate) {
  const NumberPtr number(BN_new());
  return number && BN_rand(number.get(), 127, BN_RAND_TOP_ANY, BN_RAND_BOTTOM_ANY) == 1 &&
         BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool SetName(X509* certificate, const std::string& common_name) {
  return X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_ASC,
                                    reinterpret_cast<const unsigned char*>(common_name.data()),
                                    static_cast<int>(common_name.size()), -1, 0) == 1;
}

bool SetValidity(X509* certificate, const Validity& validity) {
  return ASN1_TIME_set(X509_getm_notBefore(certificate), Seconds(validity.from)) != nullptr &&
         ASN1_TIME_set(X509_getm_notAfter(certificate), Seconds(validity.until)) != nullptr;
}

bool AddExtension(X509* certificate, int nid, const char* value) {
  const ExtensionPtr extension(X509V3_EXT_conf_nid(nullptr, nullptr, nid, value));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

// Makes a certificate signed by `issuer` with its key or, without one, by itself.
Result<Identity> Make(const std::string& common_name, const Validity& validity, X509* issuer,
                      EVP_PKEY* issuer_key) {
  const KeyPtr key(EVP_EC_gen("prime256v1"));
  const CertificatePtr certificate(X509_new());
  if (!key || !certificate) return OpenSslFailed("making a key");
  X509* const by = issuer == nullptr ? certificate.get() : issuer;
  const bool is_authority = issuer == nullptr;
  constexpr long kVersion3 = 2;
  const bool made = X509_set_version(certificate.get(), kVersion3) == 1 &&
                    SetSerial(certificate.get()) && SetName(certificate.get(), common_name) &&
                    SetValidity(certificate.get(), validity) &&
                    X509_set_issuer_name(certificate.get(), X509_get_subject_name(by)) == 1 &&
                    X509_set_pubkey(certificate.get(), key.get()) == 1 &&
                    AddExtension(certificate.get(), NID_basic_constraints,
                                 is_authority ? "critical,CA:TRUE" : "critical,CA:FALSE") &&
                    X509_sign(certificate.get(), issuer_key == nullptr ? key.get() : issuer_key,
                              EVP_sha256()) > 0;
  if (!made) return OpenSslFailed("making a certificate");
  auto certificate_text = CertificateText(certificate.get());
  if (!certificate_text) return tl::unexpected(certificate_text.error());
  auto key_text = KeyText(key.get());
  if (!key_text) return tl::unexpected(key_text.error());
  return Identity{*std::move(certificate_text), *std::move(key_text)};
}

}  // namespace

Result<Identity> MakeAuthority(const std::string& common_name, const Validity& validity) {
  return Make(common_name, validity, nullptr, nullptr);
}

Result<Identity> Issue(const Identity& authority, const std::string& common_name,
                       const Validity& validity) {
  const auto issuer = ParseCertificate(authority.certificate);
  if (!issuer) return Wrap(issuer.error(), "the authority's certificate");
  const auto key = ParseKey(authority.key);
  if (!key) return Wrap(key.error(), "the authority's key");
  return Make(common_name, validity, issuer->get(), key->get());
}

Result<CertificateFacts> ReadCertificate(const std::string& certificate) {
  const auto parsed = ParseCertificate(certificate);
  if (!parsed) return tl::unexpected(parsed.error());
  std::array<char, 256> name{};
  X509_NAME* const subject = X509_get_subject_name(parsed->get());
  if (X509_NAME_get_text_by_NID(subject, NID_commonName, name.data(), name.size()) < 0) {
    return Fail(ErrorCode::kInvalidArgument, "the certificate has no common name");
  }
  const auto from = FromAsn1(X509_get0_notBefore(parsed->get()));
  if (!from) return tl::unexpected(from.error());
  const auto until = FromAsn1(X509_get0_notAfter(parsed->get()));
  if (!until) return tl::unexpected(until.error());
  return CertificateFacts{
      name.data(), Hexadecimal(X509_get0_serialNumber(parsed->get())), {*from, *until}};
}

Result<bool> IsSignedBy(const std::string& certificate, const std::string& authority) {
  const auto parsed = ParseCertificate(certificate);
  if (!parsed) return tl::unexpected(parsed.error());
  const auto issuer = ParseCertificate(authority);
  if (!issuer) return Wrap(issuer.error(), "the authority's certificate");
  const bool is_signed = X509_check_issued(issuer->get(), parsed->get()) == X509_V_OK &&
                         X509_verify(parsed->get(), X509_get0_pubkey(issuer->get())) == 1;
  ERR_clear_error();
  return is_signed;
}

Result<bool> KeyFits(const Identity& identity) {
  const auto certificate = ParseCertificate(identity.certificate);
  if (!certificate) return tl::unexpected(certificate.error());
  const auto key = ParseKey(identity.key);
  if (!key) return tl::unexpected(key.error());
  const bool fits = X509_check_private_key(certificate->get(), key->get()) == 1;
  ERR_clear_error();
  return fits;
}

}  // namespace trailcast::security
