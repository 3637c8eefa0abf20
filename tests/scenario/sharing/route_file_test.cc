// A route carried from one route server to another in a file.
#include <fstream>
#include <iterator>

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RouteFileTest : public ProgramsTest {
 protected:
  Ended Tool(const Words& words) { return End(*Start("trailcast", words, "tool")); }
  void Teach(const Words& more) {
    const auto scout = RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), more));
    ASSERT_EQ(scout.status, 0) << scout.output;
  }
  [[nodiscard]] std::string Bytes(const std::string& name) const {
    std::ifstream in(Path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(RouteFileTest, ARouteGoesFromOneServerToAnotherAndIsTheSame) {
  const auto barn = Server("barn.db", "barn");
  Teach({"--server", "--tag", "night", "--tag", "east", "--place-site", "3.5,-2"});
  const auto exported = Tool({"export", "hall", "--out", Path("hall.trailcast")});
  ASSERT_EQ(exported.status, 0) << exported.output;
  EXPECT_THAT(exported.output, HasSubstr("route 'hall' revision 1"));
  const auto checked = Tool({"import", "--check", Path("hall.trailcast")});
  EXPECT_EQ(checked.status, 0);
  EXPECT_THAT(checked.output, AllOf(HasSubstr("is whole"), HasSubstr("east night"),
                                    HasSubstr("x 3.5 m, y -2 m (site)")));

  tag_ += "-2";  // another network
  const auto alone = Tool({"import", Path("hall.trailcast"), "--timeout", "0.5"});
  EXPECT_EQ(alone.status, 1);
  EXPECT_THAT(alone.output, HasSubstr("no route server answered"));
  const auto shed = Server("shed.db", "shed");
  const auto imported = Tool({"import", Path("hall.trailcast")});
  EXPECT_EQ(imported.status, 0) << imported.output;
  EXPECT_THAT(imported.output, HasSubstr("is there now: server 'server'"));
  const auto again = Tool({"import", Path("hall.trailcast")});
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("was there already"));

  ASSERT_EQ(Tool({"export", "hall", "--out", Path("back.trailcast")}).status, 0);
  EXPECT_EQ(Bytes("back.trailcast"), Bytes("hall.trailcast"));
  const auto follower =
      RunAgent(With(ReplayWords(Walk("seen", kFollowerFrames), "follower.db"), {"--server"}));
  EXPECT_EQ(follower.status, 0) << follower.output;
}

TEST_F(RouteFileTest, AStoreNeedsNoNetworkToGiveAndTakeRoutes) {
  Teach({});
  const Words exporting{"export",         "hall",  "--store",
                        Path("scout.db"), "--out", Path("hall.trailcast")};
  EXPECT_EQ(Tool(exporting).status, 0);
  const auto twice = Tool(exporting);
  EXPECT_EQ(twice.status, 1);
  EXPECT_THAT(twice.output, HasSubstr("hall.trailcast is there already"));
  EXPECT_EQ(Tool(With(exporting, {"--force"})).status, 0);

  const Words importing{"import", Path("hall.trailcast"), "--store", Path("other.db")};
  EXPECT_THAT(Tool(importing).output, HasSubstr("is there now: route store " + Path("other.db")));
  EXPECT_THAT(Tool(importing).output, HasSubstr("was there already"));
  EXPECT_EQ(
      Tool({"export", "hall", "--store", Path("other.db"), "--out", Path("back.trailcast")}).status,
      0);
  EXPECT_EQ(Bytes("back.trailcast"), Bytes("hall.trailcast"));

  const auto server = Server("other.db");
  const auto in_use = Tool(importing);
  EXPECT_EQ(in_use.status, 1);
  EXPECT_THAT(in_use.output, HasSubstr("is open in another process"));
  const auto absent = Tool({"export", "hall", "--store", Path("absent.db")});
  EXPECT_EQ(absent.status, 1);
  EXPECT_THAT(absent.output, HasSubstr("there is no route store"));
  EXPECT_FALSE(std::filesystem::exists(Path("absent.db")));
}

TEST_F(RouteFileTest, ADamagedFileIsRefusedAndTheOthersAreImported) {
  Teach({});
  ASSERT_EQ(
      Tool({"export", "hall", "--store", Path("scout.db"), "--out", Path("hall.trailcast")}).status,
      0);
  std::string bytes = Bytes("hall.trailcast");
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(Path("bad.trailcast"), std::ios::binary) << bytes;
  const auto run = Tool({"import", Path("bad.trailcast"), Path("scout.db"), Path("hall.trailcast"),
                         "--store", Path("other.db")});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("bad.trailcast: it is damaged"),
                                HasSubstr("scout.db: it is no route file"),
                                HasSubstr("hall.trailcast: route 'hall' revision 1")));
  const auto checked = Tool({"import", "--check", "--json", Path("bad.trailcast")});
  EXPECT_EQ(checked.status, 1);
  EXPECT_THAT(checked.output,
              AllOf(HasSubstr("\"whole\": false"), Not(HasSubstr("\"whole\": true"))));
}

}  // namespace
}  // namespace trailcast::test
