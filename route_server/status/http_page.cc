#include "route_server/status/http_page.h"

#include <mutex>
#include <utility>

#include "services/http/server.h"

namespace trailcast::server {

using Clock = std::chrono::steady_clock;

struct HttpPage::State {
  std::chrono::milliseconds stale_after{};
  std::mutex mutex;  // guards the next two
  Shown shown;
  Clock::time_point shown_at = Clock::now();
  // Answers are few and small. With two threads, a slow client does not keep others waiting.
  http::Server server;

  explicit State(http::Server::Complain complain) : server({.threads = 2}, std::move(complain)) {}

  void Answer() {
    server.Get("/metrics", [this](const httplib::Request&, httplib::Response& response) {
      const std::scoped_lock lock(mutex);
      response.set_content(shown.metrics, "text/plain; version=0.0.4");
    });
    server.Get("/health", [this](const httplib::Request&, httplib::Response& response) {
      const std::scoped_lock lock(mutex);
      const bool runs = Clock::now() < shown_at + stale_after;
      response.status = runs && shown.trouble.empty() ? 200 : 503;
      response.set_content(runs ? Health() : "the server's loop does not run\n", "text/plain");
    });
  }
  [[nodiscard]] std::string Health() const {
    if (!shown.trouble.empty()) return shown.trouble + "\n";
    return shown.degraded.empty() ? "ok\n" : "degraded: " + shown.degraded + "\n";
  }
};

Result<std::unique_ptr<HttpPage>> HttpPage::Open(const std::string& host, int port,
                                                 std::function<void(const Error&)> complain,
                                                 std::chrono::milliseconds stale_after) {
  auto state = std::make_unique<State>(std::move(complain));
  state->stale_after = stale_after;
  state->Answer();
  if (auto listens = state->server.Listen(host, port); !listens) {
    return tl::unexpected(listens.error());
  }
  return std::unique_ptr<HttpPage>(new HttpPage(std::move(state)));
}

HttpPage::HttpPage(std::unique_ptr<State> state) : state_(std::move(state)) {}

HttpPage::~HttpPage() = default;

void HttpPage::Show(Shown shown) {
  const std::scoped_lock lock(state_->mutex);
  state_->shown = std::move(shown);
  state_->shown_at = Clock::now();
}

int HttpPage::port() const { return state_->server.port(); }

}  // namespace trailcast::server
