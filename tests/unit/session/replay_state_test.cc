#include "agent/session/replay_state.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

TEST(ReplayState, WaitsForOthersNotForWhatItSees) {
  for (const auto state : {ReplayState::kWaiting, ReplayState::kYielding, ReplayState::kHeld}) {
    EXPECT_TRUE(Waits(state)) << ToString(state);
  }
  for (const auto state :
       {ReplayState::kFollowing, ReplayState::kBlind, ReplayState::kArrived, ReplayState::kLost}) {
    EXPECT_FALSE(Waits(state)) << ToString(state);
  }
}

}  // namespace
}  // namespace trailcast::agent
