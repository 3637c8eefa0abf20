#include "services/dds/src/domain/server_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace trailcast::dds {
namespace {

using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;

// Looks names up in a table, at once unless the answers are kept back.
class ServerNamesTest : public testing::Test {
 protected:
  LookUp InTable() {
    return [this](const std::string& name) {
      ++asked_;
      std::promise<Result<Addresses>> answer;
      auto future = answer.get_future();
      if (kept_back_) {
        late_.push_back(std::move(answer));
      } else {
        answer.set_value(AnswerFor(name));
      }
      return future;
    };
  }
  Result<Addresses> AnswerFor(const std::string& name) const {
    const auto found = table_.find(name);
    if (found == table_.end()) return Fail(ErrorCode::kUnavailable, "'{}' leads nowhere", name);
    return found->second;
  }
  // The first change within `time`, asked every second.
  std::string ChangeWithin(seconds time, ServerNames& names) {
    for (const auto until = now_ + time; now_ < until;) {
      now_ += seconds(1);
      const std::string change =
          names.Look([this](const std::string& address) { return heard_.contains(address); }, now_);
      if (!change.empty()) return change;
    }
    return "";
  }

  std::map<std::string, Addresses> table_{{"server.example", {"10.0.0.1"}}};
  std::set<std::string> heard_;
  int asked_ = 0;
  bool kept_back_ = false;
  std::vector<std::promise<Result<Addresses>>> late_;
  ServerNames::Time now_ = ServerNames::Time() + seconds(1000);
};

TEST_F(ServerNamesTest, AreFoundInTheirOrderAndAnAddressIsNotLookedUp) {
  ServerNames names({"10.0.0.9", "server.example"}, InTable());
  ASSERT_TRUE(names.FindAll());
  EXPECT_THAT(names.addresses(), ElementsAre("10.0.0.9", "10.0.0.1"));
  EXPECT_EQ(asked_, 1);
  ASSERT_TRUE(names.FindAll());
  EXPECT_EQ(asked_, 1) << "what is known is not asked for again";
}

TEST_F(ServerNamesTest, OneThatLeadsNowhereIsNamedAndTheOthersAreKnown) {
  ServerNames names({"none.example", "server.example"}, InTable());
  const auto found = names.FindAll();
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(found.error().message, HasSubstr("'none.example'"));
  EXPECT_THAT(names.addresses(), ElementsAre("10.0.0.1"));
  heard_ = {"10.0.0.1"};
  EXPECT_EQ(ChangeWithin(seconds(30), names), "");
  table_["none.example"] = {"10.0.0.2"};
  EXPECT_EQ(ChangeWithin(ServerNames::kAtMost + seconds(2), names),
            "the server address 'none.example' leads to 10.0.0.2 now");
  EXPECT_THAT(names.addresses(), ElementsAre("10.0.0.2", "10.0.0.1"));
}

TEST_F(ServerNamesTest, AreNotLookedUpWhileTheServerIsHeard) {
  ServerNames names({"server.example"}, InTable());
  ASSERT_TRUE(names.FindAll());
  heard_ = {"10.0.0.1"};
  table_["server.example"] = {"10.0.0.2"};
  EXPECT_EQ(ChangeWithin(seconds(600), names), "");
  EXPECT_EQ(asked_, 1);
}

TEST_F(ServerNamesTest, OneThatIsNotHeardIsFollowedToItsOtherAddress) {
  ServerNames names({"server.example"}, InTable());
  ASSERT_TRUE(names.FindAll());
  EXPECT_EQ(ChangeWithin(ServerNames::kMissed - seconds(1), names), "");
  table_["server.example"] = {"10.0.0.2"};
  EXPECT_EQ(ChangeWithin(seconds(4), names),
            "the server address 'server.example' leads to 10.0.0.2 now instead of 10.0.0.1");
  EXPECT_THAT(names.addresses(), ElementsAre("10.0.0.2"));
}

TEST_F(ServerNamesTest, OneThatIsGoneIsAskedForEverMoreRarelyAndKeepsItsAddress) {
  ServerNames names({"server.example"}, InTable());
  ASSERT_TRUE(names.FindAll());
  table_.clear();
  EXPECT_EQ(ChangeWithin(seconds(600), names), "");
  EXPECT_THAT(names.addresses(), ElementsAre("10.0.0.1"));
  EXPECT_GE(asked_, 10);
  EXPECT_LE(asked_, 16);
}

TEST_F(ServerNamesTest, AnAnswerWithSomeOfTheKnownAddressesChangesNothing) {
  table_["server.example"] = {"10.0.0.1", "10.0.0.2"};
  ServerNames names({"server.example"}, InTable());
  ASSERT_TRUE(names.FindAll());
  table_["server.example"] = {"10.0.0.2"};
  EXPECT_EQ(ChangeWithin(seconds(60), names), "");
  EXPECT_THAT(names.addresses(), ElementsAre("10.0.0.1", "10.0.0.2"));
}

TEST_F(ServerNamesTest, AnAnswerThatIsLateIsWaitedForByNobody) {
  ServerNames names({"server.example"}, InTable());
  ASSERT_TRUE(names.FindAll());
  kept_back_ = true;
  EXPECT_EQ(ChangeWithin(seconds(120), names), "");
  ASSERT_EQ(asked_, 2) << "one question at a time";
  late_.front().set_value(Addresses{"10.0.0.2"});
  EXPECT_THAT(ChangeWithin(seconds(1), names), HasSubstr("leads to 10.0.0.2 now"));
}

TEST(AskTheSystem, KnowsThisMachineAndTellsWhatItDoesNotKnow) {
  EXPECT_THAT(AskTheSystem("localhost").get().value(), testing::Contains("127.0.0.1"));
  const auto none = AskTheSystem("no such host").get();
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(none.error().message, HasSubstr("'no such host' leads nowhere"));
}

}  // namespace
}  // namespace trailcast::dds
