// Followers that drive virtual robots over ROS 2's topics, killed, stopped and behind one another.
#include <chrono>
#include <functional>

#include "services/dds/dds_exchange.h"
#include "tests/scenario/robots.h"
#include "tests/support/await.h"

namespace trailcast::test {
namespace {

using exchange::AgentMode;
using exchange::AgentStatus;
using std::chrono::steady_clock;
using testing::HasSubstr;

class FollowersTest : public RobotsTest {
 protected:
  // A follower that has driven into the route's second segment.
  std::unique_ptr<Process> OnItsWay(const std::string& robot) {
    auto follower = Follow(robot, "routes.db", {"--lockstep"}, "first-run");
    EXPECT_TRUE(follower->WaitForOutput("segment 1: ")) << follower->output();
    return follower;
  }
  static void Kill(Process& process) {
    process.Signal(SIGKILL);
    EXPECT_EQ(End(process).status, 128 + SIGKILL);
  }
  // This is what an observer hears of the fleet.
  class Observer {
   public:
    explicit Observer(const std::string& tag) {
      dds::DdsOptions options;
      options.self = AgentId("observer");
      options.discovery_tag = tag;
      options.network_interface = "lo";
      exchange_ = *dds::OpenDdsExchange(options, exchange::OperatorTopics());
    }
    // Waits for a status that is as wanted.
    [[nodiscard]] bool See(const std::function<bool(const AgentStatus&)>& wanted) {
      const auto deadline = steady_clock::now() + test::kLongEnough;
      while (steady_clock::now() < deadline) {
        for (const auto& message : exchange_->Take(std::chrono::milliseconds(100))) {
          const auto* status = std::get_if<AgentStatus>(&message);
          if (status != nullptr && wanted(*status)) return true;
        }
      }
      return false;
    }

   private:
    std::unique_ptr<exchange::RouteExchange> exchange_;
  };
};

TEST_F(FollowersTest, KilledOnItsWayAFollowerGoesOnFromWhereItsRobotStands) {
  Teach();
  const auto robot = Robot("robot1", {"--camera", "wide", "--seed", "7", "--lockstep"});
  Kill(*OnItsWay("robot1"));
  const auto again = Follow({"--lockstep"});
  EXPECT_EQ(End(*again).status, 0) << again->output() << robot->output();
  EXPECT_THAT(again->output(), HasSubstr("looking whether the robot is still there"));
  EXPECT_THAT(again->output(), HasSubstr("went_on_at_m="));
  EXPECT_THAT(again->output(), testing::Not(HasSubstr("goes on 0.0 m")));
  EXPECT_THAT(again->output(), HasSubstr("state=ARRIVED"));
  // It arrived: the next run begins at the start.
  EXPECT_FALSE(std::filesystem::exists(Path("routes.db.follower.place")));
}

TEST_F(FollowersTest, KilledAndCarriedAwayAFollowerSaysWhyItCannotGoOn) {
  Teach();
  {
    const auto robot = Robot("robot1", {"--lockstep"});
    Kill(*OnItsWay("robot1"));
  }
  // Into the next room.
  const auto robot = Robot("robot1", {"--lockstep"}, "5.8,7\n2.3,7\n");
  const auto again = Follow({"--lockstep"});
  EXPECT_EQ(End(*again).status, 3) << again->output();
  EXPECT_THAT(again->output(), HasSubstr("state=LOST"));
  EXPECT_THAT(again->output(), HasSubstr("not where it was left"));
}

// Without a server, and by what it tells them.
class FollowersTogether : public FollowersTest, public testing::WithParamInterface<const char*> {};

TEST_P(FollowersTogether, TheSecondStopsBehindTheFirstThatHangsAndBothGoOnAfter) {
  Teach("first.db");
  const Words way{"--server", "--discovery", GetParam()};
  const auto server = GetParam() == std::string("star") ? Server() : nullptr;
  std::filesystem::copy_file(Path("first.db"), Path("second.db"));
  Observer observer(tag_);
  // In real time: in lockstep the first is at the route's end before the others have found it
  // again.
  const auto first_robot = Robot("robot1", {});
  const auto second_robot = Robot("robot2", {"--seed", "2"});
  const auto first = Follow("robot1", "first.db", With(way, {"--name", "first"}), "first");
  const auto second = Follow("robot2", "second.db", With(way, {"--name", "second"}), "second");
  // The other robot waits for the one that comes first.
  AgentId ahead;
  ASSERT_TRUE(observer.See([&](const AgentStatus& status) {
    ahead = status.agent;
    return status.place && status.place->along_m > 2.0;
  })) << first->output()
      << second->output();
  const bool is_first = ahead == AgentId("first");
  Process& hangs = is_first ? *first : *second;
  hangs.Signal(SIGSTOP);
  // The other one knows after a while that it is gone, and stands all the same.
  EXPECT_TRUE(observer.See([&](const AgentStatus& status) {
    return status.agent != ahead && status.mode == AgentMode::kWaiting &&
           status.detail.find("waits for " + ahead.value()) == 0 &&
           status.detail.find("not heard for") != std::string::npos && status.place &&
           status.place->along_m < 1.5;
  })) << first->output()
      << second->output();
  hangs.Signal(SIGCONT);
  EXPECT_EQ(End(*first).status, 0) << first->output();
  EXPECT_EQ(End(*second).status, 0) << second->output();
}

INSTANTIATE_TEST_SUITE_P(Ways, FollowersTogether, testing::Values("mesh", "star"),
                         [](const auto& way) { return std::string(way.param); });

}  // namespace
}  // namespace trailcast::test
