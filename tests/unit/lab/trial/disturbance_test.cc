#include "services/lab/trial/recording/disturbance.h"

#include <gmock/gmock.h>

namespace trailcast::trial {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Disturbance Parsed(const std::string& text) {
  const auto parsed = ParseDisturbance(text);
  EXPECT_TRUE(parsed) << parsed.error().message;
  return parsed.value_or(Disturbance{});
}

std::string Refusal(const std::string& text) {
  const auto parsed = ParseDisturbance(text);
  return parsed ? "none" : parsed.error().message;
}

TEST(Disturbance, NothingIsDoneByDefault) {
  EXPECT_THAT(Parsed(""), IsEmpty());
  EXPECT_THAT(Parsed("none"), IsEmpty());
}

TEST(Disturbance, SeveralAreDoneInTheOrderGiven) {
  EXPECT_THAT(Parsed("jpeg=20+every=4+noise=2.5"),
              ElementsAre(Change{ChangeKind::kJpeg, 20}, Change{ChangeKind::kEvery, 4},
                          Change{ChangeKind::kNoise, 2.5}));
}

TEST(Disturbance, AValueLeftOutIsTheKindsOwn) {
  EXPECT_THAT(Parsed("skip+reverse"),
              ElementsAre(Change{ChangeKind::kSkip, 50}, Change{ChangeKind::kReverse, 0}));
}

TEST(Disturbance, WhatIsNotKnownIsRefusedWithWhatThereIs) {
  EXPECT_THAT(Refusal("evry=3"), HasSubstr("no disturbance 'evry'; there are: every, slower"));
  EXPECT_THAT(Refusal("jpeg=30+"), HasSubstr("no disturbance ''"));
}

TEST(Disturbance, AValueOutOfRangeIsRefusedWithTheRange) {
  EXPECT_THAT(Refusal("jpeg=0"), HasSubstr("'jpeg' takes a whole number from 1 to 100, not '0'"));
  EXPECT_THAT(Refusal("every=2.5"), HasSubstr("whole number"));
  EXPECT_THAT(Refusal("gamma=bright"), HasSubstr("'gamma' takes a number"));
  EXPECT_THAT(Refusal("noise=nan"), HasSubstr("not 'nan'"));
}

TEST(Disturbance, HelpNamesEachKind) {
  for (const char* name : {"every", "slower", "reverse", "skip", "jump", "camera", "gamma", "noise",
                           "jpeg", "smear", "crop", "blur", "flare"}) {
    EXPECT_THAT(ChangeHelp(), HasSubstr(std::string("  ") + name));
    EXPECT_TRUE(ParseDisturbance(name)) << name;
  }
}

TEST(Disturbance, TellsWhatItLeavesOfTheTruth) {
  EXPECT_EQ(StrideOf(Parsed("gamma")), 1);
  EXPECT_EQ(StrideOf(Parsed("every=3+every=2")), 6);
  EXPECT_TRUE(KeepsSides(Parsed("camera")));
  EXPECT_FALSE(KeepsSides(Parsed("noise+crop")));
  EXPECT_TRUE(KeepsSteering(Parsed("jump")));
  EXPECT_FALSE(KeepsSteering(Parsed("reverse")));
}

}  // namespace
}  // namespace trailcast::trial
