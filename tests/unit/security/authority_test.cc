#include "services/security/authority.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace trailcast::security {
namespace {

namespace fs = std::filesystem;
using State = Authority::State;
using testing::HasSubstr;

class AuthorityTest : public testing::Test {
 protected:
  Authority Create() { return Authority::Create(folder_ / "fleet", now_, 3650).value(); }
  static fs::perms ModeOf(const fs::path& file) { return fs::status(file).permissions(); }

  test::TempDir folder_;
  const Time now_ = std::chrono::system_clock::now();
};

TEST_F(AuthorityTest, GivesAMemberAFolderWithoutTheAuthoritysKey) {
  const fs::path given = Create().Add("robot1", Role::kScout, now_, 30).value();
  EXPECT_EQ(given, folder_ / "fleet" / "members" / "robot1");
  EXPECT_FALSE(fs::exists(given / "authority.key"));
  EXPECT_EQ(ModeOf(given), fs::perms::owner_all);
  EXPECT_EQ(ModeOf(given / "identity.key"), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(ModeOf(folder_ / "fleet" / "authority.key"),
            fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(ModeOf(folder_ / "fleet"), fs::perms::owner_all);
}

TEST_F(AuthorityTest, IsNeverReplacedAndIsFoundAgain) {
  (void)Create();
  const auto second = Authority::Create(folder_ / "fleet", now_, 3650);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("has an authority already"));
  EXPECT_TRUE(Authority::Open(folder_ / "fleet"));
  const auto nowhere = Authority::Open(folder_ / "elsewhere");
  ASSERT_FALSE(nowhere);
  EXPECT_THAT(nowhere.error().message, HasSubstr("trailcast keys init"));
}

TEST_F(AuthorityTest, ANameIsGivenOnce) {
  const Authority authority = Create();
  ASSERT_TRUE(authority.Add("robot1", Role::kScout, now_, 30));
  const auto again = authority.Add("robot1", Role::kOperator, now_, 30);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kConflict);
  EXPECT_THAT(again.error().message, HasSubstr("trailcast keys renew robot1"));
  EXPECT_FALSE(authority.Add("../robot", Role::kScout, now_, 30));
  EXPECT_FALSE(authority.Add("robot1-p12", Role::kScout, now_, 30));  // a process of robot1
}

TEST_F(AuthorityTest, ListsItsMembersWithTheirState) {
  const Authority authority = Create();
  ASSERT_TRUE(authority.Add("a.1", Role::kServer, now_, 30));
  ASSERT_TRUE(authority.Add("b", Role::kScout, now_, 30));
  ASSERT_TRUE(authority.Add("c", Role::kFollower, now_, 3));
  ASSERT_TRUE(authority.Revoke("b", now_));
  const auto rows = authority.List(now_ + std::chrono::hours(24 * 4)).value();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].name, "a.1");
  EXPECT_EQ(rows[0].member.role, Role::kServer);
  EXPECT_EQ(rows[0].state, State::kValid);
  EXPECT_EQ(rows[1].state, State::kRevoked);
  EXPECT_EQ(rows[2].state, State::kExpired);
  const auto nobody = authority.Revoke("d", now_);
  ASSERT_FALSE(nobody);
  EXPECT_THAT(nobody.error().message, HasSubstr("there are: a.1, b, c"));
}

TEST_F(AuthorityTest, RenewedKeysAreOfANewGenerationAndTakeBackWhoWasRevoked) {
  const Authority authority = Create();
  ASSERT_TRUE(authority.Add("robot1", Role::kScout, now_, 30));
  ASSERT_TRUE(authority.Revoke("robot1", now_));
  ASSERT_TRUE(authority.Renew("robot1", {}, now_, 60));
  const auto rows = authority.List(now_).value();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].member.generation, 2U);
  EXPECT_EQ(rows[0].state, State::kValid);
  EXPECT_FALSE(authority.Renew("robot2", {}, now_, 60));
}

TEST_F(AuthorityTest, NothingOutlivesTheAuthority) {
  const auto authority = Authority::Create(folder_ / "fleet", now_, 10).value();
  ASSERT_TRUE(authority.Add("robot1", Role::kScout, now_, 365));
  EXPECT_LE(authority.List(now_).value().at(0).expires, now_ + std::chrono::hours(240));
  const auto late = authority.Add("robot2", Role::kScout, now_ + std::chrono::hours(241), 365);
  ASSERT_FALSE(late);
  EXPECT_THAT(late.error().message, HasSubstr("the authority itself ended"));
}

}  // namespace
}  // namespace trailcast::security
