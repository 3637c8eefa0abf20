#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "agent/diagnosis/run_log_reader.h"
#include "agent/follow/follower.h"
#include "services/image/files.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using test::WalkDevice;
using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

class FollowerLogTest : public testing::Test {
 protected:
  // Taught by one walk, followed by another, with a log.
  RunLog Follow(WalkDevice& device) {
    WalkDevice scout(150);
    const auto taught = swarm_.Teach(scout, swarm_.ScoutNamed("robot"), false);
    EXPECT_TRUE(taught) << taught.error().message;
    FollowerOptions options = swarm_.FollowerNamed("robot");
    options.diagnosis = diagnosis_;
    options.diagnosis.log = folder_ / "run.mcap";
    options.link.now_handler = hold_;
    options.how.session.intake.roll_deg = roll_deg_;
    const auto outcome = swarm_.Replay(device, options, false);
    EXPECT_TRUE(outcome && outcome->diagnosed);
    frames_ = outcome->log.frames();
    auto log = ReadRunLog(folder_ / "run.mcap");
    EXPECT_TRUE(log) << log.error().message;
    return *log;
  }
  NowHandler* hold_ = nullptr;
  double roll_deg_ = 0.0;
  std::size_t frames_ = 0;
  DiagnosisOptions diagnosis_{.patient = true};  // fewer frames may wait than it has
  test::TempDir folder_;
  test::Swarm swarm_;
};

std::size_t CountEvents(const RunLog& log, const std::string& what) {
  return static_cast<std::size_t>(
      std::count_if(log.events.begin(), log.events.end(),
                    [&](const RunEvent& event) { return event.what == what; }));
}

TEST_F(FollowerLogTest, TellsEveryFrameAndEverySegmentOfARunThatArrives) {
  WalkDevice device(220);
  const RunLog log = Follow(device);
  EXPECT_EQ(log.header.Find("route"), "hall");
  EXPECT_EQ(log.header.Find("camera"), "walk 160x120");
  EXPECT_EQ(log.header.Find("method"), "default");
  EXPECT_EQ(log.frames.size(), frames_);
  EXPECT_EQ(log.damaged, 0U);
  ASSERT_TRUE(log.ending);
  EXPECT_EQ(log.ending->fields.Find("state"), "ARRIVED");
  const FrameRow& last = log.frames.back();
  EXPECT_EQ(last.phase, Phase::kArrived);
  EXPECT_NEAR(*last.driven_m, 0.02 * static_cast<double>(frames_ - 1), 0.01);
  EXPECT_EQ(CountEvents(log, "hand-over"), static_cast<std::size_t>(last.segment) + 1);
  EXPECT_TRUE(log.frames[50].left_m) << "the default method estimates its place";
  EXPECT_FALSE(log.frames[50].delta) << "and has no delta";
}

TEST_F(FollowerLogTest, ALogThatIsFullSaysSoAndHowItEnded) {
  diagnosis_.most_log_bytes = 1;
  diagnosis_.header.Add("mission", "m1");
  WalkDevice device(220);
  const RunLog log = Follow(device);
  EXPECT_EQ(log.header.Find("mission"), "m1");
  EXPECT_LT(log.frames.size(), frames_);
  EXPECT_THAT(log.events, Contains(AllOf(Field(&RunEvent::what, "dropped"),
                                         Field(&RunEvent::text, HasSubstr("all later frames")))));
  ASSERT_TRUE(log.ending);
  EXPECT_EQ(log.ending->fields.Find("state"), "ARRIVED");
}

TEST_F(FollowerLogTest, ProgressNeverRunsAheadByASegment) {
  WalkDevice device(220);
  const RunLog log = Follow(device);
  const double segment = 1.0 / *log.header.Number("segments");
  for (std::size_t i = 1; i < log.frames.size(); ++i) {
    EXPECT_LT(log.frames[i].progress, log.frames[i - 1].progress + 0.5 * segment) << i;
  }
}

TEST_F(FollowerLogTest, SaysThatTheViewWasCoveredAndWhatBecameOfTheFeatures) {
  WalkDevice device(220);
  device.before_frame = [&](int frame) -> Result<void> {
    device.blind = frame >= 60 && frame < 75;
    return {};
  };
  const RunLog log = Follow(device);
  EXPECT_THAT(log.events, Contains(Field(&RunEvent::text, HasSubstr("covers the view"))));
  ASSERT_GT(log.frames.size(), 70U);
  EXPECT_EQ(log.frames[59].phase, Phase::kSure);
  EXPECT_GE(log.frames[60].not_returned, log.frames[59].tracked / 2);
  EXPECT_EQ(log.frames[65].phase, Phase::kCovered);
  EXPECT_EQ(log.frames[65].linear_mps, 0.0);
  EXPECT_EQ(log.frames[70].segment, log.frames[59].segment) << "nothing is to be seen of the next";
}

TEST_F(FollowerLogTest, DrawsEveryTenthFrame) {
  diagnosis_.view = folder_ / "view";
  diagnosis_.view_every = 10;
  WalkDevice device(220);
  Follow(device);
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "view")) {
    EXPECT_EQ(entry.path().extension(), ".png");
    ++pictures;
  }
  EXPECT_EQ(pictures, (frames_ + 9) / 10);
}

// By how much two pictures differ, where the first is enlarged to the second.
double Unlike(const image::GrayImage& picture, const image::GrayImage& enlarged) {
  const int times = enlarged.width / picture.width;
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int large = (times * y + times / 2) * enlarged.width + times * x + times / 2;
      sum += std::abs(picture.pixels[static_cast<std::size_t>(y * picture.width + x)] -
                      enlarged.pixels[static_cast<std::size_t>(large)]);
    }
  }
  return sum;
}

// Its camera hangs upside down.
class HangingDevice : public WalkDevice {
 public:
  using WalkDevice::WalkDevice;
  Result<std::optional<Observation>> Next() override {
    auto seen = WalkDevice::Next();
    if (seen && *seen) std::reverse((*seen)->image.pixels.begin(), (*seen)->image.pixels.end());
    return seen;
  }
};

TEST_F(FollowerLogTest, OfARobotThatIsHeldItDrawsTheFramesThatNobodyLooksAt) {
  NowHandler handler(AgentId("robot"), {});
  handler.Pause("somebody walks here");
  hold_ = &handler;
  roll_deg_ = 180.0;
  diagnosis_.view = folder_ / "view";
  HangingDevice device(80);
  const RunLog log = Follow(device);
  ASSERT_EQ(log.frames.size(), 80U);
  EXPECT_EQ(log.frames.back().linear_mps, 0.0);
  for (const int frame : {40, 60, 79}) {
    const auto drawn = image::ReadGray(diagnosis_.view / fmt::format("{:06}.png", frame));
    ASSERT_TRUE(drawn) << drawn.error().message;
    std::map<double, int> by_likeness;
    for (int i = 0; i < 80; ++i) by_likeness.emplace(Unlike(test::WalkFrame(i), *drawn), i);
    EXPECT_EQ(by_likeness.begin()->second, frame);
  }
}

TEST_F(FollowerLogTest, ARobotThatFindsNoRouteLeavesALogThatSaysWhy) {
  FollowerOptions options = swarm_.FollowerNamed("robot");
  options.diagnosis.log = folder_ / "run.mcap";
  options.link.wait = std::chrono::milliseconds(50);
  WalkDevice device(10);
  ASSERT_TRUE(swarm_.Replay(device, options, false));
  const auto log = ReadRunLog(folder_ / "run.mcap");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_TRUE(log->frames.empty());
  ASSERT_TRUE(log->ending);
  EXPECT_THAT(log->ending->text, HasSubstr("hall"));
}

TEST_F(FollowerLogTest, ALogThatCannotBeMadeIsSaidBeforeTheRobotMoves) {
  FollowerOptions options = swarm_.FollowerNamed("robot");
  options.diagnosis.log = folder_ / "missing" / "run.mcap";
  WalkDevice device(10);
  const auto outcome = swarm_.Replay(device, options, false);
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().message, HasSubstr("run.mcap"));
  EXPECT_EQ(device.next, 0);
}

}  // namespace
}  // namespace trailcast::agent
