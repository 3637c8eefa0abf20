#include "services/lab/demo/demo_dispatch.h"

#include <gmock/gmock.h>

#include <map>

#include "services/mission/orders.h"

namespace trailcast::demo {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::IsEmpty;

class DemoDispatchTest : public ::testing::Test {
 protected:
  static std::vector<DemoRobot> Robots() {
    std::vector<DemoRobot> robots(4);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      robots[i].name = i == 0 ? "scout" : "robot-" + std::to_string(i);
      robots[i].route = kRoundRoute;
    }
    return robots;
  }
  static exchange::AgentStatus Taught(std::uint32_t segment) {
    exchange::AgentStatus status;
    status.agent = AgentId("scout");
    status.segment = segment;
    return status;
  }
  // Returns the robots that missions are for.
  std::vector<std::string> DueAt(int ms) {
    std::vector<std::string> robots;
    for (const exchange::Message& message :
         dispatch_.Due(steady_clock::time_point(milliseconds(1'000'000 + ms)))) {
      const auto& mission = std::get<mission::Mission>(message);
      EXPECT_EQ(mission.orders, "follow round laps 20");
      EXPECT_TRUE(mission::ParseOrders(mission.orders).has_value());
      robots.push_back(mission.agent.value());
      ids_[mission.agent.value()] = mission.id;
    }
    return robots;
  }
  void Report(const std::string& robot, mission::State state) {
    dispatch_.Hear({mission::Report{.agent = AgentId(robot),
                                    .mission = ids_[robot],
                                    .change = state == mission::State::kSent ? 0U : 1U,
                                    .state = state}});
  }

  DemoDispatch dispatch_{AgentId("operator"), Robots()};
  std::map<std::string, std::string> ids_;
};

TEST_F(DemoDispatchTest, SendsAllButTheLastOnceThereIsSomethingToFollow) {
  EXPECT_THAT(DueAt(0), IsEmpty());
  dispatch_.Hear({Taught(1)});
  EXPECT_THAT(DueAt(1000), IsEmpty());
  dispatch_.Hear({Taught(2)});
  EXPECT_THAT(DueAt(2000), ::testing::ElementsAre("robot-1", "robot-2"));
}

TEST_F(DemoDispatchTest, SaysItAgainUntilTheRobotsThemselvesHaveAnswered) {
  dispatch_.Hear({Taught(2)});
  EXPECT_EQ(DueAt(0).size(), 2U);
  EXPECT_THAT(DueAt(100), IsEmpty());
  Report("robot-1", mission::State::kAccepted);
  Report("robot-2", mission::State::kSent);
  EXPECT_THAT(DueAt(1000), ::testing::ElementsAre("robot-2"));
  Report("robot-2", mission::State::kRefused);
  EXPECT_THAT(DueAt(2000), IsEmpty());
}

}  // namespace
}  // namespace trailcast::demo
