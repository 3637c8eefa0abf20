#include "services/lab/trial/judge/recording_pair.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::trial {
namespace {

using testing::HasSubstr;

class RecordingPairs : public testing::Test {
 protected:
  Result<std::vector<RecordingPair>> Read(const std::string& text) {
    std::ofstream(folder_ / "pairs.csv") << text;
    return ReadPairs(folder_ / "pairs.csv", "/data");
  }
  std::string Refusal(const std::string& text) {
    const auto read = Read(text);
    return read ? "none" : read.error().message;
  }
  test::TempDir folder_;
};

TEST_F(RecordingPairs, AreReadByTheNamesOfTheirColumns) {
  const auto pairs = Read(
      "kind,teach,replay,truth,steering,disturb,set,rate,replay_odometry\n"
      "right,hall/a,hall/b,hall/truth.csv,hall/steering.csv,every=3,held out,20,hall/b.csv\r\n"
      "wrong,hall/a,yard/c,,,,tuned,,\n");
  ASSERT_TRUE(pairs) << pairs.error().message;
  ASSERT_EQ(pairs->size(), 2U);
  const RecordingPair& right = pairs->front();
  EXPECT_EQ(right.kind, PairKind::kRight);
  EXPECT_EQ(right.set, "held out");
  EXPECT_EQ(right.teach_name, "hall/a");
  EXPECT_EQ(right.teach.frames, "/data/hall/a");
  EXPECT_TRUE(right.teach.odometry.empty());
  EXPECT_EQ(right.teach.rate_hz, 20.0);
  EXPECT_EQ(right.replay.odometry, "/data/hall/b.csv");
  EXPECT_EQ(right.reference, "/data/hall/truth.csv");
  EXPECT_EQ(right.disturbance, "every=3");
  const RecordingPair& wrong = pairs->back();
  EXPECT_EQ(wrong.kind, PairKind::kWrong);
  EXPECT_TRUE(wrong.reference.empty());
  EXPECT_FALSE(wrong.replay.rate_hz);
}

TEST_F(RecordingPairs, TwoColumnsAreEnough) {
  const auto pairs = Read("teach,replay\na,/elsewhere/b\n");
  ASSERT_TRUE(pairs) << pairs.error().message;
  EXPECT_EQ(pairs->front().kind, PairKind::kRight);
  EXPECT_EQ(pairs->front().replay.frames, "/elsewhere/b");
}

TEST_F(RecordingPairs, SayWhatIsWrongAndWhere) {
  EXPECT_THAT(Refusal("teach,repaly\na,b\n"),
              HasSubstr("line 1: there is no column 'repaly'; there are: kind"));
  EXPECT_THAT(Refusal("teach,replay\na,b\na\n"), HasSubstr("line 3: expected 2 cells, not 1"));
  EXPECT_THAT(Refusal("teach,replay\na,\n"), HasSubstr("line 2: expected a recording"));
  EXPECT_THAT(Refusal("teach,replay,kind\na,b,good\n"), HasSubstr("not 'good'"));
  EXPECT_THAT(Refusal("teach,replay,disturb\na,b,sleep\n"), HasSubstr("no disturbance 'sleep'"));
  EXPECT_THAT(Refusal("teach,replay,rate\na,b,-2\n"), HasSubstr("not '-2'"));
  EXPECT_THAT(Refusal("teach,replay\n"), HasSubstr("lists no pairs"));
  EXPECT_THAT(ReadPairs(folder_ / "absent.csv", "/data").error().message, HasSubstr("absent.csv"));
}

}  // namespace
}  // namespace trailcast::trial
