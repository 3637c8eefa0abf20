#include "services/http/src/tls_stream.h"

#include <fcntl.h>
#include <openssl/err.h>

#include <utility>

namespace trailcast::http {

TlsStream::TlsStream(socket_t socket, SSL_CTX* context, TellAwaited tell)
    : Stream(socket, std::move(tell)), ssl_(SSL_new(context), SSL_free) {
  (void)fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
  if (ssl_) SSL_set_fd(ssl_.get(), socket);
}

TlsStream::~TlsStream() {
  // This announces the end of the stream if that is possible without waiting.
  if (is_open_) (void)SSL_shutdown(ssl_.get());
  ERR_clear_error();
}

bool TlsStream::Greet() {
  if (!ssl_) return false;
  while (!is_open_) {
    ERR_clear_error();
    const int result = SSL_accept(ssl_.get());
    is_open_ = result == 1;
    if (!is_open_ && !MayGoOn(result, [this](short events) { return WaitToRead(events); })) {
      return false;
    }
  }
  return true;
}

ssize_t TlsStream::Get(char* to, std::size_t size) {
  while (true) {
    ERR_clear_error();
    const int got = SSL_read(ssl_.get(), to, static_cast<int>(size));
    if (got > 0) return got;
    if (SSL_get_error(ssl_.get(), got) == SSL_ERROR_ZERO_RETURN) return 0;
    if (!MayGoOn(got, [this](short events) { return WaitToRead(events); })) return -1;
  }
}

ssize_t TlsStream::Put(const char* from, std::size_t size) {
  // OpenSSL takes at most so much at once.
  constexpr std::size_t kMost = 1U << 30U;
  while (is_open_) {
    ERR_clear_error();
    const int put = SSL_write(ssl_.get(), from, static_cast<int>(std::min(size, kMost)));
    if (put > 0) return put;
    if (!MayGoOn(put, [this](short events) { return WaitToWrite(events); })) return -1;
  }
  return -1;
}

template <typename WaitFor>
bool TlsStream::MayGoOn(int result, const WaitFor& wait_for) {
  const int error = SSL_get_error(ssl_.get(), result);
  if (error == SSL_ERROR_WANT_READ) return wait_for(POLLIN);
  if (error == SSL_ERROR_WANT_WRITE) return wait_for(POLLOUT);
  // OpenSSL forbids any further use after such an error.
  is_open_ = false;
  return false;
}

}  // namespace trailcast::http
