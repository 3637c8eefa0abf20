#include "services/security/member_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/security/authority.h"
#include "tests/support/strangers/old_keys.h"
#include "tests/support/temp_dir.h"

namespace trailcast::security {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MemberKeysTest : public testing::Test {
 protected:
  // The error's text; empty when the keys are all right.
  std::string Fault(const fs::path& folder) const {
    const auto keys = LoadMemberKeys(folder, now_);
    return keys ? "" : keys.error().message;
  }
  void Copy(const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  }

  test::TempDir folder_;
  const Time now_ = std::chrono::system_clock::now();
  const Authority authority_ = Authority::Create(folder_ / "fleet", now_, 3650).value();
  const fs::path scout_ = authority_.Add("robot1", Role::kScout, now_, 30).value();
  const fs::path follower_ = authority_.Add("robot2", Role::kFollower, now_, 30).value();
};

TEST_F(MemberKeysTest, AreThoseOfTheMemberTheyWereGivenTo) {
  const auto keys = LoadMemberKeys(scout_, now_);
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_EQ(keys->name, "robot1");
  EXPECT_EQ(keys->member.role, Role::kScout);
  EXPECT_EQ(keys->member.id, MemberIdOf(keys->name_key, "robot1"));
  EXPECT_EQ(NameInKeys(scout_).value(), "robot1");
}

TEST_F(MemberKeysTest, FromBeforeSegmentsHadScopesHoldAndSaySo) {
  EXPECT_TRUE(LoadMemberKeys(scout_, now_)->scoped);
  test::MakeOfBeforeScopes(authority_.folder(), scout_);
  const auto keys = LoadMemberKeys(scout_, now_);
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_FALSE(keys->scoped);
}

TEST_F(MemberKeysTest, FromBeforeServersSpreadRevocationsHoldAndSaySo) {
  EXPECT_TRUE(LoadMemberKeys(scout_, now_)->revocations);
  test::MakeOfBeforeRevocations(authority_.folder(), scout_);
  const auto keys = LoadMemberKeys(scout_, now_);
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_FALSE(keys->revocations);
}

TEST_F(MemberKeysTest, FromBeforeRobotsWereToldWhatToDoNowHoldAndSaySo) {
  EXPECT_THAT(LoadMemberKeys(scout_, now_)->lacks, IsEmpty());
  test::MakeOfBeforeNow(authority_.folder(), scout_);
  const auto keys = LoadMemberKeys(scout_, now_);
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_THAT(keys->lacks, ElementsAre(exchange::Topic::kNow));
}

TEST_F(MemberKeysTest, FromBeforeRobotsWereSentOnMissionsHoldAndSaySo) {
  EXPECT_THAT(LoadMemberKeys(scout_, now_)->lacks, IsEmpty());
  test::MakeOfBeforeMissions(authority_.folder(), scout_);
  const auto keys = LoadMemberKeys(scout_, now_);
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_THAT(keys->lacks, ElementsAre(exchange::Topic::kMissions));
}

TEST_F(MemberKeysTest, TellWhatIsMissing) {
  EXPECT_THAT(Fault(folder_ / "nothing"), HasSubstr("there is no folder"));
  EXPECT_THAT(Fault(authority_.folder()), HasSubstr("is the authority's own folder"));
  fs::remove(scout_ / "permissions.p7s");
  EXPECT_THAT(Fault(scout_), HasSubstr("permissions.p7s is missing"));
}

TEST_F(MemberKeysTest, ExpiredOrNotYetValidOnesSaySo) {
  const auto later = LoadMemberKeys(scout_, now_ + std::chrono::hours(24 * 31));
  ASSERT_FALSE(later);
  EXPECT_THAT(later.error().message, HasSubstr("trailcast keys renew robot1"));
  const auto early = LoadMemberKeys(scout_, now_ - std::chrono::hours(48));
  ASSERT_FALSE(early);
  EXPECT_THAT(early.error().message, HasSubstr("set this machine's clock"));
}

TEST_F(MemberKeysTest, RevokedOnesSaySo) {
  ASSERT_TRUE(authority_.Revoke("robot1", now_));
  EXPECT_THAT(Fault(scout_), HasSubstr("were revoked"));
  EXPECT_EQ(Fault(follower_), "");
}

TEST_F(MemberKeysTest, OpenToEverybodyAreRefused) {
  fs::permissions(scout_ / "identity.key", fs::perms::others_read, fs::perm_options::add);
  EXPECT_THAT(Fault(scout_), HasSubstr("chmod 600"));
}

TEST_F(MemberKeysTest, FilesOfDifferentMembersDoNotMix) {
  Copy(scout_ / "permissions.p7s", follower_ / "permissions.p7s");
  EXPECT_THAT(Fault(follower_), HasSubstr("permissions.p7s: is for CN=scout."));
  Copy(follower_ / "identity.key", scout_ / "identity.key");
  EXPECT_THAT(Fault(scout_), HasSubstr("identity.key: is not the key of identity.pem"));
}

TEST_F(MemberKeysTest, PermissionsFromBeforeARenewalDoNotFitTheNewKeys) {
  Copy(scout_ / "permissions.p7s", folder_ / "old.p7s");
  ASSERT_TRUE(authority_.Renew("robot1", Role::kFollower, now_, 30));
  EXPECT_EQ(Fault(scout_), "");
  Copy(folder_ / "old.p7s", scout_ / "permissions.p7s");
  EXPECT_THAT(Fault(scout_), HasSubstr("permissions.p7s: is for CN=scout."));
}

TEST_F(MemberKeysTest, AnotherRoleRevokesTheKeysOfTheEarlierOne) {
  fs::copy(scout_, folder_ / "old");
  ASSERT_TRUE(authority_.Renew("robot1", Role::kFollower, now_, 30));
  Copy(authority_.RevocationFile(), folder_ / "old" / "revoked.pem");
  EXPECT_THAT(Fault(folder_ / "old"), HasSubstr("were revoked"));
}

TEST_F(MemberKeysTest, OfAnotherFleetAreRefused) {
  const auto other = Authority::Create(folder_ / "other", now_, 3650).value();
  const fs::path foreign = other.Add("robot1", Role::kScout, now_, 30).value();
  Copy(foreign / "identity.pem", scout_ / "identity.pem");
  EXPECT_NE(Fault(scout_), "");
  Copy(foreign / "governance.p7s", follower_ / "governance.p7s");
  EXPECT_THAT(Fault(follower_), HasSubstr("governance.p7s: was not signed by"));
}

TEST_F(MemberKeysTest, AnotherNameWrittenIntoTheFolderIsFound) {
  Copy(follower_ / "member.toml", scout_ / "member.toml");
  EXPECT_THAT(Fault(scout_), HasSubstr("is of another member"));
}

TEST_F(MemberKeysTest, AChangedFileChangesTheVersion) {
  const std::string before = KeysVersion(scout_);
  EXPECT_EQ(KeysVersion(scout_), before);
  ASSERT_TRUE(authority_.Revoke("robot2", now_));
  EXPECT_NE(KeysVersion(scout_), before);
}

}  // namespace
}  // namespace trailcast::security
