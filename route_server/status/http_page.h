#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "services/base/result.h"

namespace trailcast::server {

// Serves GET /metrics and GET /health over HTTP, on a thread of its own. /health is 200 if Show was
// called within `stale_after` and reported no trouble, and 503 otherwise, because a server whose
// loop hangs is not well, nor is one that can serve nobody.
class HttpPage {
 public:
  // Port 0 picks any free one; `complain` is as for http::Server. kUnavailable means that it cannot
  // be listened on.
  [[nodiscard]] static Result<std::unique_ptr<HttpPage>> Open(
      const std::string& host, int port, std::function<void(const Error&)> complain,
      std::chrono::milliseconds stale_after = std::chrono::seconds(5));
  ~HttpPage();
  HttpPage(const HttpPage&) = delete;
  HttpPage& operator=(const HttpPage&) = delete;

  struct Shown {
    std::string metrics;
    std::string trouble{};   // why nobody can be served; empty if they can
    std::string degraded{};  // what is wrong although all are served
  };
  // Sets what both pages show from now on. Any thread may call it.
  void Show(Shown shown);
  [[nodiscard]] int port() const;

 private:
  struct State;
  explicit HttpPage(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::server
