#include "services/http/server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <exception>
#include <string_view>
#include <utility>

#include "services/base/guarded.h"
#include "services/base/number.h"
#include "services/http/address.h"
#include "services/http/door.h"
#include "services/http/src/guests.h"
#include "services/http/src/stream.h"
#include "services/http/src/tls_stream.h"

namespace trailcast::http {
namespace {

constexpr int kBacklog = 512;
constexpr int kLook_ms = 100;

std::string AddressOf(int socket) {
  std::string address;
  int port = 0;
  Stream(socket).get_remote_ip_and_port(address, port);
  return AddressKey(address);
}

// Brings the path into its one form. An absolute address (RFC 9112, section 3.2.2) is split into
// host and path; parts are divided by one slash, and none is at the end.
void Canonicalize(httplib::Request& request) {
  std::string path = request.path;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!Lower(path.substr(0, scheme.size())).starts_with(scheme)) continue;
    const std::size_t slash = std::min(path.find('/', scheme.size()), path.size());
    request.headers.erase("Host");
    request.headers.emplace("Host", path.substr(scheme.size(), slash - scheme.size()));
    path.erase(0, slash);
  }
  const auto both_slashes = [](char a, char b) { return a == '/' && b == '/'; };
  path.erase(std::unique(path.begin(), path.end(), both_slashes), path.end());
  if (path.size() > 1 && path.back() == '/') path.pop_back();
  request.path = path.empty() ? "/" : path;
}

// Writes in lower case what is not a group of the pattern.
std::string InLowerCase(const std::string& path, const std::smatch& match) {
  std::string folded = Lower(path);
  for (std::size_t i = 1; i < match.size(); ++i) {
    if (!match[i].matched) continue;
    const auto at = static_cast<std::size_t>(match.position(i));
    folded.replace(at, match[i].str().size(), match[i].str());
  }
  return folded;
}

void RefuseInText(const Refusal& refusal, httplib::Response& response) {
  response.status = refusal.status;
  response.set_content(refusal.why + "\n", "text/plain");
}

}  // namespace

bool BringsNoBody(const httplib::Request& request) {
  return !request.has_header("Transfer-Encoding") &&
         (!request.has_header("Content-Length") ||
          request.get_header_value("Content-Length") == "0");
}

Server::Server(const Limits& limits, Complain complain)
    : limits_(limits), complain_(std::move(complain)), refuse_(RefuseInText) {
  set_payload_max_length(limits_.body_bytes);
  // SO_REUSEPORT is left out, because two servers would share a port with it and answer by turns.
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
  set_exception_handler([this](const httplib::Request& request, httplib::Response& response,
                               const std::exception_ptr& thrown) {
    (void)Failed(Guarded("answering " + request.path, [&] { std::rethrow_exception(thrown); }));
    refuse_({500, "this is a fault of the program: its log says what has failed"}, response);
  });
}

bool Server::Failed(const Result<void>& done) const {
  if (!done) complain_(done.error());
  return !done;
}

Server::~Server() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
  if (svr_sock_ != INVALID_SOCKET) (void)close(svr_sock_);
}

void Server::JudgeBy(Judge judge, Refuse refuse) {
  judge_ = std::move(judge);
  refuse_ = std::move(refuse);
}

void Server::Allow(Allowance allowance) {
  allowances_.push_back(std::move(allowance));
  std::size_t most = limits_.body_bytes;
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

void Server::PostWithAnyBody(const std::string& pattern, Handler handler) {
  any_body_.emplace_back(pattern, std::regex::ECMAScript | std::regex::icase);
  Post(pattern, [this, handler = std::move(handler)](const httplib::Request& request,
                                                     httplib::Response& response,
                                                     const httplib::ContentReader& read) {
    httplib::Request whole = request;
    whole.body = BodyOf(request, read);
    handler(whole, response);
  });
}

bool Server::TakesAnyBody(const httplib::Request& request) const {
  return request.method == "POST" &&
         std::any_of(any_body_.begin(), any_body_.end(), [&](const std::regex& pattern) {
           return std::regex_match(request.path, pattern);
         });
}

std::string Server::BodyOf(const httplib::Request& request,
                           const httplib::ContentReader& read) const {
  const auto length = ParseNumber<std::uint64_t>(request.get_header_value("Content-Length"));
  const bool is_bounded = length && *length <= limits_.body_bytes;
  const bool in_chunks = Lower(request.get_header_value("Transfer-Encoding")) == "chunked";
  if (BringsNoBody(request) || request.is_multipart_form_data() || !(is_bounded || in_chunks)) {
    return {};
  }
  std::string body;
  const bool is_whole = read([&](const char* bytes, std::size_t size) {
    if (size > limits_.body_bytes - body.size()) return false;
    body.append(bytes, size);
    return true;
  });
  return is_whole ? body : std::string();
}

std::optional<Refusal> Server::JudgeBody(const httplib::Request& request) const {
  if (TakesAnyBody(request)) return std::nullopt;
  // cpp-httplib reads such a body without a bound, and unpacks compressed ones to any size.
  if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding")) {
    return Refusal{411,
                   "a body has to come with its length, and without Transfer-Encoding and "
                   "Content-Encoding"};
  }
  const Allowance* allowance = AllowanceOf(request);
  if (!request.has_header("Content-Length")) {
    if (allowance == nullptr || allowance->body_bytes <= limits_.body_bytes) return std::nullopt;
    return Refusal{411, "a body has to come with its length"};
  }
  const std::size_t most = allowance == nullptr ? limits_.body_bytes : allowance->body_bytes;
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
  // cpp-httplib listens with room for five; more clients would retry a second later.
  (void)::listen(svr_sock_, kBacklog);
  (void)fcntl(svr_sock_, F_SETFL, fcntl(svr_sock_, F_GETFL) | O_NONBLOCK);
  guests_ = std::make_unique<Guests>(limits_, [this](Guests::Guest& guest) {
    (void)Failed(Guarded("a thread that answers requests", [&] {
      Answer(guest.socket, [&](bool awaited) { guests_->Await(guest, awaited); });
    }));
  });
  thread_ = std::thread([this] { AcceptAll(); });
  return {};
}

void Server::AcceptAll() {
  while (!over_) {
    const bool failed = Failed(Guarded("the thread that takes connections", [this] { Accept(); }));
    if (failed) std::this_thread::sleep_for(std::chrono::milliseconds(kLook_ms));
  }
}

void Server::Accept() {
  pollfd waited{.fd = svr_sock_, .events = POLLIN, .revents = 0};
  const bool comes = poll(&waited, 1, kLook_ms) > 0;
  guests_->MakeRoom();
  if (!comes) return;
  const int socket = accept4(svr_sock_, nullptr, nullptr, SOCK_CLOEXEC);
  if (socket >= 0) {
    guests_->Take(socket, AddressOf(socket));
  } else if (errno == EMFILE || errno == ENFILE) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kLook_ms));
  }
}

// `tell_awaited` is called when the server begins or ceases to wait for the client.
void Server::Answer(int socket, const std::function<void(bool)>& tell_awaited) {
  if (!tls_) {
    Stream stream(socket, tell_awaited);
    return Answer(stream);
  }
  TlsStream stream(socket, tls_->Context().get(), tell_awaited);
  if (stream.Greet()) Answer(stream);
}

void Server::Answer(Stream& stream) {
  bool closed = false;
  (void)process_request(stream, /*close_connection=*/true, closed, [&](httplib::Request& request) {
    // Nobody needs parts of an answer, and a request of 8 kB can ask for the whole answer a
    // thousand times.
    request.ranges.clear();
    Canonicalize(request);
    for (const std::regex& pattern : any_body_) {
      std::smatch match;
      if (!std::regex_match(request.path, match, pattern)) continue;
      request.path = InLowerCase(request.path, match);
      break;
    }
    const Allowance* allowance = AllowanceOf(request);
    const bool is_hurried = TakesAnyBody(request);
    const auto length = ParseNumber<std::uint64_t>(request.get_header_value("Content-Length"));
    // A file may take its time, and a request that is obeyed without its body loses nothing.
    stream.AwaitBody(is_hurried || allowance != nullptr ? 0 : length.value_or(0));
    if (is_hurried) return stream.Hurry(kHurry);
    // Without a length, cpp-httplib reads until the client hangs up, but the client waits for its
    // answer.
    if (allowance == nullptr && BringsNoBody(request)) {
      request.headers.emplace("Content-Length", "0");
    }
    if (allowance == nullptr || JudgeBody(request)) return;
    stream.Allow(allowance->body_bytes, allowance->patience);
  });
}

}  // namespace trailcast::http
