#include "agent/camera_view/snapshots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "services/exchange/in_process_exchange.h"
#include "services/image/files.h"
#include "services/program/presence.h"
#include "tests/support/await.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

class SnapshotsTest : public testing::Test {
 protected:
  void Ask(std::uint64_t request) {
    ASSERT_TRUE(desk_->Publish(exchange::SnapshotRequest{
        .agent = AgentId("robot1"), .client = AgentId("desk"), .request = request}));
  }
  // The robot's threads do their part; what comes at the desk by then, and `show` is called when a
  // picture is wanted.
  template <typename Show>
  std::optional<exchange::Snapshot> Answer(const Show& show) {
    const auto until = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < until) {
      (void)robot_->Take(milliseconds(5));
      if (snapshots_.wanted()) show();
      for (const exchange::Message& message : desk_->Take(milliseconds(0))) {
        if (const auto* snapshot = std::get_if<exchange::Snapshot>(&message)) return *snapshot;
      }
    }
    return std::nullopt;
  }
  // Asks until a picture comes. A computer that is busy elsewhere may show one too late for the
  // first answers.
  std::optional<exchange::Snapshot> Picture(std::uint64_t request, const SnapshotFrame& frame) {
    const auto until = steady_clock::now() + test::kLongEnough;
    std::optional<exchange::Snapshot> snapshot;
    do {
      Ask(request);
      snapshot = Answer([&] { snapshots_.Show(frame); });
    } while (snapshot && snapshot->picture.empty() && steady_clock::now() < until);
    return snapshot;
  }

  exchange::InProcessBus bus_;
  Snapshots snapshots_{AgentId("robot1")};
  std::unique_ptr<exchange::RouteExchange> robot_ =
      snapshots_.Through(bus_.Open(program::WithAgents(exchange::OnDutyTopics())));
  std::unique_ptr<exchange::RouteExchange> desk_ = bus_.Open(exchange::SnapshotTopics());
};

TEST_F(SnapshotsTest, WhoAsksGetsAPictureOfFewBytesThatShowsWhatTheRobotSees) {
  SnapshotFrame frame{.picture = test::WalkFrame(3)};
  frame.turn_rad = 0.1;
  const auto snapshot = Picture(7, frame);
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->request, 7U);
  EXPECT_LE(snapshot->picture.size(), Snapshots::kMostBytes);
  EXPECT_THAT(snapshot->detail, HasSubstr("right"));
  const auto picture = image::DecodeRgb(snapshot->picture, "snapshot");
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->width, frame.picture.width);
}

TEST_F(SnapshotsTest, APictureThatIsHardToEncodeIsCoarserAndNotLarger) {
  std::mt19937 random(1);
  SnapshotFrame noise{.picture = {640, 480, std::vector<std::uint8_t>(640 * 480)}};
  for (std::uint8_t& pixel : noise.picture.pixels) pixel = static_cast<std::uint8_t>(random());
  const auto snapshot = Picture(1, noise);
  ASSERT_TRUE(snapshot);
  EXPECT_FALSE(snapshot->picture.empty());
  EXPECT_LE(snapshot->picture.size(), Snapshots::kMostBytes);
}

TEST_F(SnapshotsTest, ACameraThatGivesNothingIsSaid) {
  Ask(1);
  const auto snapshot = Answer([] {});
  ASSERT_TRUE(snapshot);
  EXPECT_TRUE(snapshot->picture.empty());
  EXPECT_THAT(snapshot->detail, HasSubstr("no picture comes"));
}

TEST_F(SnapshotsTest, WhileNobodyLooksNothingIsWantedMadeOrSent) {
  Ask(1);
  SnapshotFrame frame{.picture = test::WalkFrame(3)};
  ASSERT_TRUE(Answer([&] { snapshots_.Show(frame); }));
  int wanted = 0;
  std::size_t sent = 0;
  for (int turn = 0; turn < 100; ++turn) {
    (void)robot_->Take(milliseconds(5));
    if (snapshots_.wanted()) ++wanted;
    sent += desk_->Take(milliseconds(0)).size();
  }
  EXPECT_EQ(wanted, 0);
  EXPECT_EQ(sent, 0U);
}

}  // namespace
}  // namespace trailcast::agent
