#pragma once

#include <filesystem>
#include <memory>

#include "services/base/result.h"

// OpenSSL's, so that its headers are nobody else's.
struct ssl_ctx_st;

namespace trailcast::http {

// What a server shows its clients: TLS 1.2 or later.
class Tls {
 public:
  // PEM: the certificate, with those that lead to its authority behind it, and its key.
  // kInvalidArgument says which of them cannot be used and how both are made.
  [[nodiscard]] static Result<Tls> Load(const std::filesystem::path& certificate,
                                        const std::filesystem::path& key);

  [[nodiscard]] ssl_ctx_st* context() const { return context_.get(); }

 private:
  explicit Tls(std::shared_ptr<ssl_ctx_st> context) : context_(std::move(context)) {}

  std::shared_ptr<ssl_ctx_st> context_;
};

}  // namespace trailcast::http
