#pragma once

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>

#include <memory>
#include <string>

#include "services/base/result.h"

namespace trailcast::security {

// These own OpenSSL's objects.
template <auto Free>
struct Freer {
  template <typename T>
  void operator()(T* object) const {
    Free(object);
  }
};
using BioPtr = std::unique_ptr<BIO, Freer<BIO_free_all>>;
using KeyPtr = std::unique_ptr<EVP_PKEY, Freer<EVP_PKEY_free>>;
using CertificatePtr = std::unique_ptr<X509, Freer<X509_free>>;
using RevocationsPtr = std::unique_ptr<X509_CRL, Freer<X509_CRL_free>>;
using TrustPtr = std::unique_ptr<X509_STORE, Freer<X509_STORE_free>>;
using Pkcs7Ptr = std::unique_ptr<PKCS7, Freer<PKCS7_free>>;

// Returns kInternal with OpenSSL's reason, and clears OpenSSL's errors.
[[nodiscard]] inline tl::unexpected<Error> OpenSslFailed(const char* doing) {
  const unsigned long code = ERR_peek_last_error();
  const char* reason = code == 0 ? nullptr : ERR_reason_error_string(code);
  ERR_clear_error();
  return Fail(ErrorCode::kInternal, "{}: {}", doing, reason == nullptr ? "refused" : reason);
}

[[nodiscard]] inline BioPtr ReadingFrom(const std::string& text) {
  return BioPtr(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}
[[nodiscard]] inline BioPtr Memory() { return BioPtr(BIO_new(BIO_s_mem())); }
[[nodiscard]] inline std::string TextIn(BIO* memory) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(memory, &data);
  return {data, static_cast<std::size_t>(size)};
}

}  // namespace trailcast::security
