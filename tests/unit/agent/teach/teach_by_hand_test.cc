// A robot that teaches what a person drives it along, from afar or by its own joystick.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "agent/teach/scout.h"
#include "services/route/digest.h"
#include "tests/support/await.h"
#include "tests/unit/agent/driven_device.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

// Says what `driver` would, before each picture, by how far the robot is.
class Driven : public test::DrivenDevice {
 public:
  std::function<void(double)> before_frame = [](double) {};
  Trouble tell;
  void OnTrouble(const Trouble& whom) override { tell = whom; }
  Result<std::optional<Observation>> Next() override {
    before_frame(along_m);
    return DrivenDevice::Next();
  }
};

class TeachByHandTest : public testing::Test {
 protected:
  void Drive(double linear_mps) {
    const auto now = steady_clock::now();
    const auto said_ms = std::chrono::duration_cast<milliseconds>(now.time_since_epoch()).count();
    teleoperation_.Hear(
        {AgentId("robot1"), AgentId("ann"), linear_mps, 0.0, static_cast<std::uint64_t>(said_ms)},
        now);
  }
  Result<Taught> Teach(bool with_server) {
    auto options = swarm_.ScoutNamed("robot1");
    options.link.instance = 7;
    options.link.delivery_timeout = with_server ? milliseconds(20'000) : milliseconds(0);
    return TeachByHand(device_, options, teleoperation_, swarm_.OpenStore("robot1"),
                       swarm_.Join(exchange::TeachingTopics()));
  }
  route::RouteInfo Stored(const std::string& agent) {
    const auto routes = swarm_.OpenStore(agent)->FindRoutesByName("hall");
    return routes->empty() ? route::RouteInfo{} : routes->front();
  }

  test::Swarm swarm_;
  Driven device_;
  Teleoperation teleoperation_;
};

TEST_F(TeachByHandTest, WhatIsDrivenIsTaughtUntilItIsEnded) {
  swarm_.StartServer();
  device_.before_frame = [this](double along_m) {
    if (along_m < 2.5) return Drive(0.6);
    teleoperation_.Tell({.ended = true});
  };
  const auto taught = Teach(true);
  swarm_.StopServer();
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_EQ(taught->end, Taught::End::kComplete);
  EXPECT_TRUE(taught->delivered);
  EXPECT_THAT(taught->text, HasSubstr("a server has it"));
  EXPECT_NEAR(Stored("server").length_m, 2.5, 0.2);
  EXPECT_EQ(Stored("server").standing, route::Standing::kActive);
}

TEST_F(TeachByHandTest, WithoutAServerItIsKeptForLater) {
  device_.before_frame = [this](double along_m) {
    if (along_m < 1.5) return Drive(0.6);
    teleoperation_.Tell({.ended = true});
  };
  const auto taught = Teach(false);
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_FALSE(taught->delivered);
  EXPECT_THAT(taught->text, HasSubstr("until a server is there"));
  EXPECT_EQ(Stored("robot1").state, route::RouteState::kComplete);
  EXPECT_FALSE(Stored("robot1").cut_off);
}

TEST_F(TeachByHandTest, WhatIsCancelledIsFollowedByNobodyAndOfferedToNobody) {
  device_.before_frame = [this](double along_m) {
    if (along_m < 1.5) return Drive(0.6);
    teleoperation_.Tell({.cancelled = true});
  };
  const auto taught = Teach(false);
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_EQ(taught->end, Taught::End::kDiscarded);
  EXPECT_EQ(Stored("robot1").standing, route::Standing::kRetired);
  swarm_.StartServer();
  const auto delivered =
      DeliverBacklog(swarm_.ScoutNamed("robot1").link, swarm_.OpenStore("robot1"),
                     swarm_.Join(exchange::ScoutTopics()));
  swarm_.StopServer();
  EXPECT_TRUE(delivered) << delivered.error().message;
  EXPECT_EQ(Stored("server").segment_count, 0U);
}

TEST_F(TeachByHandTest, WhatAServerHasOfACancelledOneIsNotFollowed) {
  swarm_.StartServer();
  const auto listener = swarm_.Join({.write = {}, .read = {exchange::Topic::kReceipts}});
  const auto gives_up = steady_clock::now() + test::kLongEnough;
  bool stored = false;
  device_.before_frame = [&, this](double along_m) {
    if (along_m < 2.5) return Drive(0.6);
    for (const exchange::Message& message : listener->Take(milliseconds(0))) {
      const auto* receipt = std::get_if<exchange::Receipt>(&message);
      stored |= receipt != nullptr && receipt->durable_prefix > 0;
    }
    if (stored || steady_clock::now() > gives_up) teleoperation_.Tell({.cancelled = true});
  };
  const auto taught = Teach(true);
  swarm_.StopServer();
  EXPECT_TRUE(stored);
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_EQ(taught->end, Taught::End::kDiscarded);
  EXPECT_TRUE(Stored("server").cut_off);
  EXPECT_NE(Stored("server").standing, route::Standing::kActive);
  EXPECT_EQ(Stored("robot1").standing, route::Standing::kRetired);
}

TEST_F(TeachByHandTest, TheRobotStandsWhenItsDriverFallsSilentAndTeachingGoesOn) {
  double at_m = -1.0;
  steady_clock::time_point since{};
  device_.before_frame = [&, this](double along_m) {
    if (along_m < 1.0) return Drive(0.6);
    // It rolls on for 0.3 s, in which the device's time is three times that.
    if (along_m != at_m) {
      at_m = along_m;
      since = steady_clock::now();
    } else if (steady_clock::now() - since > milliseconds(500)) {
      teleoperation_.Tell({.ended = true});
    }
  };
  const auto taught = Teach(false);
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_GT(at_m, 1.0);
}

TEST_F(TeachByHandTest, HowFarAndHowFastIsToldOfEachMomentNotOfEachSegment) {
  const auto listener = swarm_.Join(exchange::OperatorTopics());
  const auto gives_up = steady_clock::now() + test::kLongEnough;
  std::set<double> told_m;
  bool moved = false;
  bool stood = false;
  std::uint32_t segments = 0;
  device_.before_frame = [&](double along_m) {
    for (const exchange::Message& message : listener->Take(milliseconds(0))) {
      const auto* status = std::get_if<exchange::AgentStatus>(&message);
      if (status == nullptr || status->mode != exchange::AgentMode::kTeaching) continue;
      if (status->place) told_m.insert(status->place->along_m);
      segments = status->segments;
      moved |= status->speed_mps > 0.1;
      // The segment that is under way was driven to here.
      stood |= along_m >= 2.0 && status->speed_mps == 0.0 && status->place &&
               status->place->along_m > along_m - 0.1;
    }
    if (along_m < 2.0) return Drive(0.6);
    if (stood || steady_clock::now() > gives_up) teleoperation_.Tell({.ended = true});
  };
  const auto taught = Teach(false);
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_TRUE(moved);
  EXPECT_TRUE(stood) << (told_m.empty() ? -1.0 : *told_m.rbegin());
  EXPECT_GT(told_m.size(), segments + 1U) << "not by segments alone";
}

TEST_F(TeachByHandTest, WhoDrivesItIsToldWhatStandsInItsWay) {
  const std::string what = "something stands 0.3 m ahead, in the way: the robot waits";
  const auto listener = swarm_.Join(exchange::OperatorTopics());
  const auto gives_up = steady_clock::now() + test::kLongEnough;
  const auto told = [&](const std::string& detail) {
    for (const exchange::Message& message : listener->Take(milliseconds(0))) {
      const auto* status = std::get_if<exchange::AgentStatus>(&message);
      if (status != nullptr && status->mode == exchange::AgentMode::kTeaching &&
          status->detail == detail) {
        return true;
      }
    }
    return false;
  };
  enum class Seen { kNothing, kWaits, kGoesOn } seen = Seen::kNothing;
  device_.before_frame = [&](double along_m) {
    if (along_m < 1.0) return Drive(0.6);
    if (seen == Seen::kNothing) {
      device_.tell({what, false});
      if (told(what)) seen = Seen::kWaits;
    } else if (seen == Seen::kWaits) {
      device_.tell({});
      if (told("")) seen = Seen::kGoesOn;
    }
    if (seen == Seen::kGoesOn || steady_clock::now() > gives_up)
      teleoperation_.Tell({.ended = true});
  };
  const auto taught = Teach(false);
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_EQ(seen, Seen::kGoesOn);
  device_.tell({what, false});  // to nobody any more
}

TEST_F(TeachByHandTest, WhoDrivesItWithoutThisProgramIsLetBe) {
  test::WalkDevice walked(150);
  auto options = swarm_.ScoutNamed("robot1");
  options.link.delivery_timeout = milliseconds(0);
  options.link.instance = 7;
  const auto taught = TeachByHand(walked, options, teleoperation_, swarm_.OpenStore("robot1"),
                                  swarm_.Join(exchange::TeachingTopics()));
  ASSERT_TRUE(taught) << taught.error().message;
  EXPECT_NEAR(Stored("robot1").length_m, 2.98, 0.2);
  // It is told to stand when all is over, and nothing before.
  EXPECT_LE(walked.told.size(), 3U);
}

}  // namespace
}  // namespace trailcast::agent
