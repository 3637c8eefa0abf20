#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "services/base/result.h"

namespace trailcast::server {

// GET /metrics and GET /health over HTTP, on a thread of its own. /health is 200 as long as Show
// was called within `stale_after` and told of no trouble, and 503 else: a server whose loop hangs
// is not well, nor is one that can serve nobody.
class HttpPage {
 public:
  // Port 0: any that is free; `complain`: as http::Server has it. kUnavailable when it cannot be
  // listened on.
  [[nodiscard]] static Result<std::unique_ptr<HttpPage>> Open(
      const std::string& host, int port, std::function<void(const Error&)> complain,
      std::chrono::milliseconds stale_after = std::chrono::seconds(5));
  ~HttpPage();
  HttpPage(const HttpPage&) = delete;
  HttpPage& operator=(const HttpPage&) = delete;

  struct Shown {
    std::string metrics;
    std::string trouble{};   // why nobody can be served; empty: they can
    std::string degraded{};  // what is not as it should be while all are served
  };
  // What the two say from now on. From any thread.
  void Show(Shown shown);
  [[nodiscard]] int port() const;

 private:
  struct State;
  explicit HttpPage(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::server
