#include "route_server/http_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <thread>

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;

TEST(HttpPage, ShowsTheLatestMetrics) {
  const auto page = HttpPage::Open("127.0.0.1", 0).value();
  httplib::Client client("127.0.0.1", page->port());
  page->Show("a 1\n");
  page->Show("a 2\n");
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
  page->Show("");
  EXPECT_EQ(status(), 200);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (status() == 200 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(10));
  }
  EXPECT_EQ(status(), 503);
  page->Show("");
  EXPECT_EQ(status(), 200);
}

TEST(HttpPage, APortThatIsTakenIsRefused) {
  const auto first = HttpPage::Open("127.0.0.1", 0).value();
  const auto second = HttpPage::Open("127.0.0.1", first->port());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(second.error().message, testing::HasSubstr("is the port taken"));
}

}  // namespace
}  // namespace trailcast::server
