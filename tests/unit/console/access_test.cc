// These test who is let in, and to what: users, roles, sessions and tokens over HTTP.
#include "services/console/access.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "services/console/rights.h"
#include "services/console/src/api/files.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/users/secret.h"
#include "tests/support/await.h"
#include "tests/support/described.h"
#include "tests/support/temp_dir.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using users::Role;

class AccessTest : public testing::Test {
 protected:
  static constexpr const char* kPassword = "correct horse";

  void SetUp() override {
    ASSERT_TRUE(users::ChangeUsers(folder_ / "users", [](users::Users& users) -> Result<void> {
      const std::string hash = users::NobodysHash();
      users["anna"] = {.role = Role::kOperate, .password = hash};
      users["guest"] = {.role = Role::kLook, .password = hash};
      users["wms"] = {.role = Role::kOperate, .token = users::DigestOf("token")};
      return {};
    }));
    Open({.guard = Guard()});
  }
  // Hashes nothing, and its time stands still.
  [[nodiscard]] std::shared_ptr<users::Guard> Guard() const {
    return users::Guard::Open(folder_ / "users", [](const Error&) {},
                              {.clock = [now = std::chrono::steady_clock::now()] { return now; },
                               .matches = [](const std::string& password,
                                             const std::string&) { return password == kPassword; }})
        .value();
  }
  void Open(Entry entry) {
    web_.reset();
    web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}, std::move(entry)).value();
  }
  struct Got {
    int status = 0;
    json body;
    httplib::Headers headers;
    [[nodiscard]] std::string header(const std::string& name) const {
      const auto found = headers.find(name);
      return found == headers.end() ? "" : found->second;
    }
  };
  static Got Of(const httplib::Result& got) {
    if (!got) return {};
    return {got->status, json::parse(got->body, nullptr, false), got->headers};
  }
  [[nodiscard]] httplib::Client Client() const {
    httplib::Client client("localhost", web_->port());
    client.set_logger(ExpectAsDescribed());
    client.set_read_timeout(test::kLongEnough);
    return client;
  }
  Got Get(const std::string& path, const httplib::Headers& headers = {}) {
    return Of(Client().Get(path, headers));
  }
  Got Post(const std::string& path, const httplib::Headers& headers = {},
           const json& body = json::object()) {
    return Of(Client().Post(path, headers, body.dump(), "application/json"));
  }
  Got LogIn(const std::string& user, const std::string& password,
            const httplib::Headers& headers = {}) {
    return Post("/api/log-in", headers, {{"user", user}, {"password", password}});
  }
  [[nodiscard]] std::string Origin() const {
    return "http://localhost:" + std::to_string(web_->port());
  }
  // Returns headers as a browser sends them that has logged in.
  httplib::Headers As(const std::string& user) {
    const std::string set = LogIn(user, kPassword).header("Set-Cookie");
    return {{"Cookie", "other=1; " + set.substr(0, set.find(';'))}, {"Origin", Origin()}};
  }

  test::TempDir folder_;
  exchange::InProcessBus bus_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics()),
             Desk::Options{.answer_within = milliseconds(200), .reply_within = milliseconds(200)}};
  Atlas atlas_{[]() -> Result<fleet::OperatorPeer> {
    return Fail(ErrorCode::kUnavailable, "there is no fleet");
  }};
  std::unique_ptr<Web> web_;
};

TEST_F(AccessTest, WhoIsNotLoggedInSeesThePageAlone) {
  EXPECT_EQ(Get("/").status, 200);
  EXPECT_EQ(Get("/page.js").status, 200);
  for (const char* path : {"/api/state", "/api/events", "/api/missions", "/api/me", "/api/none",
                           "/metrics", "/none"}) {
    EXPECT_EQ(Get(path).status, 401) << path;
  }
  const Got refused = Post("/api/all/stop");
  EXPECT_EQ(refused.status, 401);
  EXPECT_EQ(refused.body["error"], "log in first");
  EXPECT_EQ(refused.header("WWW-Authenticate"), "Bearer");
  EXPECT_EQ(refused.header("Cache-Control"), "no-store");
  EXPECT_EQ(Client().Head("/api/state")->status, 401);
}

TEST_F(AccessTest, WhoLogsInIsKnownUntilTheyLogOut) {
  const Got in = LogIn("anna", kPassword);
  EXPECT_EQ(in.status, 200);
  EXPECT_EQ(in.body["user"], "anna");
  EXPECT_EQ(in.body["role"], "operate");
  EXPECT_THAT(in.header("Set-Cookie"),
              AllOf(HasSubstr("; HttpOnly"), HasSubstr("; SameSite=Strict"), HasSubstr("; Path=/"),
                    Not(HasSubstr("Secure"))));
  const httplib::Headers anna = As("anna");
  EXPECT_EQ(Get("/api/me", anna).body["user"], "anna");
  EXPECT_EQ(Get("/api/state", anna).status, 200);
  EXPECT_EQ(Post("/api/robots/robot1/stop", anna).status, 504) << "no robot is there";
  EXPECT_EQ(Post("/api/log-out", anna).status, 200);
  EXPECT_EQ(Get("/api/state", anna).status, 401);
  EXPECT_EQ(LogIn("anna", "wrong horse").status, 401);
  EXPECT_EQ(LogIn("nobody", kPassword).body, LogIn("anna", "wrong horse").body);
  EXPECT_EQ(Post("/api/log-in", {}, {{"user", "anna"}}).status, 400);
  EXPECT_EQ(Post("/api/log-in", {}, {{"user", 1}, {"password", 2}}).status, 400);
}

TEST_F(AccessTest, WhatARoleMayNotIsRefused) {
  const httplib::Headers guest = As("guest");
  EXPECT_EQ(Get("/api/state", guest).status, 200);
  EXPECT_EQ(Get("/api/me", guest).body["role"], "look");
  EXPECT_EQ(Get("/api/network", guest).status, 503) << "no server is there";
  EXPECT_EQ(Get("/api/network/way?from=a@1&to=b@1", guest).status, 503);
  for (const char* path : {"/api/all/stop", "/api/robots/robot1/stop", "/api/robots/r/missions",
                           "/api/network/edits"}) {
    const Got refused = Post(path, guest);
    EXPECT_EQ(refused.status, 403) << path;
    EXPECT_EQ(refused.body["error"], "guest may not do this: that takes the role 'operate'");
  }
  EXPECT_EQ(Get("/api/none", As("anna")).status, 403) << "what is not in the table";
}

TEST_F(AccessTest, ACookieAloneTellsRobotsNothing) {
  httplib::Headers anna = As("anna");
  anna.erase("Origin");
  const Got refused = Post("/api/all/stop", anna);
  EXPECT_EQ(refused.status, 403);
  EXPECT_THAT(refused.body["error"].get<std::string>(), HasSubstr("Origin"));
  anna.emplace("Origin", "http://evil.example");
  EXPECT_EQ(Post("/api/all/stop", anna).status, 403);
  EXPECT_EQ(Post("/api/log-in", anna).status, 403) << "nor logs somebody in as another";
  EXPECT_EQ(Get("/api/state", anna).status, 403);
}

TEST_F(AccessTest, AProgramSendsItsToken) {
  const httplib::Headers wms{{"Authorization", "Bearer token"}};
  EXPECT_EQ(Get("/api/me", wms).body["user"], "wms");
  EXPECT_EQ(Post("/api/robots/robot1/stop", wms).status, 504);
  EXPECT_EQ(Get("/api/me", {{"Authorization", "Bearer wrong"}}).status, 401);
  EXPECT_EQ(Get("/api/me", {{"Authorization", "Basic dG9rZW4="}}).status, 401);
  httplib::Headers both = As("anna");
  both.emplace("Authorization", "Bearer wrong");
  EXPECT_EQ(Get("/api/me", both).status, 401) << "a wrong one is not made good by a cookie";
}

TEST_F(AccessTest, RobotsAreToldWhoGaveAnOrder) {
  using exchange::Topic;
  const auto robot = bus_.Open({.write = {}, .read = {Topic::kNow, Topic::kMissions}});
  const httplib::Headers anna = As("anna");
  EXPECT_EQ(Post("/api/robots/robot1/stop", anna, {{"reason", "rain"}}).status, 504);
  EXPECT_EQ(Post("/api/robots/robot1/pause", anna).status, 504);
  EXPECT_EQ(Post("/api/robots/robot1/missions", anna, {{"orders", "wait 5"}}).status, 504);
  std::set<std::string> said;
  for (const exchange::Message& message : robot->Take(milliseconds(1000))) {
    if (const auto* now = std::get_if<exchange::NowCommand>(&message)) said.insert(now->reason);
    if (const auto* mission = std::get_if<mission::Mission>(&message)) {
      said.insert(mission->id.substr(0, 5));
    }
  }
  EXPECT_EQ(said, (std::set<std::string>{"anna", "anna-", "anna: rain"}));
}

TEST_F(AccessTest, WhoGuessesIsToldToWait) {
  for (int i = 0; i < 6; ++i) EXPECT_EQ(LogIn("anna", "wrong").status, 401) << i;
  const Got refused = LogIn("anna", kPassword);
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(refused.header("Retry-After"), "1");
}

TEST_F(AccessTest, AStreamEndsWithItsSession) {
  const httplib::Headers anna = As("anna");
  bool out = false;
  std::string events;
  const auto end = Client().Get("/api/events", anna, [&](const char* data, std::size_t size) {
    events.append(data, size);
    if (!out) out = Post("/api/log-out", anna).status == 200;
    return true;
  });
  EXPECT_TRUE(out);
  EXPECT_THAT(events, HasSubstr("event: state"));
}

TEST_F(AccessTest, AnObserversConsoleShowsAndCommandsNobody) {
  Open({.only_looks = "its keys are an observer's"});
  EXPECT_EQ(Get("/api/state").status, 200);
  const Got me = Get("/api/me");
  EXPECT_EQ(me.body["role"], "look");
  EXPECT_EQ(me.body["only_looks"], "its keys are an observer's");
  const Got refused = Post("/api/all/stop");
  EXPECT_EQ(refused.status, 403);
  EXPECT_EQ(refused.body["error"], "its keys are an observer's");
}

TEST_F(AccessTest, WithoutUsersWhoeverIsThereMayAll) {
  Open({});
  EXPECT_EQ(Get("/api/me").body["role"], "administer");
  EXPECT_EQ(Get("/api/me").body["logs_in"], false);
  EXPECT_EQ(Post("/api/robots/robot1/stop").status, 504);
  EXPECT_EQ(LogIn("anna", kPassword).status, 404);
}

TEST_F(AccessTest, BehindAProxyItSaysWhereClientsAre) {
  Open({.guard = Guard(), .behind_proxy = true});
  const httplib::Headers stranger{{"X-Forwarded-For", "10.0.0.1, 192.0.2.1"}};
  const Got in = LogIn("guest", kPassword, stranger);
  EXPECT_THAT(in.header("Set-Cookie"), AllOf(testing::StartsWith("__Host-"), HasSubstr("Secure")));
  EXPECT_THAT(in.header("Strict-Transport-Security"), HasSubstr("max-age"));
  for (int i = 0; i < 6; ++i) EXPECT_EQ(LogIn("anna", "wrong", stranger).status, 401);
  EXPECT_EQ(LogIn("guest", kPassword, {{"X-Forwarded-For", "10.0.0.9, 192.0.2.1"}}).status, 429);
  const httplib::Headers two{{"X-Forwarded-For", "10.0.0.8"}, {"X-Forwarded-For", "192.0.2.1"}};
  EXPECT_EQ(LogIn("guest", kPassword, two).status, 429);
  EXPECT_EQ(LogIn("guest", kPassword, {{"X-Forwarded-For", "192.0.2.2"}}).status, 200);
}

TEST(Rights, AreGivenByTheTableAlone) {
  EXPECT_EQ(RightTo("POST", "/api/robots/robot1/stop").needs, Role::kOperate);
  EXPECT_EQ(RightTo("POST", "/api/robots/robot1/home").needs, Role::kOperate);
  EXPECT_EQ(RightTo("POST", "/api/all/home").needs, Role::kOperate);
  EXPECT_EQ(RightTo("POST", "/api/routes/hall/edits").needs, Role::kAdminister);
  EXPECT_EQ(RightTo("GET", "/api/state").needs, Role::kLook);
  EXPECT_EQ(RightTo("GET", "/api/site").needs, Role::kLook);
  EXPECT_EQ(RightTo("GET", "/api/figures").needs, Role::kLook);
  EXPECT_EQ(RightTo("GET", "/api/site/geojson").needs, Role::kLook);
  EXPECT_EQ(RightTo("PUT", "/api/site/placements/ab").needs, Role::kOperate);
  EXPECT_EQ(RightTo("GET", "/metrics").needs, Role::kLook);
  EXPECT_FALSE(RightTo("POST", "/").is_known);
  for (const char* path : {"/api/robots//stop", "/api/robots/robot1/stop/", "/api/robots/a/b/stop",
                           "/api/robots/robot1", "/api/robots/robot1/dance", "/api/", "/api"}) {
    EXPECT_FALSE(RightTo("POST", path).is_known) << path;
  }
  EXPECT_FALSE(RightTo("DELETE", "/api/state").is_known);
}

TEST(Rights, ThePagesOwnFilesAloneAreForAnybody) {
  for (const File& file : Files()) {
    const Right right = RightTo("GET", file.path);
    EXPECT_TRUE(right.is_known && !right.needs) << file.path;
  }
  for (const char* path : {"/plan.png", "/page.js/more", "/index.html", "//", ""}) {
    EXPECT_EQ(RightTo("GET", path).needs, Role::kLook) << path;
  }
}

// Returns the parts of a line's "{key: value, key: value}" that have no colon: texts without
// quotes, cut at their commas.
std::vector<std::string> CutIn(const std::string& line) {
  struct Map {
    bool is_map = false;  // else a list
    std::size_t from = 0;
    bool has_key = false;
  };
  std::vector<Map> open;
  std::vector<std::string> cut;
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const std::string_view before = std::string_view(line).substr(0, i);
    const bool begins_value = before.ends_with(": ") || before.ends_with("- ") ||
                              before.ends_with(", ") || before.ends_with("[") ||
                              before.ends_with("{");
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (begins_value && (c == '\'' || c == '"')) {
      quote = c;
    } else if (begins_value && (c == '{' || c == '[')) {
      open.push_back({c == '{', i + 1, false});
    } else if (open.empty()) {
      continue;
    } else if (c == ':') {
      open.back().has_key = true;
    } else if (c == ',' || c == '}' || c == ']') {
      Map& map = open.back();
      const bool is_empty = i == map.from;
      if (map.is_map && !map.has_key && !is_empty)
        cut.push_back(line.substr(map.from, i - map.from));
      map.from = i + 1;
      map.has_key = false;
      if (c != ',') open.pop_back();
    }
  }
  return cut;
}

TEST(ApiDescription, NoTextIsCutAtAComma) {
  EXPECT_THAT(CutIn("a: {description: 'b, c', enum: [d, e], f: {g: h}}"), testing::IsEmpty());
  EXPECT_THAT(CutIn("a: {items: {}}"), testing::IsEmpty());
  EXPECT_THAT(CutIn("a: {type: b, description: c, or d}"), testing::ElementsAre(" or d"));
  for (const File& file : Files()) {
    if (std::string(file.path) != "/api/openapi.yaml") continue;
    std::istringstream lines{std::string(file.bytes)};
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      EXPECT_THAT(CutIn(line), testing::IsEmpty())
          << "openapi.yaml, line " << number << ": put the text into quotes";
    }
    EXPECT_GT(number, 100);
  }
}

// "/api/robots/{robot}/{order}:" and the methods below it. A path with {order} stands for each.
TEST(Rights, OfAllThatIsDescribedTheTableKnowsWhoMay) {
  std::string description;
  for (const File& file : Files()) {
    if (std::string(file.path) == "/api/openapi.yaml") description = file.bytes;
  }
  std::istringstream lines(description);
  std::string path;
  int known = 0;
  for (std::string line; std::getline(lines, line) && line != "components:";) {
    if (line.starts_with("  /")) path = line.substr(2, line.size() - 3);
    for (const std::string method : {"get", "post", "put", "delete", "patch"}) {
      if (line != "    " + method + ":") continue;
      std::string upper = method;
      for (char& c : upper) c = static_cast<char>(std::toupper(c));
      std::string asked = path;
      if (const auto at = asked.find("{order}"); at != asked.npos) asked.replace(at, 7, "stop");
      EXPECT_TRUE(RightTo(upper, asked).is_known)
          << upper << " " << path << ": src/rights.cc is to say which role may";
      ++known;
    }
  }
  EXPECT_GE(known, 8);
}

}  // namespace
}  // namespace trailcast::console
