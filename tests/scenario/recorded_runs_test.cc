// These teach on one run and replay another, open loop, by vision alone, with runs that nobody of
// the project recorded. ../shared/data/README.md has what must hold. They are skipped, visibly,
// without that data.

#include "tests/scenario/recorded_runs.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

TEST_F(RecordedRunsTest, DonkeyTrackGoesRoundAndTurnsAsItsDriverDid) {
  if (Absent("donkey_track")) GTEST_SKIP() << "no recorded runs at " << Data("donkey_track");
  const Replayed run =
      TeachAndReplay(Data("donkey_track") / "teach", Data("donkey_track") / "replay");
  ASSERT_GT(run.frames.size(), 400U);

  int furthest = 0;
  for (const Frame& frame : run.frames) {
    EXPECT_GE(frame.segment, furthest - 1) << "progress went back more than one segment";
    furthest = std::max(furthest, frame.segment);
  }
  EXPECT_EQ(furthest, run.segments - 1) << "the end was not reached";

  // Steering above 0 is to the right and leads the image by 2 to 5 frames; counted while following.
  const auto steering = ReadSteering(Data("donkey_track") / "replay_steering.csv");
  for (const int lead : {2, 3, 4, 5}) {
    const Steered steered = AgreementWithDriver(run.frames, steering, lead);
    ASSERT_GT(steered.asked, 150);
    EXPECT_GE(steered.agreed, 0.85 * steered.asked)
        << steered.agreed << " of " << steered.asked << " at a lead of " << lead;
  }
}

class PatioLapsTest : public RecordedRunsTest, public testing::WithParamInterface<int> {};

TEST_P(PatioLapsTest, AnotherLapUnderOtherLightGoesAllTheWayRound) {
  if (Absent("patio_laps")) GTEST_SKIP() << "no recorded runs at " << Data("patio_laps");
  const std::string lap = "lap" + std::to_string(GetParam());
  const Replayed run = TeachAndReplay(Data("patio_laps") / "lap0", Data("patio_laps") / lap);
  ASSERT_GT(run.frames.size(), 300U);
  int furthest = 0;
  for (const Frame& frame : run.frames) {
    EXPECT_GE(frame.segment, furthest - 1) << "progress went back more than one segment";
    furthest = std::max(furthest, frame.segment);
  }
  // lap4 ends two thirds of the way round.
  EXPECT_GE(furthest, GetParam() == 4 ? 55 * run.segments / 100 : run.segments - 1);
  EXPECT_NE(run.frames.back().state, "LOST");
}

INSTANTIATE_TEST_SUITE_P(Laps, PatioLapsTest, testing::Values(1, 2, 3, 4));

// The real programs: what one follower has seen changed, the next gets from the server.
TEST_F(RecordedRunsTest, PatioIsRefreshedByOneLapAndFollowedSoByTheNext) {
  if (Absent("patio_laps")) GTEST_SKIP() << "no recorded runs at " << Data("patio_laps");
  const auto server = Server();
  const auto follow = [&](const std::string& lap, const std::string& store, const Words& more) {
    return RunAgent(With({"replay", "--frames", (Data("patio_laps") / lap).string(), "--route",
                          "patio", "--store", Path(store), "--server"},
                         more));
  };
  const auto taught = RunAgent({"teach", "--frames", (Data("patio_laps") / "lap0").string(),
                                "--route", "patio", "--store", Path("scout.db"), "--server"});
  ASSERT_EQ(taught.status, 0) << taught.output;
  const auto first = follow("lap1", "first.db", {"--refresh", "auto"});
  EXPECT_EQ(first.status, 0) << first.output;
  EXPECT_THAT(first.output, HasSubstr("revision 1 refreshed by "));
  EXPECT_THAT(first.output, HasSubstr(" views new, 0 gone; "));
  EXPECT_TRUE(server->WaitForOutput("takes the place of the one that it refreshes"))
      << server->output();
  const auto second = follow("lap3", "second.db", {});
  EXPECT_EQ(second.status, 0) << second.output;
  EXPECT_THAT(second.output, HasSubstr("@2"));
  EXPECT_THAT(second.output, HasSubstr("state=ARRIVED"));
}

TEST_F(RecordedRunsTest, CorridorWalkedOnTheLeftAsksForRight) {
  if (Absent("corridor_offset")) GTEST_SKIP() << "no recorded runs at " << Data("corridor_offset");
  const auto [right, left] = RightAndLeft(
      TeachAndReplay(Data("corridor_offset") / "ref", Data("corridor_offset") / "query").frames);
  EXPECT_GT(right, left);
  EXPECT_GE(right + left, 30);
}

TEST_F(RecordedRunsTest, CorridorWalkedOnTheRightAsksForLeft) {
  if (Absent("corridor_offset")) GTEST_SKIP() << "no recorded runs at " << Data("corridor_offset");
  const auto [right, left] = RightAndLeft(
      TeachAndReplay(Data("corridor_offset") / "query", Data("corridor_offset") / "ref").frames);
  EXPECT_GT(left, right);
  EXPECT_GE(right + left, 30);
}

TEST_F(RecordedRunsTest, ARecordedRunTeachesTheServerLikeAnyScout) {
  if (Absent("donkey_track")) GTEST_SKIP() << "no recorded runs at " << Data("donkey_track");
  const auto server = Server();
  const auto scout = RunAgent({"teach", "--frames", (Data("donkey_track") / "teach").string(),
                               "--route", "lap", "--store", Path("scout.db"), "--server"});
  EXPECT_EQ(scout.status, 0) << scout.output;
  EXPECT_THAT(scout.output, HasSubstr("unreceipted=0"));
  const auto follower = RunAgent({"replay", "--frames", (Data("donkey_track") / "replay").string(),
                                  "--route", "lap", "--store", Path("follower.db"), "--server"});
  EXPECT_EQ(follower.status, 0) << follower.output;
}

}  // namespace
}  // namespace trailcast::test
