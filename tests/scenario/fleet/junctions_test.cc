// Where routes come to the same place, asked of stores and files.
#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class JunctionsTest : public ProgramsTest {
 protected:
  Ended Tool(const Words& words) { return End(*Start("trailcast", words, "tool")); }
  void Teach(const std::string& route, const std::string& frames) {
    const auto scout =
        RunAgent({"teach", "--frames", frames, "--route", route, "--store", Path("scout.db")});
    ASSERT_EQ(scout.status, 0) << scout.output;
  }
};

TEST_F(JunctionsTest, ARouteTaughtTwiceIsJoinedWithItself) {
  const std::string frames = Walk("taught", kTaughtFrames);
  Teach("hall", frames);
  Teach("annex", frames);
  const auto found = Tool({"junctions", "hall", "annex", "--store", Path("scout.db")});
  EXPECT_EQ(found.status, 0) << found.output;
  EXPECT_THAT(found.output,
              AllOf(HasSubstr("hall@0.0s annex@0.0s for "), HasSubstr("straight on")));
  const auto all = Tool({"junctions", "--store", Path("scout.db"), "--json"});
  EXPECT_THAT(all.output, AllOf(HasSubstr("\"routes\": 2"), HasSubstr("\"name\": \"annex\"")));

  for (const char* name : {"hall", "annex"}) {
    ASSERT_EQ(Tool({"export", name, "--store", Path("scout.db"), "--out",
                    Path(std::string(name) + ".trailcast")})
                  .status,
              0);
  }
  EXPECT_EQ(Tool({"junctions", Path("hall.trailcast"), Path("annex.trailcast")}).output,
            found.output);
}

TEST_F(JunctionsTest, WhatIsNotThereIsSaid) {
  Teach("hall", Walk("taught", kTaughtFrames));
  const auto alone = Tool({"junctions", "hall", "--store", Path("scout.db")});
  EXPECT_EQ(alone.status, 0);
  EXPECT_THAT(alone.output, HasSubstr("it does not come back to where it was"));
  EXPECT_EQ(Tool({"junctions"}).status, 2);
  const auto absent = Tool({"junctions", "--store", Path("absent.db")});
  EXPECT_EQ(absent.status, 1);
  EXPECT_THAT(absent.output, HasSubstr("there is no route store"));
  const auto unknown = Tool({"junctions", "yard", "hall", "--store", Path("scout.db")});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_THAT(unknown.output, HasSubstr("no complete route 'yard'"));
  EXPECT_EQ(Tool({"junctions", Path("scout.db")}).status, 1) << "no route file";
}

}  // namespace
}  // namespace trailcast::test
