#include "route_server/status/http_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <thread>
#include <utility>
#include <vector>

#include "tests/support/await.h"
#include "tests/support/strangers/hostile_client.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;

void Complain(const Error& error) { ADD_FAILURE() << error.message; }

TEST(HttpPage, ShowsTheLatestMetrics) {
  const auto page = HttpPage::Open("127.0.0.1", 0, Complain).value();
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
  const auto page = HttpPage::Open("127.0.0.1", 0, Complain, milliseconds(200)).value();
  httplib::Client client("127.0.0.1", page->port());
  const auto status = [&] {
    const auto got = client.Get("/health");
    return got ? got->status : 0;
  };
  const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
  // Again where a busy machine lets what was shown grow old before it is asked for.
  const auto is_well_once_shown = [&] {
    int answer = 0;
    while (answer != 200 && std::chrono::steady_clock::now() < deadline) {
      page->Show({""});
      answer = status();
    }
    return answer == 200;
  };
  EXPECT_TRUE(is_well_once_shown());
  while (status() == 200 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(10));
  }
  EXPECT_EQ(status(), 503);
  EXPECT_TRUE(is_well_once_shown());
}

TEST(HttpPage, SaysWhyNobodyCanBeServedAndWhatIsServedInPart) {
  const auto page = HttpPage::Open("127.0.0.1", 0, Complain).value();
  httplib::Client client("127.0.0.1", page->port());
  page->Show({"", "the store is away: no database", "1 route"});
  EXPECT_EQ(client.Get("/health")->status, 503);
  EXPECT_EQ(client.Get("/health")->body, "the store is away: no database\n");
  page->Show({"", "", "1 route"});
  EXPECT_EQ(client.Get("/health")->status, 200);
  EXPECT_EQ(client.Get("/health")->body, "degraded: 1 route\n");
  page->Show({"", "", ""});
  EXPECT_EQ(client.Get("/health")->body, "ok\n");
}

TEST(HttpPage, APortThatIsTakenIsRefused) {
  const auto first = HttpPage::Open("127.0.0.1", 0, Complain).value();
  const auto second = HttpPage::Open("127.0.0.1", first->port(), Complain);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(second.error().message, testing::HasSubstr("is the port taken"));
}

TEST(HttpPage, RequestsWithoutEndAreCutOff) {
  const auto page = HttpPage::Open("127.0.0.1", 0, Complain).value();
  page->Show({""});
  const std::string chunk = "1000\r\n" + std::string(0x1000, 'x') + "\r\n";
  const std::string post = "POST /metrics HTTP/1.1\r\nHost: x\r\n";
  constexpr std::size_t kWithSocketBuffers = 16U << 20U;
  for (const auto& [beginning, more] : std::vector<std::pair<std::string, std::string>>{
           {"GET /", std::string(10'000, 'x')},
           {"GET /health HTTP/1.1\r\n", "X-More: " + std::string(1000, 'x') + "\r\n"},
           {post + "Transfer-Encoding: chunked\r\n\r\n", chunk},
           {post + "Content-Length: 1000000000000\r\n\r\n", std::string(10'000, 'x')}}) {
    EXPECT_LT(test::RawConnection(page->port()).SendForEver(beginning, more), kWithSocketBuffers)
        << beginning;
    httplib::Client client("127.0.0.1", page->port());
    const auto got = client.Get("/health");
    ASSERT_TRUE(got) << beginning;
    EXPECT_EQ(got->status, 200) << beginning;
  }
}

}  // namespace
}  // namespace trailcast::server
