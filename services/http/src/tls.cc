#include "services/http/tls.h"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/stat.h>

#include <mutex>
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

Result<std::shared_ptr<SSL_CTX>> ContextOf(const std::filesystem::path& certificate,
                                           const std::filesystem::path& key) {
  ERR_clear_error();
  const std::shared_ptr<SSL_CTX> context(SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
  if (!context || SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION) != 1) {
    return Fail(ErrorCode::kInternal, "OpenSSL offers no TLS: {}", Why());
  }
  // A connection has one request, so nothing is kept for a next one or negotiated again.
  SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET |
                                         SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE |
                                         SSL_OP_PRIORITIZE_CHACHA);
  (void)SSL_CTX_set_num_tickets(context.get(), 0);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context.get(),
                   SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  // These have forward secrecy and authenticate what they encrypt.
  if (SSL_CTX_set_cipher_list(context.get(), "ECDHE+AESGCM:ECDHE+CHACHA20") != 1) {
    return Fail(ErrorCode::kInternal, "OpenSSL lacks ciphers: {}", Why());
  }
  // Other groups, above all finite fields of 8192 bits, cost this side many times what they cost a
  // client that only pretends to compute (CVE-2002-20001).
  if (SSL_CTX_set1_groups_list(context.get(), "X25519:P-256:P-384") != 1) {
    return Fail(ErrorCode::kInternal, "OpenSSL lacks curves: {}", Why());
  }
  if (SSL_CTX_use_certificate_chain_file(context.get(), certificate.c_str()) != 1) {
    return Unusable("the certificate", certificate);
  }
  if (SSL_CTX_use_PrivateKey_file(context.get(), key.c_str(), SSL_FILETYPE_PEM) != 1 ||
      SSL_CTX_check_private_key(context.get()) != 1) {
    return Unusable("the key", key);
  }
  return context;
}

// Returns a text that changes when one of the files does.
std::string VersionOf(const std::filesystem::path& certificate, const std::filesystem::path& key) {
  std::string version;
  for (const std::filesystem::path& file : {certificate, key}) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) return "";
    version += fmt::format("{}.{}.{}.{} ", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                           status.st_mtim.tv_nsec);
  }
  return version;
}

}  // namespace

struct Tls::Files {
  using Clock = std::chrono::steady_clock;

  std::filesystem::path certificate{};
  std::filesystem::path key{};
  std::chrono::milliseconds look_every{};
  std::mutex mutex{};  // guards everything below
  std::shared_ptr<SSL_CTX> context{};
  std::string version{};
  Clock::time_point look_at{};
};

Result<Tls> Tls::Load(const std::filesystem::path& certificate, const std::filesystem::path& key,
                      std::chrono::milliseconds look_every) {
  auto version = VersionOf(certificate, key);
  auto context = ContextOf(certificate, key);
  if (!context) return tl::unexpected(context.error());
  const auto files = std::make_shared<Files>();
  files->certificate = certificate;
  files->key = key;
  files->look_every = look_every;
  files->context = *std::move(context);
  files->version = std::move(version);
  files->look_at = Files::Clock::now() + look_every;
  return Tls(files);
}

std::shared_ptr<ssl_ctx_st> Tls::Context() const {
  const std::scoped_lock lock(files_->mutex);
  const auto now = Files::Clock::now();
  if (now < files_->look_at) return files_->context;
  files_->look_at = now + files_->look_every;
  std::string version = VersionOf(files_->certificate, files_->key);
  if (version == files_->version) return files_->context;
  // One file may be renewed before the other; the next call then tries again.
  if (auto context = ContextOf(files_->certificate, files_->key)) {
    files_->context = *std::move(context);
    files_->version = std::move(version);
  }
  return files_->context;
}

}  // namespace trailcast::http
