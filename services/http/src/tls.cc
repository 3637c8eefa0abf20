#include "services/http/tls.h"

#include <openssl/err.h>
#include <openssl/ssl.h>

#include <string>
#include <utility>

namespace trailcast::http {
namespace {

std::string Why() {
  const unsigned long first = ERR_get_error();
  ERR_clear_error();
  const char* reason = ERR_reason_error_string(first);
  return reason != nullptr ? reason : "OpenSSL does not say why";
}

tl::unexpected<Error> Unusable(const char* what, const std::filesystem::path& file) {
  return Fail(
      ErrorCode::kInvalidArgument,
      "{} in {} cannot be used ({}). One for tries, which browsers warn of: openssl req "
      "-x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 365 -subj /CN=$HOSTNAME "
      "-addext subjectAltName=DNS:$HOSTNAME -keyout tls.key -out tls.pem",
      what, file.string(), Why());
}

}  // namespace

Result<Tls> Tls::Load(const std::filesystem::path& certificate, const std::filesystem::path& key) {
  ERR_clear_error();
  const std::shared_ptr<SSL_CTX> context(SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
  if (!context || SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION) != 1) {
    return Fail(ErrorCode::kInternal, "OpenSSL offers no TLS: {}", Why());
  }
  // A connection has one request: nothing is to be kept for a next one, or agreed upon anew.
  SSL_CTX_set_options(context.get(),
                      SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET | SSL_OP_NO_COMPRESSION);
  (void)SSL_CTX_set_num_tickets(context.get(), 0);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context.get(),
                   SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  // Forward secrecy, and ciphers that vouch for what they carry.
  if (SSL_CTX_set_cipher_list(context.get(), "ECDHE+AESGCM:ECDHE+CHACHA20") != 1) {
    return Fail(ErrorCode::kInternal, "OpenSSL lacks ciphers: {}", Why());
  }
  if (SSL_CTX_use_certificate_chain_file(context.get(), certificate.c_str()) != 1) {
    return Unusable("the certificate", certificate);
  }
  if (SSL_CTX_use_PrivateKey_file(context.get(), key.c_str(), SSL_FILETYPE_PEM) != 1 ||
      SSL_CTX_check_private_key(context.get()) != 1) {
    return Unusable("the key", key);
  }
  return Tls(context);
}

}  // namespace trailcast::http
