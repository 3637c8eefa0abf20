#include "services/route/labels.h"

#include <gtest/gtest.h>

namespace trailcast::route {
namespace {

RouteInfo Taught(std::uint32_t segments, RouteState state = RouteState::kTeaching) {
  RouteInfo info;
  info.key = {RouteId("00ff"), TeachingId(2)};
  info.name = "yard";
  info.segment_count = segments;
  info.state = state;
  return info;
}

RouteInfo Edited(RouteInfo info, const std::string& name, std::uint32_t edition,
                 Standing standing = Standing::kActive) {
  info.name = name;
  info.edition = edition;
  info.standing = standing;
  return info;
}

TEST(Labels, LongerTeachingAndLaterLabelsCountEachForItself) {
  const RouteInfo known = Edited(Taught(3), "garden", 2);
  EXPECT_EQ(AfterNews(known, Taught(5)).value(), Edited(Taught(5), "garden", 2));
  EXPECT_EQ(AfterNews(known, Edited(Taught(1), "park", 3)).value(), Edited(Taught(3), "park", 3));
  EXPECT_EQ(AfterNews(known, Edited(Taught(4), "park", 1)).value(), Edited(Taught(4), "garden", 2));
  EXPECT_EQ(AfterNews(known, Taught(2)).value(), known);
}

TEST(Labels, ACompleteTeachingNeverChanges) {
  const RouteInfo known = Edited(Taught(3, RouteState::kComplete), "garden", 2);
  EXPECT_EQ(AfterNews(known, Taught(3, RouteState::kComplete)).value(), known);
  EXPECT_EQ(AfterNews(known, Taught(4)).error().code, ErrorCode::kConflict);
  RouteInfo other = Edited(Taught(3, RouteState::kComplete), "park", 3);
  EXPECT_EQ(AfterNews(known, other).value(), other);
  other.camera = "another";
  EXPECT_EQ(AfterNews(known, other).error().code, ErrorCode::kConflict);
}

TEST(Labels, OfTwoThatCameToOneEditionApartTheSameCountsForBoth) {
  const RouteInfo taught = Edited(Taught(3, RouteState::kComplete), "garden", 2);
  RouteInfo tagged = taught;
  tagged.tags = {"wet"};
  RouteInfo described = taught;
  described.description = "behind the house";
  RouteInfo to_review = taught;
  to_review.to_review = true;
  for (const RouteInfo& other : {Edited(taught, "park", 2), tagged, described, to_review}) {
    EXPECT_EQ(AfterNews(taught, other).value(), AfterNews(other, taught).value());
    EXPECT_NE(HasLaterLabels(taught, other), HasLaterLabels(other, taught));
  }
}

TEST(Labels, ThatItWasReviewedIsLaterNewsThanThatItIsToBe) {
  RouteInfo known = Taught(3, RouteState::kComplete);
  known.to_review = true;
  RouteInfo activated = Edited(known, "yard", 1);
  activated.to_review = false;
  EXPECT_EQ(AfterNews(known, activated).value(), activated);
  EXPECT_EQ(AfterNews(activated, known).value(), activated) << "its scout announces it again";
  EXPECT_TRUE(SameTeaching(known, activated));
}

TEST(StateText, TellsWhatKeepsARevisionFromBeingFollowed) {
  EXPECT_STREQ(StateText(Taught(3)), "teaching");
  RouteInfo info = Taught(3, RouteState::kComplete);
  EXPECT_STREQ(StateText(info), "staged");
  info.cut_off = true;
  EXPECT_STREQ(StateText(info), "cut off");
  info.to_review = true;
  EXPECT_STREQ(StateText(info), "cut off, to be reviewed");
  info.cut_off = false;
  EXPECT_STREQ(StateText(info), "to be reviewed");
  info.standing = Standing::kActive;
  EXPECT_STREQ(StateText(info), "active") << "an operator wants it so";
}

TEST(Labels, WhatIsDeletedStaysDeleted) {
  const RouteInfo tombstone = Edited(Taught(3), "yard", 1, Standing::kDeleted);
  EXPECT_EQ(AfterNews(Taught(9), tombstone).value(),
            Edited(Taught(9), "yard", 1, Standing::kDeleted));
  EXPECT_EQ(AfterNews(tombstone, Edited(Taught(9), "park", 7)).value(), tombstone);
  EXPECT_EQ(AfterNews(Edited(Taught(3), "park", 7), tombstone).value(), tombstone)
      << "however often it was changed where it was not known yet";
}

}  // namespace
}  // namespace trailcast::route
