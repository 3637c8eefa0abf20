#include "services/http/door.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::http {
namespace {

httplib::Request Asked(const std::string& method, const std::string& path,
                       const httplib::Headers& headers) {
  httplib::Request request;
  request.method = method;
  request.path = path;
  request.headers = headers;
  return request;
}
// Returns 0 for a request that is let in.
int StatusOf(const httplib::Request& request, const std::set<std::string>& names = {}) {
  const auto refusal = Judge(request, {.port = 8080, .names = names});
  return refusal ? refusal->status : 0;
}
int StatusOfPost(httplib::Headers headers) {
  headers.emplace("Host", "localhost:8080");
  const auto request = Asked("POST", "/api/all/stop", headers);
  if (const int status = StatusOf(request); status != 0) return status;
  const auto refusal = JudgeType(request);
  return refusal ? refusal->status : 0;
}

TEST(Door, LetsInWhatIsMeantForThisHost) {
  const auto get = [](const std::string& host, const std::set<std::string>& names = {}) {
    return StatusOf(Asked("GET", "/", {{"Host", host}}), names);
  };
  for (const char* host : {"localhost:8080", "LocalHost:8080", "127.0.0.1:8080", "[::1]:8080"}) {
    EXPECT_EQ(get(host), 0) << host;
  }
  for (const char* host : {"", "localhost", "localhost:80", "evil.example:8080", "desk.site",
                           "localhost:8080.evil.example", "127.0.0.1:8080@evil.example"}) {
    EXPECT_EQ(get(host), 421) << host;
  }
  EXPECT_EQ(get("desk.site", {"desk.site"}), 0);
  EXPECT_EQ(get("Desk.site:8443", {"desk.site"}), 0);
  EXPECT_EQ(get("evil.desk.site", {"desk.site"}), 421);
  EXPECT_EQ(StatusOf(Asked("GET", "/", {})), 0) << "no browser leaves it out";
  EXPECT_EQ(StatusOf(Asked("GET", "/", {{"Host", "localhost:8080"}, {"Host", "localhost:8080"}})),
            421)
      << "who knows which is meant";
}

TEST(Door, APostIsJsonOrAFileAndFromNoOtherPage) {
  for (const char* type : {"image/jpeg", "image/png", "application/octet-stream"}) {
    EXPECT_EQ(StatusOfPost({{"Content-Type", type}}), 0) << type;
  }
  EXPECT_EQ(StatusOfPost({{"Content-Type", "application/json"}}), 0);
  EXPECT_EQ(StatusOfPost({{"Content-Type", "Application/JSON ; charset=utf-8"}}), 0);
  for (const char* type : {"text/plain", "application/x-www-form-urlencoded", "",
                           "application/jsonp", "text/plain; application/json"}) {
    EXPECT_EQ(StatusOfPost({{"Content-Type", type}}), 415) << type;
  }
  EXPECT_EQ(StatusOfPost({}), 0) << "nothing needs no type";
  EXPECT_EQ(StatusOfPost({{"Content-Length", "0"}}), 0);
  EXPECT_EQ(StatusOfPost({{"Content-Length", "1"}}), 415);
  EXPECT_EQ(StatusOfPost({{"Transfer-Encoding", "chunked"}}), 415);
  const auto from = [](const char* origin) {
    return StatusOfPost({{"Content-Type", "application/json"}, {"Origin", origin}});
  };
  EXPECT_EQ(from("http://localhost:8080"), 0);
  EXPECT_EQ(from("https://localhost:8080"), 0) << "behind a proxy";
  for (const char* origin : {"null", "http://evil.example", "http://localhost:3000",
                             "http://127.0.0.1:8080", "http://localhost:8080.evil.example"}) {
    EXPECT_EQ(from(origin), 403) << origin;
  }
  EXPECT_EQ(StatusOfPost({{"Content-Type", "application/json"}, {"Sec-Fetch-Site", "cross-site"}}),
            403);
}

TEST(Door, OtherPagesMayLinkToThePageAndNotAskForWhatIsBehindIt) {
  const auto get = [](const char* path, const char* site) {
    return StatusOf(Asked("GET", path, {{"Host", "localhost:8080"}, {"Sec-Fetch-Site", site}}));
  };
  EXPECT_EQ(get("/", "cross-site"), 0);
  EXPECT_EQ(get("/api/events", "cross-site"), 403);
  EXPECT_EQ(get("/api/events", "same-site"), 403) << "another program's page on this machine";
  EXPECT_EQ(get("/api/events", "same-origin"), 0);
  EXPECT_EQ(get("/api/state", "none"), 0) << "typed by a person";
}

TEST(Door, WhereOneLogsInAnyNameWillDoAndOverTlsOnlyItsOwnPages) {
  const Door door{.port = 8080, .any_name = true, .encrypted = true};
  const auto get = [&](const std::string& origin) {
    const auto refusal =
        Judge(Asked("GET", "/api/state", {{"Host", "192.0.2.7:8443"}, {"Origin", origin}}), door);
    return refusal ? refusal->status : 0;
  };
  EXPECT_EQ(get("https://192.0.2.7:8443"), 0);
  EXPECT_EQ(get("http://192.0.2.7:8443"), 403);
  EXPECT_EQ(get("https://192.0.2.7"), 403) << "another port is another page";
}

}  // namespace
}  // namespace trailcast::http
