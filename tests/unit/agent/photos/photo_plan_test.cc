#include "agent/photos/photo_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

route::RouteInfo Hall() {
  route::RouteInfo route;
  route.key.route = RouteId(std::string(32, 'a'));
  route.name = "hall";
  route.revision = RevisionNumber(3);
  return route;
}

PhotoPlan PlanOf(const char* orders, bool backwards = false) {
  const mission::PhotoWish wish = mission::PhotosIn(orders);
  EXPECT_TRUE(wish.any()) << orders;
  return {wish, Hall(), backwards};
}

// Drives from frame to frame, and returns where photos were to be taken.
std::vector<double> Drive(PhotoPlan& plan, double from_m, double to_m, double step_m = 0.04) {
  std::vector<double> spots;
  const double sign = to_m < from_m ? -1.0 : 1.0;
  const int frames = static_cast<int>(std::abs(to_m - from_m) / step_m + 0.5);
  for (int i = 0; i <= frames; ++i) {
    const double along_m = from_m + sign * i * step_m;
    if (const auto spot = plan.Due(along_m)) {
      EXPECT_LE(sign * (along_m - spot->at_m), PhotoPlan::kNear_m);
      EXPECT_GE(sign * (along_m - spot->at_m), 0.0);
      spots.push_back(spot->at_m);
      plan.NoteTaken(*spot);
    }
  }
  return spots;
}

TEST(PhotoPlan, TakesOneAtEachMultipleFromTheRoutesBeginning) {
  PhotoPlan plan = PlanOf("photo every 5 follow hall");
  EXPECT_THAT(Drive(plan, 0.0, 12.0), ElementsAre(0.0, 5.0, 10.0));
}

// Each visit has its photos at the same places, wherever its mission begins.
TEST(PhotoPlan, TakesThemAtTheSamePlacesWhereverItBegins) {
  PhotoPlan plan = PlanOf("photo every 5 follow hall 3..12");
  EXPECT_THAT(Drive(plan, 3.0, 12.0), ElementsAre(5.0, 10.0));
  PhotoPlan just_past = PlanOf("photo every 5 follow hall");
  EXPECT_THAT(Drive(just_past, 5.3, 7.0), ElementsAre(5.0));
}

TEST(PhotoPlan, TakesThemInReverseGearToo) {
  PhotoPlan plan = PlanOf("photo every 5 at hall@7 follow hall backwards", true);
  EXPECT_THAT(Drive(plan, 12.0, 0.0), ElementsAre(10.0, 7.0, 5.0, 0.0));
}

TEST(PhotoPlan, TakesOneOfEachPlaceOnItsRouteAndRevision) {
  PhotoPlan plan =
      PlanOf("photo at b=hall@4.1 at hall@4 at hall@2@1 at hall@3@2 at yard@3 follow hall");
  EXPECT_THAT(plan.Photographed(), IsEmpty());
  EXPECT_THAT(Drive(plan, 0.0, 4.05), ElementsAre(2.0, 4.0));
  EXPECT_THAT(plan.Photographed(), ElementsAre("hall@3@2", "hall@4"));
  EXPECT_THAT(Drive(plan, 4.05, 6.0), ElementsAre(4.1));
  EXPECT_THAT(plan.Photographed(), SizeIs(3));
}

TEST(PhotoPlan, CallsASpotByTheNameOfThePlaceThatIsThere) {
  PhotoPlan plan = PlanOf("photo every 5 at dock=hall@5 follow hall");
  const auto spot = plan.Due(5.01);
  ASSERT_TRUE(spot);
  EXPECT_EQ(spot->place, "dock");
  plan.NoteTaken(*spot);
  EXPECT_FALSE(plan.Due(5.02)) << "one photo will do";
}

TEST(PhotoPlan, TakesNoneTwiceOfARobotThatStandsAndWavers) {
  PhotoPlan plan = PlanOf("photo every 1 follow hall");
  std::vector<double> spots;
  for (const double along_m : {0.98, 1.02, 0.97, 1.01, 0.99, 1.03}) {
    if (const auto spot = plan.Due(along_m)) {
      spots.push_back(spot->at_m);
      plan.NoteTaken(*spot);
    }
  }
  EXPECT_THAT(spots, ElementsAre(1.0));
}

TEST(PhotoPlan, TakesNoneOfWhatARobotHasNotPassedThatFindsItselfElsewhere) {
  PhotoPlan plan = PlanOf("photo every 5 at dock=hall@12 follow hall");
  EXPECT_THAT(Drive(plan, 0.0, 6.0), ElementsAre(0.0, 5.0));
  EXPECT_THAT(Drive(plan, 17.0, 21.0), ElementsAre(20.0));
  EXPECT_THAT(plan.Photographed(), IsEmpty());
}

// A photo that could not be taken at one frame, because others wait, is taken at the next.
TEST(PhotoPlan, OffersASpotUntilItWasTaken) {
  const PhotoPlan plan = PlanOf("photo every 5 follow hall");
  EXPECT_TRUE(plan.Due(5.01));
  EXPECT_EQ(plan.Due(5.3)->at_m, 5.0);
  EXPECT_FALSE(plan.Due(5.6));
}

TEST(PhotoPlan, TakesWhatIsJustAheadAtTheRoutesEnd) {
  const PhotoPlan plan = PlanOf("photo every 5 follow hall");
  EXPECT_FALSE(plan.Due(9.8));
  EXPECT_EQ(plan.Due(9.8, true)->at_m, 10.0);
}

}  // namespace
}  // namespace trailcast::agent
