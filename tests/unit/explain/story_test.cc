#include "services/explain/story.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "services/explain/src/incidents.h"
#include "tests/support/recorded/sample_run.h"

namespace trailcast::explain {
namespace {

using agent::Phase;
using test::SampleRun;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Where it says what, on one line of the story: "place ... what", wrapped lines put together again.
std::string LineWith(const std::string& story, const std::string& what) {
  std::string joined;
  for (std::size_t i = 0; i < story.size(); ++i) {
    const bool goes_on = story.compare(i, 20, "\n                   ") == 0;
    if (goes_on) {
      joined += ' ';
      i = story.find_first_not_of(' ', i + 1) - 1;
    } else {
      joined += story[i];
    }
  }
  const std::size_t at = joined.find(what);
  if (at == std::string::npos) return "";
  const std::size_t begin = joined.rfind('\n', at) + 1;
  return joined.substr(begin, joined.find('\n', at) - begin);
}

TEST(Story, BeginsWithWhoFollowedWhatAndHowItEnded) {
  SampleRun run;
  run.HandOver(0, 27).Frames(49).HandOver(1, 28).Frames(49).End("ARRIVED", "at the route's end");
  const std::string story = TellStory(run.Log(), false);
  EXPECT_THAT(
      story,
      AllOf(HasSubstr("'hall' (5 segments, 10.00 m as the run began, taught by scout with webcam"),
            HasSubstr("followed by robot2 with wide 320x240, method default"),
            HasSubstr("ARRIVED: at the route's end"), HasSubstr("100 frames in"),
            HasSubstr("3.96 m driven")));
  EXPECT_THAT(story, HasSubstr("sure of the path all the way"));
  EXPECT_THAT(story, Not(HasSubstr("breaks off")));
}

TEST(Story, SaysWhereItWasUnsureAndWhatBecameOfItsFeatures) {
  SampleRun run;
  run.HandOver(0, 12).Frames(20);
  run.row().left_picture = 3;
  run.Frame();
  run.row().not_returned = 2;
  run.row().rejected = 4;
  run.row().rejected_by_px = 17.0;
  run.row().agreeing = 5;
  run.Phase(Phase::kUnsure, "few are in view").Frames(10);
  run.row().agreeing = 25;
  run.Phase(Phase::kSure, "").Frames(5);
  const std::string line = LineWith(TellStory(run.Log(), false), "unsure for");
  EXPECT_THAT(line, AllOf(HasSubstr("0.88 m"), HasSubstr("segment 0"), HasSubstr("10 frames"),
                          HasSubstr("down to 5 of the segment's 30 features")));
  EXPECT_THAT(line, AllOf(HasSubstr("12 of 30 were found"), HasSubstr("3 left the picture"),
                          HasSubstr("2 were lost in tracking"), HasSubstr("4 disagree by 17 px")));
}

TEST(Story, TellsThatItStoodWhereSomethingCoveredTheView) {
  SampleRun run;
  run.HandOver(0, 27).Frames(10);
  run.row().tracked = run.row().agreeing = 2;
  run.row().not_returned = 23;
  run.row().linear_mps = 0.0;
  run.Phase(Phase::kCovered, "something covers the view").Frames(30);
  const std::string story = TellStory(run.Log(), false);
  EXPECT_THAT(LineWith(story, "covered the view"), HasSubstr("standing"));
  EXPECT_THAT(story, HasSubstr("23 of 25 features gone at once: 23 lost in tracking"));
}

TEST(Story, SaysWhereOnlyDistantFeaturesWereInView) {
  SampleRun run;
  run.HandOver(0, 27).Frames(10);
  run.row().left_sigma_m = 0.13;
  run.Phase(Phase::kDistant, "only distant features are in view").Frames(20);
  EXPECT_THAT(LineWith(TellStory(run.Log(), false), "only distant features"),
              HasSubstr("known to 0.13 m"));
}

TEST(Story, NamesHandOversThatFoundLittleAndMilestonesDrivenPast) {
  SampleRun run;
  run.HandOver(0, 27).Frames(80);  // 3.2 m in a segment of 2 m
  run.HandOver(1, 6, "wide").Frames(20).HandOver(2, 20, "wide").Frames(5);
  const std::string story = TellStory(run.Log(), false);
  EXPECT_THAT(story, HasSubstr("missed the milestone: 3.20 m driven in a segment of 2.00 m"));
  EXPECT_THAT(LineWith(story, "found only 6 of 30"),
              AllOf(HasSubstr("segment 1"), HasSubstr("by the wide search")));
  EXPECT_THAT(LineWith(story, "needed the wide search"), HasSubstr("20 of 30"));
  EXPECT_THAT(story, HasSubstr("3: 59 % of the features found on average, least 20 % (segment 1)"));
}

TEST(Story, SaysWhereItWasFarBesideThePathAndSlow) {
  SampleRun run;
  run.HandOver(0, 27).Frames(5);
  run.row().left_m = -0.4;
  run.row().true_off_m = 0.5;
  run.row().linear_mps = 0.1;
  run.Frames(10);
  run.HandOver(1, 27);
  const std::string story = TellStory(run.Log(), false);
  EXPECT_THAT(story, HasSubstr("up to 0.40 m right of the path"));
  EXPECT_THAT(story, HasSubstr("truly up to 0.50 m from the path where the estimate says 0.40"));
  EXPECT_THAT(story, HasSubstr("slower than taught: down to 0.10 m/s"));
}

TEST(Story, SaysWhereItWasCarriedOff) {
  SampleRun run;
  run.HandOver(0, 27).Frames(10).CarriedOff(-1.5).Frames(10);
  EXPECT_THAT(TellStory(run.Log(), true),
              HasSubstr("carried off, by what it sees: 1.50 m further to the right"));
}

TEST(Story, MergesWhatRepeatsAndFitsAScreen) {
  SampleRun run;
  run.HandOver(0, 27);
  for (int i = 0; i < 8; ++i) {
    run.Phase(Phase::kUnsure, "few").Frames(3).Phase(Phase::kSure, "").Frames(3);
  }
  EXPECT_THAT(TellStory(run.Log(), false), HasSubstr("[8 times until"));
  // Forty incidents far apart.
  for (int i = 0; i < 40; ++i) {
    run.Phase(Phase::kUnsure, "few").Frames(3).Phase(Phase::kSure, "").Frames(60);
  }
  const auto lines = [&](bool all) {
    const std::string story = TellStory(run.Log(), all);
    return std::count(story.begin(), story.end(), '\n');
  };
  EXPECT_LT(lines(false), 50);
  EXPECT_GT(lines(true), 80);
  EXPECT_THAT(TellStory(run.Log(), false), HasSubstr("lesser things: --all"));
}

TEST(Story, TheShortOneKeepsWhatMatters) {
  SampleRun run;
  run.HandOver(0, 27);
  for (int i = 0; i < 40; ++i) {
    run.Phase(Phase::kUnsure, "few").Frames(3).Phase(Phase::kSure, "").Frames(60);
  }
  run.Phase(Phase::kLost, "nothing is left in view").Frame().End("LOST", "nothing is left");
  EXPECT_THAT(TellStory(run.Log(), false), HasSubstr("lost: nothing is left in view"));
}

TEST(Story, RobotsWithoutOdometryAreToldByFrame) {
  SampleRun run;
  run.row().driven_m = run.row().x_m = run.row().y_m = std::nullopt;
  run.HandOver(0, 27).Frames(9).Phase(Phase::kUnsure, "few").Frames(7);
  const std::string story = TellStory(run.Log(), false);
  EXPECT_THAT(story, HasSubstr("no odometry"));
  EXPECT_THAT(LineWith(story, "unsure for 7 frames"), HasSubstr("frame    10"));
}

TEST(Story, ALogThatBreaksOffSaysSoAndIsToldAsFarAsItGoes) {
  SampleRun run;
  run.HandOver(0, 8).Frames(9);
  agent::RunLog log = run.Log();
  log.damage = {"at byte 912: the file is cut off here"};
  log.damaged = 1;
  EXPECT_THAT(
      TellStory(log, false),
      AllOf(HasSubstr("breaks off"), HasSubstr("cannot be read and are left out: 1"),
            HasSubstr("  at byte 912: the file is cut off"), HasSubstr("found only 8 of 30")));
}

TEST(Story, ALogWithGapsSaysSo) {
  agent::RunLog log = SampleRun().Frames(9).Log();
  EXPECT_THAT(TellStory(log, false), Not(HasSubstr("gaps")));
  log.events.push_back(
      {.frame = 5, .what = "dropped", .text = "3 frames: writing did not keep up"});
  EXPECT_THAT(TellStory(log, false),
              HasSubstr("The log has gaps: dropped 3 frames: writing did not keep up."));
}

TEST(Story, ARunWithoutAFrameHasOnlyItsEnd) {
  SampleRun run;
  run.End("FAILED", "no server answered");
  EXPECT_THAT(TellStory(run.Log(), true),
              AllOf(HasSubstr("FAILED: no server answered"), HasSubstr("no frame was looked at")));
}

TEST(Story, ItsPiecesAreWhatIsTold) {
  SampleRun run;
  run.HandOver(0, 8).Frames(30).Phase(Phase::kBlind, "nothing in view").Frames(10);
  const Story story = MakeStory(run.Log(), 1);
  ASSERT_EQ(story.happened.size(), 1U);
  EXPECT_EQ(story.happened[0].first, 31U);
  EXPECT_EQ(story.happened[0].last, 40U);
  EXPECT_THAT(story.happened[0].text, HasSubstr("blind"));
  EXPECT_GE(story.lesser, 1U);
  EXPECT_THAT(story.missing, testing::ElementsAre(HasSubstr("breaks off")));
}

TEST(Story, OnlyARunWithOdometryGoesOnByIt) {
  for (const bool has_odometry : {true, false}) {
    SampleRun run;
    if (!has_odometry) run.row().driven_m = run.row().x_m = run.row().y_m = std::nullopt;
    run.HandOver(0, 8).Frames(30).Phase(Phase::kBlind, "nothing in view").Frames(10);
    const std::string text = MakeStory(run.Log(), 1).happened[0].text;
    EXPECT_THAT(text, HasSubstr(has_odometry ? "blind, on by odometry"
                                             : "blind, on by the commanded speed"));
  }
}

TEST(FrameWords, SayWhatTheRobotWasAt) {
  SampleRun run;
  run.HandOver(0, 8).Frames(30);
  run.row().turn_rad = -0.1;
  run.row().rejected = 3;
  run.row().rejected_by_px = 12.0;
  run.Phase(Phase::kBlind, "nothing in view").Frames(10);
  const auto log = run.Log();
  const auto text = [&](std::size_t row, const std::string& about) {
    std::string all;
    for (const Said& said : TellFrame(log, row)) all += said.about == about ? said.text : "";
    return all;
  };
  EXPECT_EQ(text(35, "Mode"), "blind since frame 31: nothing in view");
  EXPECT_EQ(text(35, "Turn"), "5.7 degrees left, at 0.40 m/s");
  EXPECT_EQ(text(35, "Features"), "25 of 30 followed, 25 agree with the route, 3 do not, by 12 px");
  EXPECT_EQ(text(35, "Beside"), "0.02 m left of the path, +- 0.01 m");
  EXPECT_THAT(text(0, "Event"), HasSubstr("hand-over segment=0 found=8"));
  EXPECT_EQ(text(1, "Event"), "");
  EXPECT_EQ(text(1, "Mode"), "sure");
}

}  // namespace
}  // namespace trailcast::explain
