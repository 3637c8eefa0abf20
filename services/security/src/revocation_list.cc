#include "services/security/revocation_list.h"

#include <fmt/format.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <tuple>

#include "services/base/durable_file.h"
#include "services/security/folder_layout.h"
#include "services/security/src/asn1.h"
#include "services/security/src/files.h"
#include "services/security/src/pem.h"

namespace trailcast::security {
namespace {

using RevokedPtr = std::unique_ptr<X509_REVOKED, Freer<X509_REVOKED_free>>;

bool AddRevoked(X509_CRL* list, const std::string& serial, ASN1_TIME* since) {
  const IntegerPtr integer = IntegerFrom(serial);
  RevokedPtr revoked(X509_REVOKED_new());
  if (!integer || !revoked || X509_REVOKED_set_serialNumber(revoked.get(), integer.get()) != 1 ||
      X509_REVOKED_set_revocationDate(revoked.get(), since) != 1 ||
      X509_CRL_add0_revoked(list, revoked.get()) != 1) {
    return false;
  }
  (void)revoked.release();  // the list owns it now
  return true;
}

bool SetNumber(X509_CRL* list, std::uint64_t number) {
  const IntegerPtr integer(ASN1_INTEGER_new());
  return integer && ASN1_INTEGER_set_uint64(integer.get(), number) == 1 &&
         X509_CRL_add1_ext_i2d(list, NID_crl_number, integer.get(), 0, 0) == 1;
}

// Returns 0 if it has no number.
Result<std::uint64_t> NumberOf(const X509_CRL* list) {
  int found = 0;
  const IntegerPtr integer(
      static_cast<ASN1_INTEGER*>(X509_CRL_get_ext_d2i(list, NID_crl_number, &found, nullptr)));
  constexpr int kNone = -1;
  if (!integer && found == kNone) return 0;
  std::uint64_t number = 0;
  const bool fits = integer && ASN1_INTEGER_get_uint64(&number, integer.get()) == 1;
  ERR_clear_error();
  if (!fits) return Fail(ErrorCode::kInvalidArgument, "has a number that is none");
  return number;
}

std::vector<std::string> SerialsIn(X509_CRL* list) {
  std::vector<std::string> serials;
  const STACK_OF(X509_REVOKED)* revoked = X509_CRL_get_REVOKED(list);
  const int count = std::max(0, sk_X509_REVOKED_num(revoked));  // -1 means that there is none
  serials.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    serials.push_back(
        Hexadecimal(X509_REVOKED_get0_serialNumber(sk_X509_REVOKED_value(revoked, i))));
  }
  return serials;
}

Result<std::string> TextOf(X509_CRL* list) {
  const BioPtr out = Memory();
  if (PEM_write_bio_X509_CRL(out.get(), list) != 1) {
    return OpenSslFailed("writing the list of revoked certificates");
  }
  return TextIn(out.get());
}

}  // namespace

Result<std::string> MakeRevocationList(const Identity& authority,
                                       const std::vector<std::string>& serials,
                                       std::uint64_t number, const Validity& validity) {
  const auto issuer = ParseCertificate(authority.certificate);
  if (!issuer) return Wrap(issuer.error(), "the authority's certificate");
  const auto key = ParseKey(authority.key);
  if (!key) return Wrap(key.error(), "the authority's key");
  const RevocationsPtr list(X509_CRL_new());
  const TimePtr from(ASN1_TIME_set(nullptr, Seconds(validity.from)));
  const TimePtr until(ASN1_TIME_set(nullptr, Seconds(validity.until)));
  constexpr long kVersion2 = 1;
  bool made = list && from && until && X509_CRL_set_version(list.get(), kVersion2) == 1 &&
              X509_CRL_set_issuer_name(list.get(), X509_get_subject_name(issuer->get())) == 1 &&
              X509_CRL_set1_lastUpdate(list.get(), from.get()) == 1 &&
              X509_CRL_set1_nextUpdate(list.get(), until.get()) == 1 &&
              SetNumber(list.get(), number);
  for (const std::string& serial : serials) {
    made = made && AddRevoked(list.get(), serial, from.get());
  }
  made = made && X509_CRL_sort(list.get()) == 1 &&
         X509_CRL_sign(list.get(), key->get(), EVP_sha256()) > 0;
  if (!made) return OpenSslFailed("making the list of revoked certificates");
  auto text = TextOf(list.get());
  if (text && text->size() > kMaxRevocationListBytes) {
    return Fail(
        ErrorCode::kUnavailable,
        "{} revoked certificates are more than a list holds ({} bytes): make a new authority "
        "with 'trailcast keys init', and keys for every member with it",
        serials.size(), kMaxRevocationListBytes);
  }
  return text;
}

Result<RevocationList> ReadRevocationList(const std::string& text, const std::string& authority) {
  if (text.size() > kMaxRevocationListBytes) {
    return Fail(ErrorCode::kInvalidArgument, "is longer than {} bytes", kMaxRevocationListBytes);
  }
  const auto parsed = ParseRevocations(text);
  if (!parsed) return tl::unexpected(parsed.error());
  const auto issuer = ParseCertificate(authority);
  if (!issuer) return Wrap(issuer.error(), "the authority's certificate");
  const bool is_signed = X509_CRL_verify(parsed->get(), X509_get0_pubkey(issuer->get())) == 1;
  ERR_clear_error();
  if (!is_signed) return Fail(ErrorCode::kCorrupt, "was not signed by the fleet's authority");
  const auto number = NumberOf(parsed->get());
  if (!number) return tl::unexpected(number.error());
  const auto issued = FromAsn1(X509_CRL_get0_lastUpdate(parsed->get()));
  if (!issued) return tl::unexpected(issued.error());
  auto written = TextOf(parsed->get());
  if (!written) return tl::unexpected(written.error());
  return RevocationList{*std::move(written), *number, *issued, SerialsIn(parsed->get())};
}

Result<RevocationList> RevocationListIn(const std::filesystem::path& folder) {
  const auto authority = ReadSmallFile(folder / kAuthorityFile);
  if (!authority) return tl::unexpected(authority.error());
  const auto text = ReadSmallFile(folder / kRevokedFile);
  if (!text) return tl::unexpected(text.error());
  auto list = ReadRevocationList(*text, *authority);
  if (!list) return Wrap(list.error(), (folder / kRevokedFile).string());
  return list;
}

bool IsNewer(const RevocationList& list, const RevocationList& than) {
  return std::tie(list.number, list.issued) > std::tie(than.number, than.issued);
}

std::string Describe(const RevocationList& list) {
  return fmt::format("list {} of revoked keys ({} certificate{}, {})", list.number,
                     list.serials.size(), list.serials.size() == 1 ? "" : "s", ToText(list.issued));
}

Result<RevocationList> CheckOffered(const std::string& text, const std::string& authority,
                                    const RevocationList& held, Time now) {
  auto list = ReadRevocationList(text, authority);
  if (!list) return Wrap(list.error(), "the list of revoked keys");
  if (IsNewer(held, *list)) {
    return Fail(
        ErrorCode::kConflict,
        "{} is older than {}, which is held here: copy revoked.pem from where the authority "
        "is into the server's keys",
        Describe(*list), Describe(held));
  }
  if (list->issued > now) {
    return Fail(ErrorCode::kUnavailable,
                "{} is from after now, {} by this machine's clock: set the clock", Describe(*list),
                ToText(now));
  }
  return list;
}

Result<void> KeepRevocationList(const std::filesystem::path& folder, const RevocationList& list) {
  // Several programs may use one folder.
  const auto there = RevocationListIn(folder);
  if (there && !IsNewer(list, *there)) return {};
  return ReplaceFile(folder / kRevokedFile, list.text, kForEverybody);
}

}  // namespace trailcast::security
