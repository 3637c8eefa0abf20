// This fuzzes what clients send to this project's HTTP server, whatever it is, over a connection.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "services/http/server.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
using namespace trailcast;

namespace {

constexpr std::size_t kBody_bytes = 1000;
constexpr std::size_t kFile_bytes = 4000;
constexpr unsigned kPoliteEvery = 64;

// Answers with what it was asked for.
class Echo {
 public:
  Echo() {
    const auto echo = [](const httplib::Request& request, httplib::Response& response) {
      Require(request.body.size() <= (request.path == "/file" ? kFile_bytes : kBody_bytes),
              "a body is within its bounds");
      std::string text = request.body;
      for (const auto& [name, value] : request.params) text += name + value;
      response.set_content(text, "text/plain");
    };
    server_.Get("/echo", echo);
    server_.Post("/echo", echo);
    server_.Post("/file", echo);
    server_.Allow({.method = "POST",
                   .path = "/file",
                   .body_bytes = kFile_bytes,
                   .patience = std::chrono::seconds(5)});
    Require(server_.Listen("127.0.0.1", 0).has_value(), "it listens");
  }

  // All that it answers to these bytes, and no more of them.
  [[nodiscard]] std::string Ask(const std::string& bytes) const {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(server_.port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    Require(connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0,
            "it takes connections");
    (void)send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    (void)shutdown(socket, SHUT_WR);
    std::string answer;
    std::array<char, 4096> part{};
    for (ssize_t got = 1; got > 0;) {
      got = recv(socket, part.data(), part.size(), 0);
      if (got > 0) answer.append(part.data(), static_cast<std::size_t>(got));
    }
    (void)close(socket);
    return answer;
  }

 private:
  http::Server server_{{.threads = 2, .waiting = 8, .body_bytes = kBody_bytes},
                       [](const Error& error) {
                         std::fprintf(stderr, "%s\n", error.message.c_str());
                         std::abort();
                       }};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Echo echo;
  static unsigned inputs = 0;
  const std::string answer = echo.Ask({reinterpret_cast<const char*>(data), size});
  Require(answer.empty() || answer.starts_with("HTTP/1.1 "), "it answers in HTTP or hangs up");
  if (++inputs % kPoliteEvery == 0) {
    Require(echo.Ask("GET /echo?a=b HTTP/1.1\r\nHost: x\r\n\r\n").ends_with("\r\n\r\nab"),
            "others are answered");
  }
  return 0;
}
