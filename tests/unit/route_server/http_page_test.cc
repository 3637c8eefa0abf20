#include "route_server/http_page.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;

TEST(HttpPage, ShowsTheLatestMetrics) {
  const auto page = HttpPage::Open("127.0.0.1", 0).value();
  httplib::Client client("127.0.0.1", page->port());
  page->Show({"a 1\n"});
  page->Show({"a 2\n"});
  const auto got = client.Get("/metrics");
  ASSERT_TRUE(got);
  EXPECT_EQ(got->status, 200);
  EXPECT_EQ(got->body, "a 2\n");
  EXPECT_THAT(got->get_header_value("Content-Type"), testing::StartsWith("text/plain"));
  EXPECT_EQ(client.Get("/else")->status, 404);
}

TEST(HttpPage, IsNotWellOnceNothingIsShownAnyMore) {
  const auto page = HttpPage::Open("127.0.0.1", 0, milliseconds(200)).value();
  httplib::Client client("127.0.0.1", page->port());
  const auto status = [&] {
    const auto got = client.Get("/health");
    return got ? got->status : 0;
  };
  page->Show({""});
  EXPECT_EQ(status(), 200);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (status() == 200 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(10));
  }
  EXPECT_EQ(status(), 503);
  page->Show({""});
  EXPECT_EQ(status(), 200);
}

TEST(HttpPage, SaysWhyNobodyCanBeServedAndWhatIsServedInPart) {
  const auto page = HttpPage::Open("127.0.0.1", 0).value();
  httplib::Client client("127.0.0.1", page->port());
  page->Show({"", "no database", "1 route"});
  EXPECT_EQ(client.Get("/health")->status, 503);
  EXPECT_EQ(client.Get("/health")->body, "the store is away: no database\n");
  page->Show({"", "", "1 route"});
  EXPECT_EQ(client.Get("/health")->status, 200);
  EXPECT_EQ(client.Get("/health")->body, "degraded: 1 route\n");
  page->Show({"", "", ""});
  EXPECT_EQ(client.Get("/health")->body, "ok\n");
}

TEST(HttpPage, APortThatIsTakenIsRefused) {
  const auto first = HttpPage::Open("127.0.0.1", 0).value();
  const auto second = HttpPage::Open("127.0.0.1", first->port());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(second.error().message, testing::HasSubstr("is the port taken"));
}

// Sends until the other side has had enough; what it answered, and how much it took.
struct Endless {
  std::size_t taken = 0;
  std::string answer;
};
Endless SendForEver(int port, const std::string& beginning, const std::string& more) {
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(client, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  constexpr timeval kBound{.tv_sec = 20, .tv_usec = 0};
  setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &kBound, sizeof(kBound));
  setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &kBound, sizeof(kBound));
  Endless endless;
  std::string text = beginning;
  constexpr std::size_t kTooMuch = 64U << 20U;
  while (endless.taken < kTooMuch) {
    const ssize_t sent = send(client, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent <= 0) break;
    endless.taken += static_cast<std::size_t>(sent);
    text = more;
  }
  std::array<char, 100> bytes{};
  if (const ssize_t got = recv(client, bytes.data(), bytes.size(), 0); got > 0) {
    endless.answer.assign(bytes.data(), static_cast<std::size_t>(got));
  }
  close(client);
  return endless;
}

TEST(HttpPage, RequestsWithoutEndAreCutOff) {
  const auto page = HttpPage::Open("127.0.0.1", 0).value();
  page->Show({""});
  const std::string chunk = "1000\r\n" + std::string(0x1000, 'x') + "\r\n";
  const std::string post = "POST /metrics HTTP/1.1\r\nHost: x\r\n";
  constexpr std::size_t kWithSocketBuffers = 16U << 20U;
  for (const auto& [beginning, more] : std::vector<std::pair<std::string, std::string>>{
           {"GET /", std::string(10'000, 'x')},
           {"GET /health HTTP/1.1\r\n", "X-More: " + std::string(1000, 'x') + "\r\n"},
           {post + "Transfer-Encoding: chunked\r\n\r\n", chunk},
           {post + "Content-Length: 1000000000000\r\n\r\n", std::string(10'000, 'x')}}) {
    EXPECT_LT(SendForEver(page->port(), beginning, more).taken, kWithSocketBuffers) << beginning;
    httplib::Client client("127.0.0.1", page->port());
    const auto got = client.Get("/health");
    ASSERT_TRUE(got) << beginning;
    EXPECT_EQ(got->status, 200) << beginning;
  }
}

}  // namespace
}  // namespace trailcast::server
