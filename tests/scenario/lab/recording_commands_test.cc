// `trailcast align` and `trailcast judge` as their users run them, on recordings of their own.
#include <fstream>
#include <sstream>

#include "services/lab/trial/recording/reference.h"
#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int kFrames = 60;
constexpr int kBehind = 10;

class RecordingCommandsTest : public ProgramsTest {
 protected:
  Ended Tool(const Words& words) { return End(*Start("trailcast", words, "tool")); }
  // Two walks along one way, the second from a little further on.
  void RecordTwo() {
    WriteWalk(folder_ / "first", kFrames);
    WriteWalk(folder_ / "second", kFrames - kBehind, 160, 120, kBehind);
  }
  [[nodiscard]] std::string Text(const std::string& name) const {
    std::ifstream in(folder_ / name);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
};

TEST_F(RecordingCommandsTest, OnesOwnAreAlignedThenJudgedThenTold) {
  RecordTwo();
  const auto aligned = Tool({"align", Path("first"), Path("second"), "--out", Path("truth.csv"),
                             "--every", "5", "--teach-every", "5"});
  ASSERT_EQ(aligned.status, 0) << aligned.output;
  EXPECT_THAT(aligned.output, HasSubstr("10 frames of the replayed recording, 10 of them good"));
  const auto truth = trial::ReadReference(Path("truth.csv"));
  ASSERT_TRUE(truth) << truth.error().message;
  for (const trial::Alignment& row : *truth) {
    EXPECT_NEAR(row.teach_frame, row.replay_frame + kBehind, 5) << row.replay_frame;
    EXPECT_NEAR(row.median_du_px, 0.0, 2.0) << row.replay_frame;
  }
  const auto judged =
      Tool({"judge", Path("first"), Path("second"), "--truth", Path("truth.csv"), "--disturb",
            "none,noise=5", "--csv", Path("judged.csv"), "--plot", Path("judged.png")});
  ASSERT_EQ(judged.status, 0) << judged.output;
  EXPECT_THAT(judged.output, AllOf(HasSubstr("second on"), HasSubstr("noise=5")));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "judged.png"));
  const auto told = Tool({"figures", Path("judged.csv")});
  ASSERT_EQ(told.status, 0) << told.output;
  EXPECT_THAT(told.output, HasSubstr("| `noise=5`: within 5 %"));
}

TEST_F(RecordingCommandsTest, WhatWasTaughtIsKnownToBeTheSame) {
  RecordTwo();
  const auto judged = Tool({"judge", Path("first"), Path("first"), "--csv", Path("judged.csv")});
  ASSERT_EQ(judged.status, 0) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("identity"));
  EXPECT_THAT(Text("judged.csv"), HasSubstr(",identity,"));
}

TEST_F(RecordingCommandsTest, SayWhatIsWrong) {
  RecordTwo();
  const auto nothing = Tool({"judge"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.output, HasSubstr("a recording to teach and one to replay, or --pairs"));
  const auto absent = Tool({"judge", Path("first"), Path("third")});
  EXPECT_EQ(absent.status, 1);
  EXPECT_THAT(absent.output, HasSubstr("third"));
  const auto disturbance = Tool({"judge", Path("first"), Path("second"), "--disturb", "evry=3"});
  EXPECT_EQ(disturbance.status, 1);
  EXPECT_THAT(disturbance.output, HasSubstr("no disturbance 'evry'"));
  const auto unwritable = Tool(
      {"align", Path("first"), Path("second"), "--out", Path("no/truth.csv"), "--every", "50"});
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_THAT(unwritable.output, HasSubstr("no/truth.csv"));
}

}  // namespace
}  // namespace trailcast::test
