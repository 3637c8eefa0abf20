#include "route_server/http_page.h"

#include <mutex>
#include <thread>
#include <utility>

#include "route_server/http_stream.h"

namespace trailcast::server {

using Clock = std::chrono::steady_clock;

struct HttpPage::State {
  std::chrono::milliseconds stale_after{};
  std::mutex mutex;  // guards the next two
  Shown shown;
  Clock::time_point shown_at = Clock::now();
  int port = 0;
  HttpServer server;
  std::jthread thread;

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
    if (!shown.trouble.empty()) return "the store is away: " + shown.trouble + "\n";
    return shown.degraded.empty() ? "ok\n" : "degraded: " + shown.degraded + "\n";
  }
};

Result<std::unique_ptr<HttpPage>> HttpPage::Open(const std::string& host, int port,
                                                 std::chrono::milliseconds stale_after) {
  auto state = std::make_unique<State>();
  state->stale_after = stale_after;
  // Few and small answers: two threads do, and one that asks slowly does not keep others waiting.
  state->server.new_task_queue = [] { return new httplib::ThreadPool(2); };
  state->server.set_payload_max_length(0);
  state->Answer();
  // Without SO_REUSEPORT, by which two servers would share a port and answer by turns.
  state->server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  if (port == 0) {
    state->port = state->server.bind_to_any_port(host);
  } else if (state->server.bind_to_port(host, port)) {
    state->port = port;
  }
  if (state->port <= 0) {
    return Fail(ErrorCode::kUnavailable,
                "cannot listen for HTTP on {}:{}; is the port taken, or the address another "
                "machine's?",
                host, port);
  }
  state->thread = std::jthread([server = &state->server] { server->listen_after_bind(); });
  // Stopped before it runs, it would run for ever.
  while (!state->server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return std::unique_ptr<HttpPage>(new HttpPage(std::move(state)));
}

HttpPage::HttpPage(std::unique_ptr<State> state) : state_(std::move(state)) {}

HttpPage::~HttpPage() { state_->server.stop(); }

void HttpPage::Show(Shown shown) {
  const std::scoped_lock lock(state_->mutex);
  state_->shown = std::move(shown);
  state_->shown_at = Clock::now();
}

int HttpPage::port() const { return state_->port; }

}  // namespace trailcast::server
