#pragma once

#include <openssl/ssl.h>

#include <memory>

#include "services/http/src/stream.h"

namespace trailcast::http {

// Does the same over TLS. The handshake counts for the client's patience, too.
class TlsStream final : public Stream {
 public:
  TlsStream(socket_t socket, SSL_CTX* context, TellAwaited tell);
  ~TlsStream() override;
  TlsStream(const TlsStream&) = delete;
  TlsStream& operator=(const TlsStream&) = delete;

  // Returns false if the client does not speak TLS, or not in time.
  [[nodiscard]] bool Greet();

 private:
  ssize_t Get(char* to, std::size_t size) override;
  ssize_t Put(const char* from, std::size_t size) override;
  // Says, after `result`, whether what OpenSSL waits for came about.
  template <typename WaitFor>
  [[nodiscard]] bool MayGoOn(int result, const WaitFor& wait_for);

  std::unique_ptr<SSL, decltype(&SSL_free)> ssl_;
  bool is_open_ = false;
};

}  // namespace trailcast::http
