#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "tests/contract/network.h"
#include "tests/support/await.h"
#include "tests/support/pieces.h"
#include "tests/support/places.h"

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
    std::string program = ProgramsDir() + "/status_peer";
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
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(15)) << "3, and what a busy machine adds";
  EXPECT_TRUE(SeesAlive(1));
}

TEST_F(DdsLivelinessTest, AnAgentThatEndsIsGoneAtOnce) {
  // Sooner than the lease of one that has just said that it is alive can be over. A busy machine
  // may spoil one try.
  constexpr std::chrono::milliseconds kAtOnce{500};
  Clock::duration soonest = Clock::duration::max();
  for (int time = 1; time <= 5 && soonest > kAtOnce; ++time) {
    const auto instance = static_cast<std::uint64_t>(time);
    const Peer peer(tag_, "robot-1", std::to_string(instance));
    ASSERT_TRUE(SeesAlive(instance));
    const auto start = Clock::now();
    peer.Signal(SIGTERM);
    EXPECT_EQ(FirstGone(), (AgentGone{AgentId("robot-1"), instance}));
    soonest = std::min(soonest, Clock::now() - start);
  }
  EXPECT_LT(soonest, kAtOnce);
}

TEST_F(DdsLivelinessTest, AnAgentThatStallsIsGoneAndComesBack) {
  const Peer peer(tag_, "robot-1", "7");
  ASSERT_TRUE(SeesAlive(7));
  peer.Signal(SIGSTOP);
  EXPECT_EQ(FirstGone(), (AgentGone{AgentId("robot-1"), 7}));
  peer.Signal(SIGCONT);
  EXPECT_TRUE(SeesAlive(7));
}

// A reader that hangs, as after it was killed until its lease is over.
TEST_F(DdsLivelinessTest, AReaderThatHangsHoldsUpNeitherTheWriterNorTheOtherReaders) {
  const auto writer = OpenDdsExchange(test::LoopbackOptions(tag_),
                                      {.write = {exchange::Topic::kSegments}, .read = {}})
                          .value();
  const auto other = OpenDdsExchange(test::LoopbackOptions(tag_),
                                     {.write = {}, .read = {exchange::Topic::kSegments}})
                         .value();
  const Peer peer(tag_, "robot-1", "7");
  ASSERT_TRUE(SeesAlive(7));
  const auto batch = [](std::uint32_t number) {
    return exchange::SegmentBatch{AgentId("s"),
                                  {test::PieceOf(test::KeyNumber(1), number, 40'000)}};
  };
  std::uint32_t last = 0;
  std::uint32_t heard = 0;
  const auto hear = [&](const Message& message) {
    const auto* segments = std::get_if<exchange::SegmentBatch>(&message);
    if (segments == nullptr) return;
    last = segments->pieces.front().index.value();
    ++heard;
  };
  const auto deadline = Clock::now() + test::kLongEnough;
  while (heard == 0 && Clock::now() < deadline) {  // they have found each other
    ASSERT_TRUE(writer->Publish(batch(0)));
    for (const Message& message : other->Take(std::chrono::milliseconds(100))) hear(message);
  }
  ASSERT_GT(heard, 0U);
  peer.Signal(SIGSTOP);
  heard = 0;
  constexpr std::uint32_t kBatches = 500;  // 20 MB, more than anybody keeps
  Clock::duration slowest{};
  for (std::uint32_t i = 1; i <= kBatches; ++i) {
    const auto start = Clock::now();
    ASSERT_TRUE(writer->Publish(batch(i)));
    slowest = std::max(slowest, Clock::now() - start);
    for (const Message& message : other->Take(std::chrono::milliseconds(0))) hear(message);
  }
  EXPECT_LT(slowest, std::chrono::seconds(6)) << "the lease of who hangs is 10";
  EXPECT_TRUE(test::TakeUntil(*other, hear, [&] { return last == kBatches; }));
  EXPECT_GT(heard, kBatches / 2);
  peer.Signal(SIGCONT);
  EXPECT_TRUE(SeesAlive(7));
}

TEST_F(DdsLivelinessTest, AReaderThatDoesNotTakeKeepsSoMuchAndNoMore) {
  auto writer = OpenDdsExchange(test::LoopbackOptions(tag_),
                                {.write = {exchange::Topic::kSegments}, .read = {}})
                    .value();
  const auto reader = OpenDdsExchange(test::LoopbackOptions(tag_),
                                      {.write = {}, .read = {exchange::Topic::kSegments}})
                          .value();
  std::size_t heard = 0;
  const auto count = [&](const Message& message) {
    if (std::holds_alternative<exchange::SegmentBatch>(message)) ++heard;
  };
  const exchange::SegmentBatch batch{AgentId("s"), {test::PieceOf(test::KeyNumber(1), 0, 1000)}};
  EXPECT_TRUE(test::TakeUntil(*reader, count, [&] {
    EXPECT_TRUE(writer->Publish(batch));
    return heard > 0;
  }));
  for (int i = 0; i < 2000; ++i) ASSERT_TRUE(writer->Publish(batch));
  writer.reset();  // nothing more comes and takes the place of what is taken
  constexpr std::size_t kKept = 256;
  heard = 0;
  for (const Message& message : reader->Take(std::chrono::seconds(10))) count(message);
  EXPECT_GT(heard, 0U);
  EXPECT_LE(heard, kKept);
}

}  // namespace
}  // namespace trailcast::dds
