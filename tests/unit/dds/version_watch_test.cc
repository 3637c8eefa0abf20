#include "services/dds/src/version_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr bool kWithKeys = true;

Peers::SaidOfItself Said(const std::string& name, std::optional<std::uint32_t> version) {
  return {.about = "participant of " + name, .name = name, .version = version};
}

class VersionWatchTest : public testing::Test {
 protected:
  VersionWatch open_{4, !kWithKeys};
  VersionWatch keyed_{4, kWithKeys};
  VersionWatch::Time now_{};
};

TEST_F(VersionWatchTest, AnOlderOneIsToldOfOnceAndAgainAfterAWhile) {
  open_.See("1:2:3", Said("robot1", 3));
  EXPECT_THAT(open_.Tick(now_),
              ElementsAre("'robot1' speaks version 3 of Trailcast's protocol, this program version "
                          "4: what has changed between them is not heard; update it"));
  open_.See("1:2:3", Said("robot1", 3));  // it calls
  EXPECT_THAT(open_.Tick(now_ + VersionWatch::kAgain - std::chrono::seconds(1)), IsEmpty());
  EXPECT_THAT(open_.Tick(now_ + VersionWatch::kAgain), ElementsAre(HasSubstr("'robot1'")));
}

TEST_F(VersionWatchTest, OfANewerOneItIsThisProgramThatIsToBeUpdated) {
  open_.See("1:2:3", Said("robot1", 5));
  EXPECT_THAT(open_.Tick(now_), ElementsAre(HasSubstr("update this program")));
}

TEST_F(VersionWatchTest, WhoSaysNoVersionIsOfBeforeTheFirst) {
  open_.See("1:2:3", Said("robot1", std::nullopt));
  EXPECT_THAT(open_.Tick(now_), ElementsAre(HasSubstr("'robot1' speaks a version before 3")));
}

TEST_F(VersionWatchTest, ManyAreALineForEachVersion) {
  for (int i = 0; i < 9; ++i) {
    const std::string digit = std::to_string(i);
    open_.See("1:2:" + digit, Said("robot" + digit, i < 7 ? 3 : 5));
  }
  EXPECT_THAT(open_.Tick(now_),
              ElementsAre(HasSubstr("'robot3', 'robot4' and 2 more speak version 3"),
                          HasSubstr("'robot7', 'robot8' speak version 5")));
}

TEST_F(VersionWatchTest, ACommandIsNotToldOfAtEveryCall) {
  open_.See("1:2:3", Said("desk-p17", 3));
  EXPECT_THAT(open_.Tick(now_), ElementsAre(HasSubstr("'desk'")));
  open_.Lose("1:2:3");
  open_.See("4:5:6", Said("desk-p18", 3));
  EXPECT_THAT(open_.Tick(now_), IsEmpty());
}

TEST_F(VersionWatchTest, TheSameVersionOthersDdsAndRobotsEndsAreNotTold) {
  open_.See("1:2:3", Said("robot1", 4));
  open_.See("1:2:4", Said("", std::nullopt));
  open_.See("1:2:5", Said("enclave=/;", std::nullopt));
  open_.See("1:2:6", Said("trailcast", std::nullopt));
  open_.See("1:2:7", Said("", 3));  // with keys, which is another matter
  EXPECT_THAT(open_.Tick(now_), IsEmpty());
}

TEST_F(VersionWatchTest, WhoWentIsNotToldOf) {
  open_.See("1:2:3", Said("robot1", 3));
  open_.Lose("1:2:3");
  open_.See("4:5:6", Said("robot2", 3));
  open_.Forget();
  EXPECT_THAT(open_.Tick(now_), IsEmpty());
}

TEST_F(VersionWatchTest, WithKeysOnlyMembersAreToldOf) {
  keyed_.See("1:2:3", {.about = "participant 1:2:3", .version = 3});
  keyed_.See("4:5:6", Said("stranger", 3));
  keyed_.Prove("7:8:9");  // not seen yet
  EXPECT_THAT(keyed_.Tick(now_), IsEmpty());
  keyed_.Prove("1:2:3");
  EXPECT_THAT(keyed_.Tick(now_), ElementsAre(HasSubstr("participant 1:2:3 speaks version 3")));
  keyed_.See("7:8:9", {.about = "participant 7:8:9"});
  EXPECT_THAT(keyed_.Tick(now_), ElementsAre(HasSubstr("7:8:9 speaks a version before 3")));
}

}  // namespace
}  // namespace trailcast::dds
