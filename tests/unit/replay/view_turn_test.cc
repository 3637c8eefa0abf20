#include "services/replay/view_turn.h"

#include <gtest/gtest.h>

#include <vector>

namespace trailcast::replay {
namespace {

constexpr int kViewWidth_px = 320;

// Recognised in so many features, all of which lie so far to the right of where they were taught.
SeenKeyView Seen(double along, double right_px, int features = 8) {
  SeenKeyView view{along, {}};
  for (int i = 0; i < features; ++i) view.pairs.push_back({10.0 * i + right_px, 10.0 * i});
  return view;
}

double TurnOf(double aim, const std::vector<SeenKeyView>& seen) {
  return TurnTowards(aim, seen, kViewWidth_px).turn_rad / ViewTurnOptions{}.gain_rad_per_px_at_320;
}

TEST(ViewTurn, IsBetweenWhatTheViewsBeforeAndBehindThePlaceAskFor) {
  const std::vector<SeenKeyView> seen{Seen(0.0, 90.0), Seen(1.0, 10.0), Seen(2.0, 30.0),
                                      Seen(3.0, 90.0)};
  EXPECT_NEAR(TurnOf(1.5, seen), 20.0, 1e-9);
  EXPECT_NEAR(TurnOf(1.0, seen), 10.0, 1e-9);
  EXPECT_NEAR(TurnOf(-1.0, seen), 90.0, 1e-9);
  EXPECT_EQ(TurnTowards(1.5, {}, kViewWidth_px).features, 0);
}

TEST(ViewTurn, OfHowAPlaceWasSeenTheLikestCounts) {
  const std::vector<SeenKeyView> seen{Seen(1.0, 70.0, 6), Seen(1.0, 10.0, 20), Seen(2.0, 30.0, 20),
                                      Seen(2.0, -70.0, 6)};
  EXPECT_NEAR(TurnOf(1.5, seen), 20.0, 1e-9);
  EXPECT_NEAR(TurnOf(1.5, {seen[1], seen[0], seen[3], seen[2]}), 20.0, 1e-9);
}

TEST(ViewTurn, AViewOfTooFewFeaturesIsNone) {
  EXPECT_NEAR(TurnOf(1.5, {Seen(0.0, 40.0), Seen(1.0, 10.0, 4), Seen(2.0, 30.0, 4)}), 40.0, 1e-9);
}

}  // namespace
}  // namespace trailcast::replay
