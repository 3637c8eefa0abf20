#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "services/base/result.h"

namespace trailcast::server {

// GET /metrics and GET /health over HTTP, on a thread of its own. /health is 200 as long as Show
// was called within `stale_after`, and 503 from then on: a server whose loop hangs is not well.
class HttpPage {
 public:
  // Port 0: any that is free. kUnavailable when it cannot be listened on.
  [[nodiscard]] static Result<std::unique_ptr<HttpPage>> Open(
      const std::string& host, int port,
      std::chrono::milliseconds stale_after = std::chrono::seconds(5));
  ~HttpPage();
  HttpPage(const HttpPage&) = delete;
  HttpPage& operator=(const HttpPage&) = delete;

  // What /metrics says from now on. From any thread.
  void Show(std::string metrics);
  [[nodiscard]] int port() const;

 private:
  struct State;
  explicit HttpPage(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::server
