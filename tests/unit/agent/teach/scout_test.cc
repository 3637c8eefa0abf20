#include "agent/teach/scout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "services/route/digest.h"
#include "services/route/labels.h"
#include "tests/support/await.h"
#include "tests/support/turning_walk.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using route::RouteState;
using std::chrono::milliseconds;
using test::WalkDevice;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kFrames = 150;

// This collects what is said while it lives.
class Said {
 public:
  Said() {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(text_);
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("said", std::move(sink)));
  }
  ~Said() { spdlog::set_default_logger(before_); }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;

  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
  std::ostringstream text_;
};

class ScoutTest : public testing::Test {
 protected:
  route::RouteInfo Taught(const std::string& agent) {
    const auto routes = swarm_.OpenStore(agent)->FindRoutesByName("hall");
    return routes->empty() ? route::RouteInfo{} : routes->front();
  }
  static std::string Value(const Result<Summary>& summary, const std::string& key) {
    if (!summary) return "error: " + summary.error().message;
    const std::string* value = summary->Find(key);
    return value == nullptr ? "no " + key : *value;
  }
  test::Swarm swarm_;
  WalkDevice device_{kFrames};
};

TEST_F(ScoutTest, KeepsTheRouteInItsOwnStoreWithoutAServer) {
  const auto summary = swarm_.Teach(device_, swarm_.ScoutNamed("scout"), false);
  EXPECT_EQ(Value(summary, "frames"), std::to_string(kFrames));
  const auto route = Taught("scout");
  EXPECT_EQ(Value(summary, "segments"), std::to_string(route.segment_count));
  EXPECT_GE(route.segment_count, 2U);
  EXPECT_EQ(route.state, RouteState::kComplete);
  EXPECT_EQ(route.scout, AgentId("scout"));
  EXPECT_EQ(route.camera, "walk 160x120");
  EXPECT_EQ(route.image_width_px, 160);
  EXPECT_NEAR(route.length_m, 0.02 * (kFrames - 1), 0.1);
  EXPECT_THAT(*swarm_.OpenStore("scout")->HeldSegments(route.key), SizeIs(route.segment_count));
}

// It stands on its side, drives straight on at first, and then turns to either side.
class SideDevice : public WalkDevice {
 public:
  SideDevice() : WalkDevice(kFrames) {}
  Result<std::optional<Observation>> Next() override {
    const int frame = next;
    const int turning = std::max(0, frame - 60);
    auto seen = WalkDevice::Next();
    if (!seen || !*seen) return seen;
    (*seen)->image = test::Rolled(test::TurningWalkFrame(frame, turning), 90.0);
    (*seen)->odometry->heading_rad = test::HeadingAt(turning);
    return seen;
  }
};

TEST_F(ScoutTest, TeachesAnewOnceATurnTellsThatItsCameraStandsOnItsSide) {
  swarm_.StartServer();
  SideDevice device;
  const Said said;
  const auto summary = swarm_.Teach(device, swarm_.ScoutNamed("scout"), true);
  EXPECT_EQ(Value(summary, "unreceipted"), "0");
  swarm_.StopServer();
  EXPECT_THAT(said.text(), AllOf(HasSubstr("the camera looks on its side"),
                                 HasSubstr("--camera-roll 90"), HasSubstr("is discarded")));
  std::vector<route::RouteInfo> kept;
  const auto store = swarm_.OpenStore("scout");
  const auto routes = store->FindRoutesByName("hall");
  ASSERT_TRUE(routes);
  for (const route::RouteInfo& route : *routes) {
    if (route.standing != route::Standing::kRetired) kept.push_back(route);
  }
  ASSERT_THAT(kept, SizeIs(1));
  EXPECT_EQ(kept.front().state, RouteState::kComplete);
  EXPECT_FALSE(kept.front().cut_off);
  EXPECT_EQ(kept.front().image_width_px, test::kTurningWidth_px);
  EXPECT_EQ(kept.front().image_height_px, test::kTurningHeight_px);
  EXPECT_NEAR(kept.front().length_m, 0.02 * (kFrames - 1), 0.1);
  EXPECT_EQ(Value(summary, "segments"), std::to_string(kept.front().segment_count));
}

TEST_F(ScoutTest, EndsWhenTheServerHasConfirmedEverySegment) {
  swarm_.StartServer();
  const auto summary = swarm_.Teach(device_, swarm_.ScoutNamed("scout"), true);
  EXPECT_EQ(Value(summary, "unreceipted"), "0");
  swarm_.StopServer();
  EXPECT_TRUE(swarm_.server_result);
  const auto taught = Taught("scout");
  EXPECT_TRUE(route::SameTeaching(Taught("server"), taught));
  EXPECT_THAT(*swarm_.OpenStore("scout")->UnreceiptedSegments(taught.key), IsEmpty());
}

TEST_F(ScoutTest, SaysInItsStatusWhatAServerHasToSayOfWhatItTeaches) {
  const auto server = swarm_.Join(exchange::ServerTopics());
  bool is_shown = false;
  const auto answer = [&](const exchange::Message& message) {
    if (const auto* batch = std::get_if<exchange::SegmentBatch>(&message)) {
      ASSERT_TRUE(server->Publish(exchange::Receipt{.server = AgentId("server"),
                                                    .key = batch->pieces.front().key,
                                                    .reason = "crosses hall at 12.3 m"}));
    }
    const auto* status = std::get_if<exchange::AgentStatus>(&message);
    is_shown |= status != nullptr && status->mode == exchange::AgentMode::kTeaching &&
                status->detail == "crosses hall at 12.3 m";
  };
  // While it drives, and it drives no further before that.
  device_.before_frame = [&](int frame) -> Result<void> {
    const auto until = std::chrono::steady_clock::now() + test::kLongEnough;
    while (frame == kFrames - 1 && !is_shown && std::chrono::steady_clock::now() < until) {
      for (const auto& message : server->Take(milliseconds(20))) answer(message);
    }
    return {};
  };
  const Said said;
  auto options = swarm_.ScoutNamed("scout");
  options.link.delivery_timeout = milliseconds(100);
  (void)swarm_.Teach(device_, options, true);
  EXPECT_TRUE(is_shown);
  EXPECT_THAT(said.text(), HasSubstr("what is being taught crosses hall at 12.3 m"));
}

TEST_F(ScoutTest, KeepsWhatNoServerConfirmedAndDeliversItLater) {
  auto options = swarm_.ScoutNamed("scout");
  options.link.delivery_timeout = milliseconds(100);
  const auto alone = swarm_.Teach(device_, options, true);
  ASSERT_FALSE(alone);
  EXPECT_THAT(alone.error().message,
              AllOf(HasSubstr("segments not acknowledged, kept in " + options.link.store_file),
                    HasSubstr("deliver")));
  swarm_.StartServer();
  options.link.delivery_timeout = std::chrono::seconds(20);
  const auto delivered =
      DeliverBacklog(options.link, swarm_.OpenStore("scout"), swarm_.Join(exchange::ScoutTopics()));
  ASSERT_TRUE(delivered) << delivered.error().message;
  swarm_.StopServer();
  EXPECT_TRUE(route::SameTeaching(Taught("server"), Taught("scout")));
}

TEST_F(ScoutTest, StopsTheRobotFirstWhenTheCameraFailsAndKeepsWhatWasTaught) {
  device_.before_frame = [](int frame) -> Result<void> {
    if (frame < 100) return {};
    return Fail(ErrorCode::kUnavailable, "the camera is unplugged");
  };
  const auto summary = swarm_.Teach(device_, swarm_.ScoutNamed("scout"), false);
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().message,
              AllOf(HasSubstr("unplugged"), HasSubstr("segments taught before are kept in")));
  ASSERT_FALSE(device_.told.empty());
  EXPECT_EQ(device_.told.front(), motion::VelocityCommand{});
  EXPECT_GE(Taught("scout").segment_count, 1U);
  EXPECT_EQ(Taught("scout").state, RouteState::kComplete);
  EXPECT_TRUE(Taught("scout").cut_off);
}

TEST_F(ScoutTest, TeachesWhatIsDrivenBackwardsAsSuch) {
  device_.odometry = [](int frame) {
    return motion::Pose2{0.02 * (frame < 100 ? frame : 200 - frame), 0.0, 0.0};
  };
  const Said said;
  const auto summary = swarm_.Teach(device_, swarm_.ScoutNamed("scout"), false);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_THAT(said.text(), HasSubstr("driven backwards: so will those be that follow"));
  const auto route = Taught("scout");
  EXPECT_FALSE(route.cut_off);
  EXPECT_NEAR(route.length_m, 2.0 + 1.0, 0.2);
  const auto store = swarm_.OpenStore("scout");
  int reverse = 0;
  for (std::uint32_t i = 0; i < route.segment_count; ++i) {
    const auto piece = store->ReadSegment(route.key, SegmentIndex(i));
    ASSERT_TRUE(piece);
    reverse += route::Open(*piece)->reverse ? 1 : 0;
  }
  EXPECT_GE(reverse, 1);
  EXPECT_LT(reverse, static_cast<int>(route.segment_count));
}

TEST_F(ScoutTest, SaysThatATurnAtTheVeryEndIsNotTaught) {
  device_.odometry = [](int frame) {
    return motion::Pose2{0.02 * std::min(frame, 100), 0.0, -0.03 * std::max(0, frame - 100)};
  };
  const Said said;
  const auto summary = swarm_.Teach(device_, swarm_.ScoutNamed("scout"), false);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_THAT(said.text(), HasSubstr("the route ends before the turn on the spot at its end"));
  EXPECT_THAT(said.text(), HasSubstr("degrees to the right"));
  EXPECT_NEAR(Taught("scout").length_m, 2.0, 0.06);
}

TEST_F(ScoutTest, EndsTheRouteWhereASignalStopsIt) {
  auto options = swarm_.ScoutNamed("scout");
  std::atomic<bool> stop{false};
  options.link.stop = [&] { return stop.load(); };
  device_.before_frame = [&](int frame) {
    stop = frame >= 100;
    return Result<void>{};
  };
  const auto summary = swarm_.Teach(device_, options, false);
  EXPECT_EQ(Value(summary, "frames"), "100");
  EXPECT_EQ(Taught("scout").state, RouteState::kComplete);
}

TEST_F(ScoutTest, TeachesNothingInTheDarkAndLeavesNoRoute) {
  class Dark : public WalkDevice {
   public:
    using WalkDevice::WalkDevice;
    Result<std::optional<Observation>> Next() override {
      auto seen = WalkDevice::Next();
      if (seen && *seen) (*seen)->odometry.reset();
      return seen;
    }
  } device{20};
  device.blind = true;
  const auto summary = swarm_.Teach(device, swarm_.ScoutNamed("scout"), false);
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().message, HasSubstr("nothing was taught"));
  EXPECT_THAT(*swarm_.OpenStore("scout")->ListRoutes(), IsEmpty());
}

TEST_F(ScoutTest, TeachesARouteAgainAsItsNextRevision) {
  ASSERT_TRUE(swarm_.Teach(device_, swarm_.ScoutNamed("scout"), false));
  WalkDevice again(kFrames);
  const auto summary = swarm_.Teach(again, swarm_.ScoutNamed("scout"), false);
  EXPECT_EQ(Value(summary, "revision"), "2");
  const auto routes = swarm_.OpenStore("scout")->FindRoutesByName("hall");
  ASSERT_THAT(*routes, SizeIs(2));
  EXPECT_EQ(routes->front().key.route, routes->back().key.route);
}

// Both robots hold revision 1 and each teaches its second while no server is there.
TEST_F(ScoutTest, TwoThatTeachTheSameRouteAgainBothArriveUnderNumbersOfTheirOwn) {
  ASSERT_TRUE(swarm_.Teach(device_, swarm_.ScoutNamed("first"), false));
  std::filesystem::copy_file(swarm_.StoreFile("first"), swarm_.StoreFile("second"));
  WalkDevice further(kFrames + 50);
  WalkDevice again(kFrames);
  EXPECT_EQ(Value(swarm_.Teach(further, swarm_.ScoutNamed("first"), false), "revision"), "2");
  EXPECT_EQ(Value(swarm_.Teach(again, swarm_.ScoutNamed("second"), false), "revision"), "2");
  swarm_.StartServer();
  for (const std::string name : {"first", "second"}) {
    const auto delivered = DeliverBacklog(swarm_.ScoutNamed(name).link, swarm_.OpenStore(name),
                                          swarm_.Join(exchange::ScoutTopics()));
    ASSERT_TRUE(delivered) << delivered.error().message;
  }
  swarm_.StopServer();
  const auto server = swarm_.OpenStore("server");
  for (const std::string name : {"first", "second"}) {
    const auto store = swarm_.OpenStore(name);
    const auto all = store->FindRoutesByName("hall").value();
    for (const route::RouteInfo& taught : all) {
      const auto there = server->FindRoute(taught.key);
      ASSERT_TRUE(there && *there) << name << "'s revision " << taught.revision.value();
      EXPECT_TRUE(route::SameTeaching(**there, taught));
      EXPECT_EQ((*there)->revision, taught.revision) << "its scout learns the number";
      EXPECT_THAT(*server->HeldSegments(taught.key), SizeIs(taught.segment_count));
      EXPECT_THAT(*store->UnreceiptedSegments(taught.key), IsEmpty());
    }
  }
  std::set<std::uint32_t> numbers;
  const auto held = server->FindRoutesByName("hall").value();
  for (const route::RouteInfo& info : held) {
    numbers.insert(info.revision.value());
  }
  EXPECT_EQ(numbers, (std::set<std::uint32_t>{1, 2, 3}));
}

TEST_F(ScoutTest, FillsAServerThatWasPutBackFromABackup) {
  swarm_.StartServer();
  ASSERT_TRUE(swarm_.Teach(device_, swarm_.ScoutNamed("scout"), true));
  swarm_.StopServer();
  const std::filesystem::path backup = swarm_.StoreFile("backup");
  std::filesystem::copy_file(swarm_.StoreFile("server"), backup);
  swarm_.StartServer();
  WalkDevice again(kFrames);
  ASSERT_TRUE(swarm_.Teach(again, swarm_.ScoutNamed("scout"), true));
  swarm_.StopServer();
  for (const bool restored : {true, false}) {  // false: a new server
    std::filesystem::remove(swarm_.StoreFile("server"));
    if (restored) std::filesystem::copy_file(backup, swarm_.StoreFile("server"));
    swarm_.StartServer();
    const auto delivered =
        DeliverBacklog(swarm_.ScoutNamed("scout").link, swarm_.OpenStore("scout"),
                       swarm_.Join(exchange::ScoutTopics()));
    ASSERT_TRUE(delivered) << delivered.error().message;
    swarm_.StopServer();
    const auto server = swarm_.OpenStore("server");
    const auto taught = swarm_.OpenStore("scout")->FindRoutesByName("hall").value();
    ASSERT_THAT(taught, SizeIs(2));
    for (const route::RouteInfo& info : taught) {
      const auto there = server->FindRoute(info.key).value();
      ASSERT_TRUE(there) << "revision " << info.revision.value();
      EXPECT_TRUE(route::SameTeaching(*there, info));
      EXPECT_EQ(there->revision, info.revision);
      EXPECT_THAT(*server->HeldSegments(info.key), SizeIs(info.segment_count));
    }
  }
}

TEST_F(ScoutTest, RefusesANameThatIsTakenBeforeTheFirstFrame) {
  const auto end = swarm_.Join(exchange::ScoutTopics());
  exchange::AgentStatus status;
  status.agent = AgentId("scout");
  status.instance = 1;
  status.mode = exchange::AgentMode::kTeaching;
  const std::jthread running([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      EXPECT_TRUE(end->Publish(status));
      (void)end->Take(milliseconds(50));
    }
  });
  const auto summary = swarm_.Teach(device_, swarm_.ScoutNamed("scout"), true);
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().message, HasSubstr("already used"));
  EXPECT_EQ(device_.next, 0);
}

}  // namespace
}  // namespace trailcast::agent
