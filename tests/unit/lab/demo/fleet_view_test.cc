#include "services/lab/demo/fleet_view.h"

#include <gmock/gmock.h>

namespace trailcast::demo {
namespace {

using ::testing::HasSubstr;

exchange::AgentStatus Status(const std::string& agent, exchange::AgentMode mode, double progress) {
  exchange::AgentStatus status;
  status.agent = AgentId(agent);
  status.role = exchange::AgentRole::kFollower;
  status.mode = mode;
  status.progress = progress;
  return status;
}

TEST(FleetView, KeepsTheLatestStatusEvenOfAnAgentThatHasGone) {
  FleetView view;
  EXPECT_EQ(view.Find(AgentId("one")), nullptr);
  view.Handle(Status("one", exchange::AgentMode::kReplaying, 0.3));
  view.Handle(Status("two", exchange::AgentMode::kReplaying, 0.1));
  view.Handle(Status("one", exchange::AgentMode::kArrived, 1.0));
  view.Handle(exchange::AgentGone{AgentId("one"), 0});
  ASSERT_NE(view.Find(AgentId("one")), nullptr);
  EXPECT_EQ(view.Find(AgentId("one"))->mode, exchange::AgentMode::kArrived);
}

TEST(StatusLine, TellsWhatAFollowerDoes) {
  exchange::AgentStatus status = Status("one", exchange::AgentMode::kReplaying, 0.25);
  status.segment = 2;
  status.segments = 9;
  status.features = 41;
  const std::string line = StatusLine("one", "wide", &status);
  EXPECT_THAT(line, HasSubstr("following"));
  EXPECT_THAT(line, HasSubstr("segment  3 of  9, 41 features"));
  EXPECT_THAT(line, HasSubstr(" 25 %"));
}

TEST(StatusLine, ShowsWhatAnAgentSaysOfItsFault) {
  exchange::AgentStatus status = Status("one", exchange::AgentMode::kFault, 0.5);
  status.detail = "lost at segment 4";
  EXPECT_THAT(StatusLine("one", "wide", &status), HasSubstr("FAULT     lost at segment 4"));
  EXPECT_THAT(StatusLine("one", "wide", nullptr), HasSubstr("not heard of yet"));
}

}  // namespace
}  // namespace trailcast::demo
