#include <gmock/gmock.h>

#include <fstream>

#include "services/lab/trial/judge/frames_csv.h"
#include "services/lab/trial/judge/recording_batch.h"
#include "services/lab/trial/judge/recording_csv.h"
#include "services/lab/trial/judge/recording_plot.h"
#include "services/lab/trial/judge/src/recording_view.h"
#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"

namespace trailcast::trial {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kFrames = 120;

// Two walks at a wall: the second one as the first, a little behind.
class RecordingTrialTest : public testing::Test {
 protected:
  RecordingTrialTest() {
    test::WriteWalk(folder_ / "first", kFrames);
    test::WriteWalk(folder_ / "second", kFrames - 20, 160, 120, 10);
  }
  RecordingPair Pair(const std::string& replay, PairKind kind = PairKind::kRight) const {
    RecordingPair pair;
    pair.kind = kind;
    pair.teach_name = "first";
    pair.replay_name = replay;
    pair.teach.frames = folder_ / "first";
    pair.replay.frames = folder_ / replay;
    return pair;
  }
  // Frame i of the second walk was taken where frame i + 10 of the first one was.
  std::filesystem::path Truth() const {
    Reference reference;
    for (int i = 0; i < kFrames - 20; i += 2) reference.push_back({i, i + 10, 40, 0.0, true});
    EXPECT_TRUE(WriteReference(reference, folder_ / "truth.csv"));
    return folder_ / "truth.csv";
  }
  static std::vector<RecordingOutcome> Run(const std::vector<RecordingPair>& pairs, int jobs = 1,
                                           const RecordingOptions& options = {}) {
    std::vector<RecordingOutcome> outcomes;
    for (Result<RecordingOutcome>& outcome : RunRecordingTrials(pairs, options, jobs, {})) {
      EXPECT_TRUE(outcome) << outcome.error().message;
      if (outcome) outcomes.push_back(*std::move(outcome));
    }
    return outcomes;
  }
  test::TempDir folder_;
};

TEST_F(RecordingTrialTest, WhatWasTaughtIsFollowedWhereItIs) {
  // Right is within a twentieth of the route. A robot does not know where on the first decimetre it
  // begins, so that the route has to be longer than twenty of these.
  constexpr int kLong = 200;
  test::WriteWalk(folder_ / "long", kLong);
  RecordingPair pair = Pair("long", PairKind::kIdentity);
  pair.teach.frames = folder_ / "long";
  const auto outcomes = Run({pair});
  ASSERT_THAT(outcomes, SizeIs(1));
  const RecordingRow& row = outcomes[0].row;
  EXPECT_EQ(row.error, "");
  EXPECT_GT(row.segments, 1);
  EXPECT_EQ(row.verdict.frames, kLong);
  EXPECT_EQ(row.verdict.aligned, kLong);
  EXPECT_EQ(row.verdict.following, kLong);
  EXPECT_GT(row.verdict.right, kLong * 9 / 10);
}

TEST_F(RecordingTrialTest, PlacesAreFramesOfTheTaughtRecording) {
  RecordingPair pair = Pair("second");
  pair.reference = Truth();
  const auto outcomes = Run({pair});
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_EQ(outcomes[0].row.verdict.aligned, (kFrames - 20) / 2);
  const auto& said = outcomes[0].replayed.said;
  ASSERT_THAT(said, SizeIs(kFrames - 20));
  // It begins at the route's start and catches up.
  EXPECT_NEAR(said[90].teach_frame, 100.0, 8.0);
}

TEST_F(RecordingTrialTest, SidesAreHeldAgainstTheRoutesOwnTurnsToo) {
  RecordingPair pair = Pair("second");
  Reference reference;
  for (int i = 0; i < kFrames - 20; ++i) reference.push_back({i, i + 10, 40, 5.0, true});
  ASSERT_TRUE(WriteReference(reference, folder_ / "aside.csv"));
  pair.reference = folder_ / "aside.csv";
  const auto outcomes = Run({pair});
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_GT(outcomes[0].row.verdict.sided, 50);
  EXPECT_GT(outcomes[0].row.verdict.corrected, 50);
}

TEST_F(RecordingTrialTest, ThreadsAndOrderChangeNothing) {
  std::vector<RecordingPair> pairs{Pair("first", PairKind::kIdentity), Pair("second"),
                                   Pair("second"), Pair("first", PairKind::kIdentity)};
  pairs[1].disturbance = "jump=2+noise=6";
  pairs[2].reference = Truth();
  const auto alone = Run(pairs, 1);
  const auto together = Run(pairs, 4);
  ASSERT_THAT(together, SizeIs(alone.size()));
  for (std::size_t i = 0; i < alone.size(); ++i) {
    RecordingRow one = alone[i].row;
    RecordingRow other = together[i].row;
    one.ms_per_frame = other.ms_per_frame = 0.0;
    EXPECT_EQ(RecordingCsvLine(one), RecordingCsvLine(other));
  }
}

TEST_F(RecordingTrialTest, EachPairIsTaughtAtItsOwnRate) {
  std::vector<RecordingPair> pairs{Pair("second"), Pair("second")};
  pairs[0].teach.rate_hz = pairs[0].replay.rate_hz = 5.0;
  pairs[1].teach.rate_hz = pairs[1].replay.rate_hz = 30.0;
  const auto together = Run(pairs);
  const auto alone = Run({pairs[1]});
  ASSERT_THAT(together, SizeIs(2));
  ASSERT_THAT(alone, SizeIs(1));
  const auto& said = alone[0].replayed.said;
  ASSERT_THAT(together[1].replayed.said, SizeIs(said.size()));
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_EQ(together[1].replayed.said[i].teach_frame, said[i].teach_frame) << i;
  }
}

TEST_F(RecordingTrialTest, ADisturbedReplayIsJudgedByWhatItShows) {
  RecordingPair pair = Pair("first", PairKind::kIdentity);
  pair.disturbance = "every=3";
  const auto outcomes = Run({pair});
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_EQ(outcomes[0].row.disturbance, "every=3");
  EXPECT_EQ(outcomes[0].row.verdict.frames, kFrames / 3);
  EXPECT_EQ(outcomes[0].row.verdict.aligned, kFrames / 3);
  ASSERT_TRUE(outcomes[0].truth[5]);
  EXPECT_EQ(outcomes[0].truth[5]->teach_frame, 15);
}

TEST_F(RecordingTrialTest, ARecordingThatTeachesNothingIsAnOutcome) {
  std::filesystem::create_directories(folder_ / "dark");
  for (int i = 0; i < 5; ++i) {
    const image::GrayImage black{160, 120, std::vector<std::uint8_t>(19200)};
    ASSERT_TRUE(image::WritePng(black, folder_ / "dark" / (std::to_string(i) + ".png")));
  }
  RecordingPair pair = Pair("first", PairKind::kWrong);
  pair.teach.frames = folder_ / "dark";
  const auto outcomes = Run({pair});
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_THAT(outcomes[0].row.error, HasSubstr("teaching gave no segment"));
  EXPECT_EQ(outcomes[0].row.verdict.frames, kFrames);
  EXPECT_EQ(outcomes[0].row.verdict.following, 0);
}

TEST_F(RecordingTrialTest, APairWithAnAbsentFileIsNamedAndTheOthersGoOn) {
  RecordingPair pair = Pair("second");
  pair.reference = folder_ / "absent.csv";
  const auto outcomes = RunRecordingTrials({pair, Pair("third"), Pair("second")}, {}, 1, {});
  ASSERT_THAT(outcomes, SizeIs(3));
  ASSERT_FALSE(outcomes[0]);
  EXPECT_THAT(outcomes[0].error().message,
              testing::StartsWith("cannot read " + pair.reference.string()));
  ASSERT_FALSE(outcomes[1]);
  EXPECT_THAT(outcomes[1].error().message, HasSubstr("third"));
  EXPECT_TRUE(outcomes[2]);
}

TEST_F(RecordingTrialTest, ARecordingThatManyPairsLackIsNamedOnce) {
  RecordingPair unseen = Pair("second");
  unseen.teach.frames = folder_ / "third";
  RecordingPair other = Pair("second");
  other.reference = folder_ / "absent.csv";
  const auto errors = ErrorsOf(
      RunRecordingTrials({Pair("third"), unseen, Pair("second"), other, Pair("third")}, {}, 2, {}));
  ASSERT_THAT(errors, SizeIs(2));
  EXPECT_THAT(errors[0].message, testing::AllOf(testing::StartsWith("no recorded run at " +
                                                                    (folder_ / "third").string()),
                                                testing::EndsWith(" (so for 3 pairs)")));
  EXPECT_THAT(errors[1].message, HasSubstr("absent.csv"));
}

TEST_F(RecordingTrialTest, ProgressGoesFromNothingToAll) {
  double last = 0.0;
  int ended = 0;
  const auto outcomes = RunRecordingTrials({Pair("second")}, {}, 1, [&](double share, int count) {
    EXPECT_GE(share, last - 1e-9);
    last = share;
    ended = count;
  });
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_NEAR(last, 1.0, 1e-9);
  EXPECT_EQ(ended, 1);
}

TEST_F(RecordingTrialTest, IsDrawnLoggedAndWrittenFrameByFrame) {
  RecordingOptions options;
  options.logs = folder_ / "logs";
  RecordingPair pair = Pair("second");
  pair.reference = Truth();
  const auto outcomes = Run({pair}, 1, options);
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "logs" / "second-on-first-none-default.mcap"));
  EXPECT_FALSE(DrawRecordings(outcomes).Render().empty());
  EXPECT_LT(DrawRecordings({outcomes[0], outcomes[0]}).height(),
            3 * DrawRecordings(outcomes).height());
  ASSERT_TRUE(WriteFramesCsv(outcomes, folder_ / "frames"));
  std::ifstream in(folder_ / "frames" / "second-on-first-none-default.csv");
  std::string line;
  int lines = 0;
  while (std::getline(in, line)) ++lines;
  EXPECT_EQ(lines, 1 + kFrames - 20);
}

class RecordingViewTest : public RecordingTrialTest {
 protected:
  // Half a metre a frame, straight on, at two frames a second.
  agent::RecordedRun Run() const {
    std::ofstream odometry(folder_ / "odometry.csv");
    odometry << "t_s,x_m,y_m,heading_rad\n";
    for (int i = 0; i < kFrames; ++i) odometry << 0.5 * i << ',' << 0.5 * i << ",0,0\n";
    return {folder_ / "first", folder_ / "odometry.csv", 2.0};
  }
  std::vector<double> MetresIn(const std::string& disturbance) const {
    auto view = RecordingView::Open(Run(), *ParseDisturbance(disturbance), {}, 1);
    EXPECT_TRUE(view) << view.error().message;
    std::vector<double> metres;
    while (true) {
      const auto seen = view->Next();
      EXPECT_TRUE(seen) << seen.error().message;
      if (!seen || !*seen) return metres;
      EXPECT_EQ((*seen)->stamp, FromSeconds(0.5 * static_cast<double>(metres.size())));
      metres.push_back((*seen)->odometry->x_m);
    }
  }
};

TEST_F(RecordingViewTest, OdometryTellsOfTheWayThatIsShown) {
  const std::vector<double> plain = MetresIn("none");
  ASSERT_THAT(plain, SizeIs(kFrames));
  EXPECT_DOUBLE_EQ(plain[10], 5.0);
  EXPECT_DOUBLE_EQ(MetresIn("every=3")[10], 15.0);
  EXPECT_DOUBLE_EQ(MetresIn("slower=2")[10], 2.5);
  const std::vector<double> back = MetresIn("reverse");
  EXPECT_DOUBLE_EQ(back[10] - back[0], -5.0);
}

TEST_F(RecordingViewTest, OdometryKnowsNothingOfACut) {
  const std::vector<double> metres = MetresIn("jump=2");
  ASSERT_THAT(metres, SizeIs(kFrames));
  for (std::size_t i = 1; i < metres.size(); ++i) {
    EXPECT_GE(metres[i] - metres[i - 1], 0.0);
    EXPECT_LE(metres[i] - metres[i - 1], 0.5 + 1e-9);
  }
  EXPECT_NEAR(metres.back(), 0.5 * (kFrames - 3), 1e-6);  // two steps were carried, not driven
}

}  // namespace
}  // namespace trailcast::trial
