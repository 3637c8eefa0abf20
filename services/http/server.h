#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "services/base/result.h"
#include "services/http/tls.h"

namespace trailcast::http {

class Guests;
class Stream;

// Neither of a known length nor in chunks: then there is none (RFC 9112, section 6.3).
[[nodiscard]] bool BringsNoBody(const httplib::Request& request);

struct Limits {
  std::size_t threads = 2;
  std::size_t waiting = 32;  // connections beyond those that a thread has
  std::size_t body_bytes = 0;
  std::size_t of_one_address = 0;  // connections of one address, or IPv6 network; 0: any number
};

// A request that may bring more, and take longer, than others.
struct Allowance {
  std::string method{};
  std::string path{};  // begins so
  std::size_t body_bytes = 0;
  std::chrono::milliseconds patience{};  // to read it, and for the client to take its answer;
                                         // without a pause of ten seconds
};

struct Refusal {
  int status = 400;
  std::string why{};  // for people
};

// cpp-httplib's server, on threads of its own, for clients that may be anybody: one request a
// connection, bounded in bytes and time; who says nothing gives way to who does. What it serves is
// told to it before it listens.
class Server final : public httplib::Server {
 public:
  // It is told what was thrown on its threads; whoever asked was answered with 500 or hung up on.
  using Complain = std::function<void(const Error&)>;
  using Judge = std::function<std::optional<Refusal>(const httplib::Request&)>;
  using Refuse = std::function<void(const Refusal&, httplib::Response&)>;

  Server(const Limits& limits, Complain complain);
  ~Server() override;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Of each request, before its body is read; `refuse` writes the answer.
  void JudgeBy(Judge judge, Refuse refuse);

  void Allow(Allowance allowance);

  // A POST that is obeyed whatever body it comes with. In the request that `handler` is given is
  // the body if all of it came within kHurry and Limits::body_bytes, and none where it is too long,
  // too late, cut off, or multipart.
  static constexpr std::chrono::milliseconds kHurry{500};
  void PostWithAnyBody(const std::string& pattern, Handler handler);
  [[nodiscard]] bool TakesAnyBody(const httplib::Request& request) const;

  // From now on to TLS alone.
  void Speak(Tls tls) { tls_ = std::move(tls); }

  // Port 0: any that is free. kUnavailable when it cannot be listened on.
  [[nodiscard]] Result<void> Listen(const std::string& host, int port);
  [[nodiscard]] int port() const { return port_; }

 private:
  // Accepts until it is over, whatever is thrown meanwhile.
  void AcceptAll();
  void Accept();
  [[nodiscard]] bool Failed(const Result<void>& done) const;  // and complains of it
  void Answer(int socket, const std::function<void(bool)>& tell_awaited);
  void Answer(Stream& stream);
  [[nodiscard]] const Allowance* AllowanceOf(const httplib::Request& request) const;
  [[nodiscard]] std::string BodyOf(const httplib::Request& request,
                                   const httplib::ContentReader& read) const;
  [[nodiscard]] std::optional<Refusal> JudgeBody(const httplib::Request& request) const;

  const Limits limits_;
  const Complain complain_;
  std::vector<Allowance> allowances_;
  std::vector<std::regex> any_body_;  // paths
  Judge judge_;
  Refuse refuse_;
  std::optional<Tls> tls_;
  int port_ = 0;
  std::unique_ptr<Guests> guests_;
  std::atomic<bool> over_{false};
  std::thread thread_;  // accepts connections
};

}  // namespace trailcast::http
