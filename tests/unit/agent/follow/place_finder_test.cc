#include "agent/session/place_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "services/route/codec.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using testing::HasSubstr;

constexpr int kFrames = 150;
constexpr double kStep_m = 0.02;  // the robot's way from picture to picture
constexpr int kLeft = 90;         // the picture that it saw where it was left
constexpr int kMostLooks = 100;   // far more than it takes to give up

// A route taught by a walk at a wall, and a robot that stands before the same wall.
class PlaceFinderTest : public testing::Test {
 protected:
  PlaceFinderTest() {
    test::Swarm swarm;
    test::WalkDevice device(kFrames);
    const auto taught = swarm.Teach(device, swarm.ScoutNamed("scout"), false);
    if (!taught) throw std::runtime_error(taught.error().message);
    const auto store = swarm.OpenStore("scout");
    const auto routes = store->FindRoutesByName("hall");
    for (std::uint32_t i = 0; i < routes->front().segment_count; ++i) {
      const auto piece = store->ReadSegment(routes->front().key, SegmentIndex(i));
      segments_.push_back(route::Decode(piece->bytes).value());
    }
  }

  // Until it is found, or given up; where it is along the route, in metres.
  std::optional<double> LookAt(const image::GrayImage& frame) {
    for (int i = 0; i < kMostLooks && !finder_.given_up(); ++i) {
      if (const auto found = finder_.Look(frame, segments_, hand_over_)) return Along(*found);
    }
    return std::nullopt;
  }
  double Along(const PlaceFinder::Found& found) const {
    double along_m = found.fraction * segments_[found.segment.value()].length_m;
    for (std::uint32_t i = 0; i < found.segment.value(); ++i) along_m += segments_[i].length_m;
    return along_m;
  }

  std::vector<route::Segment> segments_;
  HandOver hand_over_{true, 160};
  PlaceFinder finder_{LeftAt{kStep_m * kLeft, 1.0}};
};

// Also late in a segment, where everything has grown since the scout took its patterns. How well
// along is the follower's to find out as it drives: a place that is half a metre off will do.
TEST_F(PlaceFinderTest, FindsTheRobotWhereverItWasLeft) {
  ASSERT_GE(segments_.size(), 2U);
  for (int left = 20; left < 140; left += 10) {
    finder_ = PlaceFinder(LeftAt{kStep_m * left, 1.0});
    const auto along_m = LookAt(test::WalkFrame(left));
    ASSERT_TRUE(along_m) << left << ": " << finder_.MostSeen();
    EXPECT_NEAR(*along_m, kStep_m * left, 0.5);
  }
}

TEST_F(PlaceFinderTest, FindsTheRobotThatRolledOn) {
  const auto along_m = LookAt(test::WalkFrame(kLeft + 30));
  ASSERT_TRUE(along_m) << finder_.MostSeen();
  EXPECT_NEAR(*along_m, kStep_m * (kLeft + 30), 0.2);
}

TEST_F(PlaceFinderTest, FindsTheRobotThatWasPutBackToTheStart) {
  EXPECT_EQ(LookAt(test::WalkFrame(0)), 0.0) << finder_.MostSeen();
}

TEST_F(PlaceFinderTest, GivesUpWhereTheRobotIsNeitherAndTellsWhatItSaw) {
  image::GrayImage elsewhere = test::WalkFrame(kLeft);
  for (std::size_t i = 0; i < elsewhere.pixels.size(); ++i) {
    elsewhere.pixels[i] = static_cast<std::uint8_t>((i * i / 7) % 251);
  }
  EXPECT_EQ(LookAt(elsewhere), std::nullopt);
  EXPECT_TRUE(finder_.given_up());
  EXPECT_THAT(finder_.MostSeen(), HasSubstr(" features of segment "));
}

// A narrow camera shows few of a segment's features: too few to be sure by, on their own.
TEST_F(PlaceFinderTest, WhereTheViewIsRecognisedFewFeaturesAreEnough) {
  constexpr std::size_t kFew = 6;
  for (route::Segment& segment : segments_) {
    if (segment.features.size() > kFew) segment.features.resize(kFew);
  }
  EXPECT_EQ(LookAt(test::WalkFrame(kLeft)), std::nullopt);
  finder_ = PlaceFinder(LeftAt{kStep_m * kLeft, 1.0});
  std::optional<double> along_m;
  for (int i = 0; i < kMostLooks && !along_m && !finder_.given_up(); ++i) {
    const auto found = finder_.Look(test::WalkFrame(kLeft), segments_, hand_over_, kStep_m * kLeft);
    if (found) along_m = Along(*found);
  }
  ASSERT_TRUE(along_m) << finder_.MostSeen();
  EXPECT_NEAR(*along_m, kStep_m * kLeft, 0.5);
}

TEST_F(PlaceFinderTest, APlaceBeyondWhatIsKnownOfTheRouteIsLookedForAtTheStartAlone) {
  PlaceFinder beyond(LeftAt{100.0, 1.0});
  finder_ = beyond;
  EXPECT_EQ(LookAt(test::WalkFrame(kLeft)), std::nullopt);
  finder_ = beyond;
  EXPECT_EQ(LookAt(test::WalkFrame(0)), 0.0) << finder_.MostSeen();
}

// Another place further on looks as another camera does: who is told where it stands believes that.
TEST_F(PlaceFinderTest, ARobotWhoseCameraNobodyKnowsIsWhereItIsTold) {
  constexpr int kFurther = 41;  // as a camera sees it that shows things half as large again
  finder_ = PlaceFinder(LeftAt{kStep_m * kLeft, std::nullopt});
  std::optional<PlaceFinder::Found> found;
  for (int i = 0; i < kMostLooks && !found && !finder_.given_up(); ++i) {
    found = finder_.Look(test::WalkFrame(kLeft + kFurther), segments_, hand_over_);
  }
  ASSERT_TRUE(found) << finder_.MostSeen();
  EXPECT_NEAR(Along(*found), kStep_m * kLeft, 0.21);
  EXPECT_NEAR(found->seen.magnification, 1.5, 0.2);
}

}  // namespace
}  // namespace trailcast::agent
