// A teaching that is to be looked at before robots follow it, from its scout to the follower.
#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ReviewTest : public ProgramsTest {
 protected:
  ReviewTest() {
    Walk("taught", kTaughtFrames);
    Walk("seen", kFollowerFrames);
  }
  Ended Teach(const Words& more = {}) {
    return RunAgent(With(TeachWords(Path("taught"), "scout.db"), With({"--server"}, more)));
  }
  Ended Follow(const Words& more = {}) {
    return RunAgent(With(ReplayWords(Path("seen"), "follower.db"), With({"--server"}, more)));
  }
  Ended Tool(const Words& words) { return End(*Start("trailcast", words, "tool")); }
  // "a3f9c21@2", as it is listed.
  std::string Id(const std::string& revision) {
    const std::string table = Tool({"routes"}).output;
    const auto at = table.find(revision);
    if (at == std::string::npos) return "not listed";
    const auto begin = table.rfind(' ', at) + 1;
    return table.substr(begin, at + revision.size() - begin);
  }
};

TEST_F(ReviewTest, IsFollowedOnceAnOperatorHasLookedAtIt) {
  const auto server = Server();
  const auto scout = Teach({"--review"});
  ASSERT_EQ(scout.status, 0) << scout.output;
  const std::string id = Id("@1");
  EXPECT_THAT(scout.output,
              HasSubstr("(" + id +
                        ") is to be reviewed: robots follow no revision of the route until an "
                        "operator has looked at it and has them follow this one: 'trailcast "
                        "routes activate " +
                        id + "'"));
  EXPECT_THAT(Tool({"routes"}).output, HasSubstr("to be reviewed"));
  const auto too_early = Follow();
  EXPECT_EQ(too_early.status, 1);
  EXPECT_THAT(too_early.output,
              HasSubstr("server 'server' has no active revision of route 'hall'; it has " + id +
                        " (to be reviewed): 'trailcast routes activate " + id + "'"));

  EXPECT_THAT(Tool({"routes", "activate", "hall"}).output, HasSubstr("are to be reviewed"))
      << "only by its number";
  EXPECT_EQ(Tool({"export", id, "--out", Path("hall.trailcast")}).status, 0);
  EXPECT_EQ(Tool({"routes", "--name", "hall", "--long"}).status, 0);
  const auto tried = Follow({"--revision", "1", "--log", Path("run.mcap")});
  EXPECT_EQ(tried.status, 0) << tried.output;
  EXPECT_EQ(Tool({"explain", Path("run.mcap")}).status, 0);

  const auto activated = Tool({"routes", "activate", id});
  EXPECT_EQ(activated.status, 0) << activated.output;
  EXPECT_THAT(Tool({"routes"}).output, AllOf(HasSubstr("active"), Not(HasSubstr("review"))));
  const auto follower = Follow();
  EXPECT_EQ(follower.status, 0) << follower.output;
  EXPECT_THAT(follower.output, HasSubstr("state=ARRIVED"));
}

TEST_F(ReviewTest, MeanwhileRobotsGoOnAndItCanBeDiscarded) {
  const auto server = Server();
  ASSERT_EQ(Teach().status, 0);
  const auto again = Teach({"--review"});
  ASSERT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("is to be reviewed: robots go on with revision 1 until"));
  const auto follower = Follow();
  EXPECT_EQ(follower.status, 0) << follower.output;
  EXPECT_THAT(follower.output, HasSubstr("route 'hall' " + Id("@1")));

  const auto discarded = Tool({"routes", "delete", Id("@2")});
  EXPECT_EQ(discarded.status, 0) << discarded.output;
  EXPECT_THAT(Tool({"routes"}).output, AllOf(HasSubstr("@1"), Not(HasSubstr("@2"))));
}

TEST_F(ReviewTest, WaitsForItAtAServerToWhichItIsDeliveredLater) {
  EXPECT_EQ(RunAgent(With(TeachWords(Path("taught"), "scout.db"), {"--review"})).status, 0);
  const auto own = RunAgent(ReplayWords(Path("seen"), "scout.db"));
  EXPECT_EQ(own.status, 1);
  EXPECT_THAT(own.output, HasSubstr("(to be reviewed)"));
  const auto server = Server();
  const auto delivered = RunAgent({"deliver", "--store", Path("scout.db")});
  EXPECT_EQ(delivered.status, 0) << delivered.output;
  EXPECT_THAT(delivered.output, HasSubstr("is to be reviewed: "));
  EXPECT_THAT(Tool({"routes"}).output, HasSubstr("to be reviewed"));
}

}  // namespace
}  // namespace trailcast::test
