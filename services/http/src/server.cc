#include "services/http/server.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "services/base/number.h"
#include "services/http/src/stream.h"
#include "services/http/src/tls_stream.h"
#include "services/http/src/workers.h"

namespace trailcast::http {
namespace {

std::string AddressOf(socket_t socket) {
  std::string address;
  int port = 0;
  Stream(socket).get_remote_ip_and_port(address, port);
  return address;
}

void RefuseInText(const Refusal& refusal, httplib::Response& response) {
  response.status = refusal.status;
  response.set_content(refusal.why + "\n", "text/plain");
}

}  // namespace

Server::Server(const Limits& limits)
    : body_bytes_(limits.body_bytes),
      refuse_(RefuseInText),
      of_one_address_(limits.of_one_address) {
  new_task_queue = [limits] { return new Workers(limits.threads, limits.waiting); };
  set_payload_max_length(body_bytes_);
  // Without SO_REUSEPORT, by which two servers would share a port and answer by turns.
  set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    auto refusal = JudgeBody(request);
    if (!refusal && judge_) refusal = judge_(request);
    if (!refusal) return HandlerResponse::Unhandled;
    refuse_(*refusal, response);
    return HandlerResponse::Handled;
  });
}

Server::~Server() {
  stop();
  if (thread_.joinable()) thread_.join();
}

void Server::JudgeBy(Judge judge, Refuse refuse) {
  judge_ = std::move(judge);
  refuse_ = std::move(refuse);
}

void Server::Allow(Allowance allowance) {
  allowances_.push_back(std::move(allowance));
  std::size_t most = body_bytes_;
  for (const Allowance& each : allowances_) most = std::max(most, each.body_bytes);
  set_payload_max_length(most);
}

const Allowance* Server::AllowanceOf(const httplib::Request& request) const {
  const auto found =
      std::find_if(allowances_.begin(), allowances_.end(), [&](const Allowance& each) {
        return request.method == each.method && request.path.starts_with(each.path);
      });
  return found == allowances_.end() ? nullptr : &*found;
}

std::optional<Refusal> Server::JudgeBody(const httplib::Request& request) const {
  // cpp-httplib reads such a body without a bound, and unpacks what is packed into any size.
  if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding")) {
    return Refusal{411,
                   "a body has to come with its length, and without Transfer-Encoding and "
                   "Content-Encoding"};
  }
  const Allowance* allowance = AllowanceOf(request);
  if (!request.has_header("Content-Length")) {
    if (allowance == nullptr || allowance->body_bytes <= body_bytes_) return std::nullopt;
    return Refusal{411, "a body has to come with its length"};
  }
  const std::size_t most = allowance == nullptr ? body_bytes_ : allowance->body_bytes;
  const auto bytes = ParseNumber<std::uint64_t>(request.get_header_value("Content-Length"));
  if (bytes && *bytes <= most) return std::nullopt;
  return Refusal{413, fmt::format("the body may have {} bytes at most", most)};
}

Result<void> Server::Listen(const std::string& host, int port) {
  if (port == 0) {
    port_ = bind_to_any_port(host);
  } else if (bind_to_port(host, port)) {
    port_ = port;
  }
  if (port_ <= 0) {
    return Fail(ErrorCode::kUnavailable,
                "cannot listen for HTTP on {}:{}; is the port taken, or the address another "
                "machine's?",
                host, port);
  }
  thread_ = std::thread([this] { listen_after_bind(); });
  // Stopped before it runs, it would run for ever.
  while (!is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return {};
}

bool Server::process_and_close_socket(socket_t socket) {
  const bool answered = Answer(socket);
  (void)shutdown(socket, SHUT_RDWR);
  (void)close(socket);
  return answered;
}

// One address does not take all threads.
bool Server::Answer(socket_t socket) {
  if (of_one_address_ == 0) return AnswerNow(socket);
  const std::string address = AddressOf(socket);
  {
    const std::scoped_lock lock(mutex_);
    std::size_t& now = answered_now_[address];
    if (now >= of_one_address_) return false;
    ++now;
  }
  const bool answered = AnswerNow(socket);
  const std::scoped_lock lock(mutex_);
  if (--answered_now_[address] == 0) answered_now_.erase(address);
  return answered;
}

bool Server::AnswerNow(socket_t socket) {
  if (!tls_) {
    Stream stream(socket);
    return AnswerNow(stream);
  }
  TlsStream stream(socket, tls_->Context().get());
  return stream.Greet() && AnswerNow(stream);
}

bool Server::AnswerNow(Stream& stream) {
  bool closed = false;
  return process_request(stream, /*close_connection=*/true, closed,
                         [&](const httplib::Request& request) {
                           const Allowance* allowance = AllowanceOf(request);
                           if (allowance == nullptr || JudgeBody(request)) return;
                           stream.Allow(allowance->body_bytes, allowance->patience);
                         });
}

}  // namespace trailcast::http
