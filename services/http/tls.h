#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <utility>

#include "services/base/result.h"

// Declared here so that nobody else includes OpenSSL's headers.
struct ssl_ctx_st;

namespace trailcast::http {

// A server's certificate and key, for TLS 1.2 or later. It takes up files that are renewed while
// the server runs. Renewed files that cannot be used change nothing.
class Tls {
 public:
  // Loads PEM files: the certificate, followed by those that lead to its authority, and its key.
  // kInvalidArgument says which of them cannot be used and how both are made.
  [[nodiscard]] static Result<Tls> Load(
      const std::filesystem::path& certificate, const std::filesystem::path& key,
      std::chrono::milliseconds look_every = std::chrono::minutes(1));

  // Any thread may call this.
  [[nodiscard]] std::shared_ptr<ssl_ctx_st> Context() const;

 private:
  struct Files;
  explicit Tls(std::shared_ptr<Files> files) : files_(std::move(files)) {}

  std::shared_ptr<Files> files_;
};

}  // namespace trailcast::http
