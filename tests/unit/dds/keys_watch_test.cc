#include "services/dds/src/keys_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "services/base/durable_file.h"
#include "services/security/authority.h"
#include "services/security/src/files.h"
#include "tests/support/temp_dir.h"

namespace trailcast::dds {
namespace {

namespace fs = std::filesystem;
using security::ReadSmallFile;
using security::Role;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// A robot with a copy of its folder, in a fleet whose authority goes on.
class KeysWatchTest : public testing::Test {
 protected:
  KeysWatchTest() {
    if (!authority_.Add("robot2", Role::kScout, now_, 30)) throw std::runtime_error("no robot2");
    fs::copy(given_, keys_folder_);
    held_ = security::LoadMemberKeys(keys_folder_, now_).value();
    watch_.emplace(held_, [this](const std::string& line) { told_.push_back(line); });
  }
  // The authority's, after one more was revoked.
  std::string NewList() {
    if (!authority_.Revoke("robot2", now_)) throw std::runtime_error("not revoked");
    return ReadSmallFile(authority_.RevocationFile()).value();
  }
  bool Take(const std::string& text) { return watch_->TakeList(text, "server/1", held_); }
  std::uint64_t NumberInFolder() const { return security::RevocationListIn(keys_folder_)->number; }
  void PutIntoFolder(const std::string& list) {
    ASSERT_TRUE(ReplaceFile(keys_folder_ / "revoked.pem", list));
  }
  // Nobody, root neither, writes a file where a folder with things in it is.
  void LetNothingBeWritten() {
    fs::create_directories(keys_folder_ / fmt::format("revoked.pem.{}.new", getpid()) / "inside");
  }

  test::TempDir folder_;
  const security::Time now_ = std::chrono::system_clock::now();
  const security::Authority authority_ =
      security::Authority::Create(folder_ / "fleet", now_, 3650).value();
  const fs::path given_ = authority_.Add("robot1", Role::kScout, now_, 30).value();
  const fs::path keys_folder_ = folder_ / "keys";
  security::MemberKeys held_;
  std::vector<std::string> told_;
  std::optional<KeysWatch> watch_;
};

TEST_F(KeysWatchTest, ANewerListIsToBeJoinedWithAndGoesIntoTheFolder) {
  EXPECT_FALSE(watch_->Look(held_));
  EXPECT_TRUE(Take(NewList()));
  EXPECT_EQ(held_.revoked.number, 2U);
  EXPECT_EQ(NumberInFolder(), 2U);
  EXPECT_FALSE(watch_->Look(held_)) << "what the watch wrote itself is no news";
  EXPECT_FALSE(Take(held_.revoked.text)) << "the same again";
  EXPECT_THAT(told_, ElementsAre(AllOf(HasSubstr("list 2 of revoked keys (1 certificate"),
                                       HasSubstr("came from server/1"))));
}

TEST_F(KeysWatchTest, WhatElseChangedInTheFolderIsTakenUpAllTheSame) {
  fs::last_write_time(keys_folder_ / "authority.pem", fs::file_time_type::clock::now());
  EXPECT_TRUE(Take(NewList()));
  EXPECT_TRUE(watch_->Look(held_));
}

TEST_F(KeysWatchTest, AListIsTakenWhileTheFolderIsBeingCopied) {
  fs::remove(keys_folder_ / "identity.pem");
  EXPECT_FALSE(watch_->Look(held_));
  EXPECT_TRUE(Take(NewList()));
  EXPECT_EQ(held_.revoked.number, 2U);
}

TEST_F(KeysWatchTest, WhatIsRefusedIsToldOnceAndNothingIsWritten) {
  const std::string before = security::KeysVersion(keys_folder_);
  const auto other = security::Authority::Create(folder_ / "other", now_, 30).value();
  ASSERT_TRUE(other.Add("robot1", Role::kScout, now_, 30));
  ASSERT_TRUE(other.Revoke("robot1", now_));
  const std::string foreign = ReadSmallFile(other.RevocationFile()).value();
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(Take(foreign));
    EXPECT_FALSE(Take("nothing"));
  }
  EXPECT_THAT(told_, ElementsAre(AllOf(HasSubstr("refused what server/1 sent"),
                                       HasSubstr("not signed by the fleet's authority")),
                                 HasSubstr("is no revocation list")));
  EXPECT_EQ(security::KeysVersion(keys_folder_), before);
}

TEST_F(KeysWatchTest, AnOlderListIsRefused) {
  const std::string first = held_.revoked.text;
  ASSERT_TRUE(Take(NewList()));
  EXPECT_FALSE(Take(first));
  EXPECT_THAT(told_.back(), HasSubstr("list 1 of revoked keys"));
  EXPECT_EQ(NumberInFolder(), 2U);
}

TEST_F(KeysWatchTest, WhereNothingCanBeWrittenTheListHoldsForTheRun) {
  LetNothingBeWritten();
  EXPECT_TRUE(Take(NewList()));
  EXPECT_EQ(held_.revoked.number, 2U);
  EXPECT_EQ(NumberInFolder(), 1U);
  EXPECT_THAT(told_.back(), AllOf(HasSubstr("list 2 of revoked keys"),
                                  HasSubstr("holds for this run alone: cannot write")));
  // Also when other files of the folder change.
  fs::last_write_time(keys_folder_ / "authority.pem", fs::file_time_type::clock::now());
  const auto keys = watch_->Look(held_);
  ASSERT_TRUE(keys);
  EXPECT_EQ(keys->revoked.number, 2U);
}

TEST_F(KeysWatchTest, AnOlderListInTheFolderIsReplacedByTheOneHeld) {
  const std::string first = held_.revoked.text;
  ASSERT_TRUE(Take(NewList()));
  PutIntoFolder(first);  // the folder was copied from a stick, say
  EXPECT_FALSE(watch_->Look(held_));
  EXPECT_EQ(NumberInFolder(), 2U);
  const auto keys = watch_->Look(held_);
  ASSERT_TRUE(keys);
  EXPECT_EQ(keys->revoked.number, 2U);
  EXPECT_FALSE(watch_->Look(*keys));
}

TEST_F(KeysWatchTest, KeysOfAnotherFleetComeWithThatFleetsList) {
  ASSERT_TRUE(Take(NewList()));
  const auto other = security::Authority::Create(folder_ / "other", now_, 30).value();
  fs::copy(*other.Add("robot1", Role::kScout, now_, 30), keys_folder_,
           fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  const auto keys = watch_->Look(held_);
  ASSERT_TRUE(keys);
  EXPECT_EQ(keys->revoked.number, 1U);
}

}  // namespace
}  // namespace trailcast::dds
