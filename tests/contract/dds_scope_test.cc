#include "services/dds/src/domain/scope.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "tests/contract/network.h"
#include "tests/support/pieces.h"

namespace trailcast::dds {
namespace {

using exchange::Message;
using testing::ElementsAre;

TEST(Scope, IsOneOfThirtyTwoByTheTeaching) {
  EXPECT_EQ(ScopeOf(test::KeyNumber(7, 1)), "01");
  EXPECT_EQ(ScopeOf(test::KeyNumber(8, 33)), "01");
  EXPECT_EQ(ScopeOf(test::KeyNumber(7, 63)), "1f");
  EXPECT_EQ(ScopeOf(test::KeyNumber(7, 32)), "00");
}

TEST(Scope, IsBelowAMembersOwnPartitionUnlessItsKeysAllowNone) {
  DdsOptions self;
  EXPECT_EQ(WritersPartition(self, "1f"), "1f");
  EXPECT_EQ(WritersPartition(self, kEverybody), "");
  EXPECT_THAT(ListenersPartitions(self, "1f"), ElementsAre("1f", ""));
  self.keys = security::MemberKeys{
      .member = {.role = security::Role::kScout, .id = "4f2a9c0d11223344"}, .scoped = true};
  EXPECT_EQ(WritersPartition(self, "1f"), "scout/4f2a9c0d11223344/1f");
  EXPECT_EQ(WritersPartition(self, kEverybody), "scout/4f2a9c0d11223344");
  EXPECT_THAT(ListenersPartitions(self, "1f"), ElementsAre("*/1f", "*/????????????????"));
  self.keys->scoped = false;
  EXPECT_EQ(WritersPartition(self, "1f"), "scout/4f2a9c0d11223344");
}

// A loopback interface that nobody else uses: the calling thread's, and its threads'.
bool HaveLoopbackOfOnesOwn() {
  if (unshare(CLONE_NEWNET) != 0) return false;
  const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  request.ifr_name[0] = 'l';
  request.ifr_name[1] = 'o';
  request.ifr_flags = IFF_UP;
  const bool up = ioctl(any, SIOCSIFFLAGS, &request) == 0;
  close(any);
  return up;
}

double SentOnLoopback() {
  std::ifstream file("/proc/thread-self/net/dev");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find("lo:");
    if (colon == std::string::npos) continue;
    std::istringstream columns(line.substr(colon + 3));
    double bytes = 0.0;
    columns >> bytes;
    return bytes;
  }
  return 0.0;
}

class EightFollowers {
 public:
  static constexpr double kPayload = 500 * 4096.0;

  // How many times the route's bytes are sent so that the first `listening` of them get it.
  double TimesSent(std::size_t listening) {
    for (std::size_t i = 0; i < followers_.size(); ++i) {
      const std::set<route::RouteKey> route{key_};
      EXPECT_TRUE(followers_[i]->Listen(exchange::Topic::kSegments,
                                        i < listening ? route : std::set<route::RouteKey>()));
    }
    for (std::size_t i = 0; i < listening; ++i) {
      EXPECT_TRUE(HearsAll(
          *followers_[i], [&] { return Say({test::PieceOf(key_, 0)}); }, 0));
    }
    const double before = SentOnLoopback();
    EXPECT_TRUE(Say(test::PiecesOf(key_, 500, 4096)));
    for (std::size_t i = 0; i < listening; ++i) {
      EXPECT_TRUE(HearsAll(
          *followers_[i], [] { return true; }, 499));
    }
    return (SentOnLoopback() - before) / kPayload;
  }

 private:
  bool Say(const std::vector<route::SegmentPiece>& pieces) {
    return holder_->Publish(exchange::SegmentBatch{AgentId("server"), pieces}).has_value();
  }
  // `say` again and again until segment `last` came.
  static bool HearsAll(exchange::RouteExchange& follower, const std::function<bool()>& say,
                       std::uint32_t last) {
    for (int time = 0; time < 1000; ++time) {
      if (!say()) return false;
      for (const auto& piece : test::PiecesIn(follower.Take(std::chrono::milliseconds(20)))) {
        if (piece.index.value() == last) return true;
      }
    }
    return false;
  }
  std::unique_ptr<exchange::RouteExchange> Open(const exchange::TopicUse& use) const {
    DdsOptions options = test::LoopbackOptions(tag_);
    options.extra_config_xml =
        "<CycloneDDS><Domain><General><AllowMulticast>spdp</AllowMulticast></General></Domain>"
        "</CycloneDDS>";
    return OpenDdsExchange(options, use).value();
  }

  const route::RouteKey key_ = test::KeyNumber(1);
  const std::string tag_ = test::UniqueTag();
  std::unique_ptr<exchange::RouteExchange> holder_ = Open(exchange::ServerTopics());
  std::vector<std::unique_ptr<exchange::RouteExchange>> followers_ = [this] {
    std::vector<std::unique_ptr<exchange::RouteExchange>> all;
    for (int i = 0; i < 8; ++i) all.push_back(Open(exchange::FollowerTopics()));
    return all;
  }();
};

TEST(Scope, WithoutMulticastOfEightFollowersOnlyWhoFetchesCosts) {
  bool apart = false;
  double to_one = 0.0;
  double to_all = 0.0;
  std::thread([&] {
    apart = HaveLoopbackOfOnesOwn();
    if (!apart) return;
    EightFollowers followers;
    to_one = followers.TimesSent(1);
    to_all = followers.TimesSent(8);
  }).join();
  if (!apart) GTEST_SKIP() << "only root gets a network of its own";
  EXPECT_GT(to_one, 0.9);
  EXPECT_GT(to_all, 7.0) << "each gets its own copy here";
  EXPECT_LT(to_one, to_all / 2.0) << "what a slow machine has sent again included";
}

}  // namespace
}  // namespace trailcast::dds
