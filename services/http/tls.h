#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <utility>

#include "services/base/result.h"

// OpenSSL's, so that its headers are nobody else's.
struct ssl_ctx_st;

namespace trailcast::http {

// What a server shows its clients: TLS 1.2 or later. Files that are renewed are taken up while it
// serves; those that cannot be used change nothing.
class Tls {
 public:
  // PEM: the certificate, with those that lead to its authority behind it, and its key.
  // kInvalidArgument says which of them cannot be used and how both are made.
  [[nodiscard]] static Result<Tls> Load(
      const std::filesystem::path& certificate, const std::filesystem::path& key,
      std::chrono::milliseconds look_every = std::chrono::minutes(1));

  // May be called from any thread.
  [[nodiscard]] std::shared_ptr<ssl_ctx_st> Context() const;

 private:
  struct Files;
  explicit Tls(std::shared_ptr<Files> files) : files_(std::move(files)) {}

  std::shared_ptr<Files> files_;
};

}  // namespace trailcast::http
