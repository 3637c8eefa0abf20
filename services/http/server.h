#pragma once

#include <httplib.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "services/base/result.h"

namespace trailcast::http {

struct Limits {
  std::size_t threads = 2;
  std::size_t waiting = 32;  // connections beyond those that a thread has
  std::size_t body_bytes = 0;
};

struct Refusal {
  int status = 400;
  std::string why{};  // for people
};

// cpp-httplib's server, on threads of its own, for clients that may be anybody: one request a
// connection, bounded in bytes and time. What it serves is told to it before it listens.
class Server final : public httplib::Server {
 public:
  using Judge = std::function<std::optional<Refusal>(const httplib::Request&)>;
  using Refuse = std::function<void(const Refusal&, httplib::Response&)>;

  explicit Server(const Limits& limits);
  ~Server() override;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Of each request, before its body is read; `refuse` writes the answer.
  void JudgeBy(Judge judge, Refuse refuse);

  // Port 0: any that is free. kUnavailable when it cannot be listened on.
  [[nodiscard]] Result<void> Listen(const std::string& host, int port);
  [[nodiscard]] int port() const { return port_; }

 private:
  bool process_and_close_socket(socket_t socket) override;

  Judge judge_;
  Refuse refuse_;
  int port_ = 0;
  std::thread thread_;
};

}  // namespace trailcast::http
