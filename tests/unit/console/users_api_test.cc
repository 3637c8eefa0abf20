// Users over HTTP: who may see, add, change and remove them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "services/console/access.h"
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
using testing::HasSubstr;
using users::Role;

class UsersApiTest : public testing::Test {
 protected:
  static constexpr const char* kLongEnough = "nine lives and one more";

  void SetUp() override {
    ASSERT_TRUE(users::ChangeUsers(File(), [](users::Users& users) -> Result<void> {
      users["boss"] = {.role = Role::kAdminister, .password = users::NobodysHash()};
      users["tool"] = {.role = Role::kAdminister, .token = users::DigestOf("administers")};
      users["anna"] = {.role = Role::kOperate, .token = users::DigestOf("operates")};
      return {};
    }));
    Open({.guard = users::Guard::Open(File(), [](const Error&) {}).value()});
  }
  void Open(Entry entry) {
    web_.reset();
    web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}, std::move(entry)).value();
  }
  [[nodiscard]] std::filesystem::path File() const { return folder_ / "users"; }
  [[nodiscard]] users::Users InFile() const { return users::LoadUsers(File()).value(); }
  struct Got {
    int status = 0;
    json body;
  };
  static Got Of(const httplib::Result& got) {
    if (!got) return {};
    return {got->status, json::parse(got->body, nullptr, false)};
  }
  [[nodiscard]] httplib::Client Client(const std::string& token = "administers") const {
    httplib::Client client("localhost", web_->port());
    client.set_logger(ExpectAsDescribed());
    client.set_read_timeout(test::kLongEnough);
    client.set_default_headers({{"Authorization", "Bearer " + token}});
    return client;
  }
  Got Add(const json& body) {
    return Of(Client().Post("/api/users", body.dump(), "application/json"));
  }
  Got Change(const std::string& user, const json& body) {
    return Of(Client().Put("/api/users/" + user, body.dump(), "application/json"));
  }
  Got Remove(const std::string& user) { return Of(Client().Delete("/api/users/" + user)); }

  test::TempDir folder_;
  exchange::InProcessBus bus_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics()),
             Desk::Options{.answer_within = milliseconds(200), .reply_within = milliseconds(200)}};
  Atlas atlas_{[]() -> Result<fleet::OperatorPeer> {
    return Fail(ErrorCode::kUnavailable, "there is no fleet");
  }};
  std::unique_ptr<Web> web_;
};

TEST_F(UsersApiTest, AnAdministratorAddsAPersonWhoLogsIn) {
  const Got added = Add({{"user", "eve"}, {"role", "look"}, {"password", kLongEnough}});
  EXPECT_EQ(added.status, 200) << added.body;
  EXPECT_EQ(added.body,
            json({{"user", "eve"}, {"role", "look"}, {"has", "password"}, {"token", nullptr}}));
  EXPECT_TRUE(users::Matches(kLongEnough, InFile().at("eve").password));
  const Got list = Of(Client().Get("/api/users"));
  ASSERT_EQ(list.body["users"].size(), 4U);
  EXPECT_EQ(list.body["users"][2], json({{"user", "eve"}, {"role", "look"}, {"has", "password"}}));
  EXPECT_EQ(list.body.dump().find("scrypt"), std::string::npos) << "no hash leaves the console";
}

TEST_F(UsersApiTest, AProgramsTokenIsShownOnce) {
  const Got added = Add({{"user", "wms"}, {"role", "operate"}, {"token", true}});
  ASSERT_EQ(added.status, 200) << added.body;
  const std::string token = added.body["token"];
  EXPECT_EQ(InFile().at("wms").token, users::DigestOf(token));
  EXPECT_EQ(Of(Client().Get("/api/users")).body.dump().find(token), std::string::npos);
  EXPECT_EQ(Change("wms", {{"password", kLongEnough}}).status, 409);
}

TEST_F(UsersApiTest, WhoMayNotAdministerSeesAndChangesNobody) {
  const json body{{"user", "eve"}, {"role", "administer"}, {"token", true}};
  EXPECT_EQ(Client("operates").Get("/api/users")->status, 403);
  EXPECT_EQ(Client("operates").Post("/api/users", body.dump(), "application/json")->status, 403);
  EXPECT_EQ(Client("operates")
                .Put("/api/users/anna", R"({"role": "administer"})", "application/json")
                ->status,
            403);
  EXPECT_EQ(Client("operates").Delete("/api/users/boss")->status, 403);
  EXPECT_EQ(InFile().size(), 3U);
}

TEST_F(UsersApiTest, ARoleAndAPasswordChange) {
  ASSERT_EQ(Add({{"user", "eve"}, {"role", "look"}, {"password", kLongEnough}}).status, 200);
  EXPECT_EQ(Change("eve", {{"role", "operate"}}).body["role"], "operate");
  EXPECT_EQ(Change("eve", {{"password", "another long one"}}).status, 200);
  EXPECT_TRUE(users::Matches("another long one", InFile().at("eve").password));
  EXPECT_EQ(InFile().at("eve").role, Role::kOperate);
  EXPECT_EQ(Remove("eve").status, 200);
  EXPECT_EQ(Remove("eve").status, 404);
  EXPECT_EQ(Change("eve", {{"role", "look"}}).status, 404);
}

TEST_F(UsersApiTest, TheLastWhoMayAdministerStays) {
  const Got removed = Remove("boss");
  EXPECT_EQ(removed.status, 409);
  EXPECT_THAT(removed.body["error"].get<std::string>(), HasSubstr("boss is the last"));
  EXPECT_EQ(Change("boss", {{"role", "operate"}}).status, 409);
  EXPECT_EQ(InFile().at("boss").role, Role::kAdminister);
  EXPECT_EQ(Remove("anna").status, 200) << "another goes";
}

TEST_F(UsersApiTest, WhatIsWrongIsSaidAndChangesNothing) {
  for (const json& body :
       {json{{"user", "a b"}, {"role", "look"}, {"token", true}},
        json{{"user", "eve"}, {"role", "root"}, {"token", true}},
        json{{"user", "eve"}, {"role", "look"}}, json{{"user", "eve"}, {"token", true}},
        json{{"user", "eve"}, {"role", "look"}, {"password", "short"}},
        json{{"user", "eve"}, {"role", "look"}, {"token", false}},
        json{{"user", "eve"}, {"role", "look"}, {"password", kLongEnough}, {"token", true}}}) {
    const Got refused = Add(body);
    EXPECT_EQ(refused.status, 400) << body;
    EXPECT_TRUE(refused.body["error"].is_string()) << body;
  }
  EXPECT_EQ(Add({{"user", "anna"}, {"role", "look"}, {"token", true}}).status, 409);
  EXPECT_EQ(Change("anna", json::object()).status, 400);
  EXPECT_EQ(InFile().size(), 3U);
}

TEST_F(UsersApiTest, WhereNobodyLogsInThereAreNoUsers) {
  Open({});
  EXPECT_EQ(Client().Get("/api/users")->status, 404);
}

}  // namespace
}  // namespace trailcast::console
