#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "tests/contract/network.h"
#include "tests/support/pieces.h"

namespace trailcast::dds {
namespace {

using exchange::AgentGone;
using exchange::AgentStatus;
using exchange::Message;
using Clock = std::chrono::steady_clock;

// Another process with an agent in it.
class Peer {
 public:
  Peer(std::string tag, std::string agent, std::string instance) {
    std::string program = TRAILCAST_BINARY_DIR "/status_peer";
    const std::array<char*, 5> arguments{program.data(), tag.data(), agent.data(), instance.data(),
                                         nullptr};
    EXPECT_EQ(posix_spawn(&pid_, program.c_str(), nullptr, nullptr, arguments.data(), environ), 0);
  }
  ~Peer() {
    Signal(SIGKILL);
    (void)waitpid(pid_, nullptr, 0);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void Signal(int number) const {
    if (pid_ > 0) (void)kill(pid_, number);
  }

 private:
  pid_t pid_ = 0;
};

class DdsLivelinessTest : public testing::Test {
 protected:
  bool SeesAlive(std::uint64_t instance) {
    bool alive = false;
    return test::TakeUntil(
        *watcher_,
        [&](const Message& message) {
          const auto* status = std::get_if<AgentStatus>(&message);
          if (status != nullptr && status->instance == instance) alive = true;
        },
        [&] { return alive; });
  }
  // The first to be reported gone.
  AgentGone FirstGone() {
    AgentGone first;
    EXPECT_TRUE(test::TakeUntil(
        *watcher_,
        [&](const Message& message) {
          const auto* gone = std::get_if<AgentGone>(&message);
          if (gone != nullptr && first.instance == 0) first = *gone;
        },
        [&] { return first.instance != 0; }));
    return first;
  }

  const std::string tag_ = test::UniqueTag();
  std::unique_ptr<exchange::RouteExchange> watcher_ =
      OpenDdsExchange(test::LoopbackOptions(tag_), exchange::OperatorTopics()).value();
};

TEST_F(DdsLivelinessTest, AnAgentThatIsKilledIsGoneWithinItsLease) {
  const Peer twin(tag_, "robot-1", "1");
  const Peer killed(tag_, "robot-1", "2");
  ASSERT_TRUE(SeesAlive(1));
  ASSERT_TRUE(SeesAlive(2));
  const auto start = Clock::now();
  killed.Signal(SIGKILL);
  EXPECT_EQ(FirstGone(), (AgentGone{AgentId("robot-1"), 2}));
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(8));
  EXPECT_TRUE(SeesAlive(1));
}

TEST_F(DdsLivelinessTest, AnAgentThatEndsIsGoneAtOnce) {
  const Peer peer(tag_, "robot-1", "7");
  ASSERT_TRUE(SeesAlive(7));
  const auto start = Clock::now();
  peer.Signal(SIGTERM);
  EXPECT_EQ(FirstGone(), (AgentGone{AgentId("robot-1"), 7}));
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(2));
}

TEST_F(DdsLivelinessTest, AnAgentThatStallsIsGoneAndComesBack) {
  const Peer peer(tag_, "robot-1", "7");
  ASSERT_TRUE(SeesAlive(7));
  peer.Signal(SIGSTOP);
  EXPECT_EQ(FirstGone(), (AgentGone{AgentId("robot-1"), 7}));
  peer.Signal(SIGCONT);
  EXPECT_TRUE(SeesAlive(7));
}

TEST_F(DdsLivelinessTest, PublishFailsInTimeWhileAReaderIsStalledAndSucceedsAfterwards) {
  const auto writer = OpenDdsExchange(test::LoopbackOptions(tag_),
                                      {.write = {exchange::Topic::kSegments}, .read = {}})
                          .value();
  const Peer peer(tag_, "robot-1", "7");
  ASSERT_TRUE(SeesAlive(7));
  const exchange::SegmentBatch batch{AgentId("s"), test::PiecesOf(test::KeyNumber(1), 100, 4096)};
  const auto publish_in_time = [&] {
    const auto deadline = Clock::now() + std::chrono::seconds(20);
    while (!writer->Publish(batch)) ASSERT_LT(Clock::now(), deadline);
  };
  publish_in_time();
  peer.Signal(SIGSTOP);
  Result<void> published;
  Clock::duration slowest{};
  for (int i = 0; i < 200 && published; ++i) {
    const auto start = Clock::now();
    published = writer->Publish(batch);
    slowest = std::max(slowest, Clock::now() - start);
  }
  ASSERT_FALSE(published);
  EXPECT_EQ(published.error().code, ErrorCode::kUnavailable) << published.error().message;
  EXPECT_LT(slowest, std::chrono::seconds(5));
  peer.Signal(SIGCONT);
  publish_in_time();
}

}  // namespace
}  // namespace trailcast::dds
