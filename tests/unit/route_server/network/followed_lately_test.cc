#include "route_server/network/followed_lately.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::server {
namespace {

using exchange::FollowedSections;
using test::KeyNumber;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Poor = FollowedLately::Poor;

constexpr auto kWeek_ms = static_cast<std::int64_t>(FollowedLately::kHalfAfter_ms);

// Route 1 is 20 m long, route 2 12 m, and route 3 is not known.
class FollowedLatelyTest : public testing::Test {
 protected:
  static std::optional<double> LengthOf(const route::RouteKey& key) {
    if (key == KeyNumber(1)) return 20.0;
    return key == KeyNumber(2) ? std::optional(12.0) : std::nullopt;
  }
  void Hear(std::vector<FollowedSections::Section> sections, unsigned route = 1) {
    followed_.Hear({AgentId("robot1"), KeyNumber(route), std::move(sections)}, now_);
  }
  [[nodiscard]] std::vector<Poor> Poorly() const { return followed_.Poorly(now_); }
  // "number: lost of passed" of all that is kept, as it counted when it was heard.
  std::vector<std::string> Kept() {
    std::vector<std::string> kept;
    for (const store::FollowedSection& each : followed_.Unsaved()) {
      kept.push_back(fmt::format("{}: {:g} of {:g}", each.number, each.lost, each.passed));
    }
    return kept;
  }

  std::int64_t now_ = 1'000 * kWeek_ms;
  FollowedLately followed_{LengthOf};
};

TEST_F(FollowedLatelyTest, ASectionCostsMoreByTheShareThatWasLost) {
  Hear({{0, 5, 0}, {1, 5, 0}, {2, 5, 0}});
  EXPECT_THAT(Poorly(), IsEmpty());
  Hear({{1, 2, 2}});
  EXPECT_THAT(Kept(), ElementsAre("0: 0 of 5", "2: 0 of 5", "1: 2 of 7"));
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 7.0, 2.0, 1.9}));
  Hear({{1, 20, 0}});
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 27.0, 2.0, 1.3}));
}

TEST_F(FollowedLatelyTest, HoweverManyAreLostItStaysPassable) {
  Hear({{1, 1000, 1000}});
  ASSERT_THAT(Poorly(), SizeIs(1));
  EXPECT_EQ(Poorly().front().cost, 1.0 + FollowedLately::kLostCosts);
}

TEST_F(FollowedLatelyTest, OfRevisionsAndPlacesThatAreNotKnownNothingCounts) {
  Hear({{0, 1, 1}}, 3);
  Hear({{3, 1, 1}, {4'000'000'000, 1, 1}}, 2);
  EXPECT_THAT(Kept(), IsEmpty());
  Hear({{2, 1, 1}}, 2);
  EXPECT_THAT(Kept(), ElementsAre("2: 1 of 1")) << "its last 2 m";
}

TEST_F(FollowedLatelyTest, HalfIsLeftAfterAWeekAndNothingInTheEnd) {
  Hear({{1, 1, 1}});
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 1.0, 1.0, 2.3}));
  now_ += kWeek_ms;
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 0.5, 0.5, 1.8}));
  Hear({{1, 1, 0}});
  EXPECT_THAT(Poorly(), ElementsAre(Poor{KeyNumber(1), 5.0, 10.0, 1.5, 0.5, 1.6}));
  now_ -= 3 * kWeek_ms;  // the clock was set
  EXPECT_EQ(Poorly().front().lost, 0.5);
  now_ += 10 * kWeek_ms;
  EXPECT_THAT(Poorly(), IsEmpty());
}

TEST_F(FollowedLatelyTest, GoesOnAfterARestartWithWhatWasSaved) {
  Hear({{0, 1, 0}, {1, 1, 1}});
  const auto saved = followed_.Unsaved();
  followed_.NoteSaved();
  EXPECT_THAT(followed_.Unsaved(), IsEmpty());
  FollowedLately again(LengthOf);
  again.Load(saved);
  EXPECT_EQ(again.Poorly(now_), Poorly());
  EXPECT_THAT(again.Unsaved(), IsEmpty());
  Hear({{1, 1, 0}});
  EXPECT_THAT(followed_.Unsaved(), SizeIs(1)) << "of what has changed";
}

TEST_F(FollowedLatelyTest, NoMoreIsKeptThanThereIsRoomFor) {
  FollowedLately any([](const route::RouteKey&) { return 5.0; });
  constexpr auto kMost = static_cast<unsigned>(FollowedLately::kMostSections);
  for (unsigned i = 0; i < kMost + 10; ++i) {
    any.Hear({AgentId("robot1"), KeyNumber(1, i + 1), {{0, 1, 0}}}, now_);
  }
  const auto kept = any.Unsaved();
  EXPECT_THAT(kept, SizeIs(kMost));
  EXPECT_EQ(kept.front().key, KeyNumber(1, 11)) << "the oldest are gone";
}

}  // namespace
}  // namespace trailcast::server
