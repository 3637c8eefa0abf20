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

// Says whether a request has no body: it has neither a length nor chunks (RFC 9112, section 6.3).
[[nodiscard]] bool BringsNoBody(const httplib::Request& request);

struct Limits {
  std::size_t threads = 2;
  std::size_t waiting = 32;  // connections without a thread
  std::size_t body_bytes = 0;
  std::size_t of_one_address = 0;  // connections of one address, or IPv6 network; 0 allows any
                                   // number
};

// A kind of request that may have more bytes, and take longer, than others.
struct Allowance {
  std::string method{};
  std::string path{};  // how it begins
  std::size_t body_bytes = 0;
  std::chrono::milliseconds patience{};  // time to read it, and for the client to take its answer,
                                         // without a pause of ten seconds
};

struct Refusal {
  int status = 400;
  std::string why{};  // for people
};

// cpp-httplib's server on threads of its own, for clients that may be anybody. A connection has one
// request, bounded in bytes and time, and silent clients give way to those that speak. Handlers see
// one form of each path: without the host, with single slashes, and with none at the end. A method
// in lower case is taken, too. All handlers must be set before it listens.
class Server final : public httplib::Server {
 public:
  // Called with each exception on the server's threads. Its client was answered with 500 or
  // disconnected.
  using Complain = std::function<void(const Error&)>;
  using Judge = std::function<std::optional<Refusal>(const httplib::Request&)>;
  using Refuse = std::function<void(const Refusal&, httplib::Response&)>;

  Server(const Limits& limits, Complain complain);
  ~Server() override;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Judges each request before its body is read; `refuse` writes the answer.
  void JudgeBy(Judge judge, Refuse refuse);

  void Allow(Allowance allowance);

  // Handles a POST that is obeyed whatever its body is, and in upper case, too, but for the groups
  // of the pattern. `handler` gets a request with the body if
  // all of it came within kHurry and Limits::body_bytes. A body that is too long, too late, cut off
  // or multipart is left out.
  static constexpr std::chrono::milliseconds kHurry{500};
  void PostWithAnyBody(const std::string& pattern, Handler handler);
  [[nodiscard]] bool TakesAnyBody(const httplib::Request& request) const;

  // Makes the server speak TLS only.
  void Speak(Tls tls) { tls_ = std::move(tls); }

  // Listens on a port; 0 picks any free one. kUnavailable means that it cannot be listened on.
  [[nodiscard]] Result<void> Listen(const std::string& host, int port);
  [[nodiscard]] int port() const { return port_; }

 private:
  // Accepts connections until the server stops, whatever is thrown meanwhile.
  void AcceptAll();
  void Accept();
  [[nodiscard]] bool Failed(const Result<void>& done) const;  // reports an error, too
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
