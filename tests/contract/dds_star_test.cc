// These test who hears whom: agents of a star round a route server, and of a mesh.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "tests/contract/network.h"
#include "tests/support/await.h"

namespace trailcast::dds {
namespace {

using exchange::AgentRole;
using exchange::AgentStatus;
using exchange::Message;
using exchange::RouteExchange;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// On the network under a name, heard by whoever can hear it.
class Member {
 public:
  Member(const DdsOptions& options, const std::string& name)
      : exchange_(Open(options, name)),
        status_{.agent = AgentId(name), .instance = 1, .mode = exchange::AgentMode::kWaiting} {
    if (options.serves) status_.role = AgentRole::kServer;
  }

  // Says that it is there, and listens.
  void Live() {
    if (const auto now = Clock::now(); now >= say_at_) {
      (void)exchange_->Publish(status_);
      say_at_ = now + milliseconds(100);
    }
    for (const Message& message : exchange_->Take(milliseconds(5))) {
      if (const auto* status = std::get_if<AgentStatus>(&message)) {
        hears_.insert(status->agent.value());
      } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
        hears_.erase(gone->agent.value());
      }
    }
  }
  [[nodiscard]] const std::set<std::string>& hears() const { return hears_; }

 private:
  static std::unique_ptr<RouteExchange> Open(DdsOptions options, const std::string& name) {
    options.self = AgentId(name);
    exchange::TopicUse use{.write = {exchange::Topic::kAgents}, .read = {exchange::Topic::kAgents}};
    (options.serves ? use.write : use.read).push_back(exchange::Topic::kReceipts);
    return OpenDdsExchange(options, use).value();
  }

  std::unique_ptr<RouteExchange> exchange_;
  AgentStatus status_;
  Clock::time_point say_at_{};
  std::set<std::string> hears_;
};

class DdsStarTest : public testing::Test {
 protected:
  using Names = std::set<std::string>;

  DdsOptions Options(Discovery discovery) {
    DdsOptions options = test::LoopbackOptions(tag_);
    options.discovery = discovery;
    options.domain_id = domain_;
    options.tell_of_discovery = [this](const std::string& line) { told_ += line + "\n"; };
    return options;
  }
  std::unique_ptr<Member> Server(const std::string& name = "server") {
    DdsOptions options = Options(Discovery::kMesh);
    options.serves = true;
    return std::make_unique<Member>(options, name);
  }
  std::unique_ptr<Member> Agent(Discovery discovery, const std::string& name) {
    return std::make_unique<Member>(Options(discovery), name);
  }
  static bool Until(const std::vector<Member*>& members, const std::function<bool()>& done) {
    for (const auto deadline = Clock::now() + test::kLongEnough; !done();) {
      if (Clock::now() > deadline) return false;
      for (Member* member : members) member->Live();
    }
    return true;
  }

  std::string tag_ = test::UniqueTag();
  std::uint32_t domain_ = 0;
  std::string told_;
};

TEST_F(DdsStarTest, AgentsOfAStarHearTheServerAndNotEachOther) {
  const auto server = Server();
  const auto one = Agent(Discovery::kStar, "one");
  const auto two = Agent(Discovery::kStar, "two");
  ASSERT_TRUE(Until({server.get(), one.get(), two.get()}, [&] {
    return server->hears() == Names{"one", "two"} && one->hears() == Names{"server"} &&
           two->hears() == Names{"server"};
  }));
  // Later than others heard it they would have heard it.
  const auto three = Agent(Discovery::kStar, "three");
  ASSERT_TRUE(Until({server.get(), one.get(), two.get(), three.get()}, [&] {
    return server->hears().size() == 3 && three->hears() == Names{"server"};
  }));
  EXPECT_EQ(one->hears(), Names{"server"});
  EXPECT_EQ(two->hears(), Names{"server"});
}

TEST_F(DdsStarTest, WhoIsInAMeshHearsAllAndIsHeardByAll) {
  const auto one = Agent(Discovery::kStar, "one");
  const auto two = Agent(Discovery::kStar, "two");
  const auto meshed = Agent(Discovery::kMesh, "meshed");
  EXPECT_TRUE(Until({one.get(), two.get(), meshed.get()}, [&] {
    return meshed->hears() == Names{"one", "two"} && one->hears() == Names{"meshed"} &&
           two->hears() == Names{"meshed"};
  }));
}

// Words of who drives, and what a camera sees, no server passes on.
TEST_F(DdsStarTest, WhoIsInAMeshDrivesARobotOfAStarAndSeesThroughItsCamera) {
  const auto open = [this](Discovery discovery, const std::string& name,
                           const exchange::TopicUse& use) {
    DdsOptions options = Options(discovery);
    options.self = AgentId(name);
    return OpenDdsExchange(options, use).value();
  };
  exchange::TopicUse desk = exchange::DriverTopics();
  desk.write.push_back(exchange::Topic::kSnapshotRequests);
  desk.read.push_back(exchange::Topic::kSnapshots);
  exchange::TopicUse duty = exchange::OnDutyTopics();
  duty.read.push_back(exchange::Topic::kDrives);
  const auto server = Server();
  const auto starred = Agent(Discovery::kStar, "other");
  const auto robot = open(Discovery::kStar, "robot", duty);
  const auto meshed_desk = open(Discovery::kMesh, "meshed", desk);
  const auto starred_desk = open(Discovery::kStar, "starred", desk);
  std::uint64_t words = 0;
  Names drivers;
  Names lookers;
  Names seen_by;
  const auto say = [&](RouteExchange& from, const std::string& name) {
    (void)from.Publish(exchange::DriveCommand{AgentId("robot"), AgentId(name), 0.3, 0.0, ++words});
    (void)from.Publish(exchange::SnapshotRequest{AgentId("robot"), AgentId(name), words});
    for (const Message& message : from.Take(milliseconds(5))) {
      const auto* snapshot = std::get_if<exchange::Snapshot>(&message);
      if (snapshot != nullptr && !snapshot->picture.empty()) seen_by.insert(name);
    }
  };
  EXPECT_TRUE(Until({server.get(), starred.get()}, [&] {
    say(*meshed_desk, "meshed");
    say(*starred_desk, "starred");
    for (const Message& message : robot->Take(milliseconds(5))) {
      if (const auto* word = std::get_if<exchange::DriveCommand>(&message)) {
        drivers.insert(word->client.value());
      } else if (const auto* request = std::get_if<exchange::SnapshotRequest>(&message)) {
        lookers.insert(request->client.value());
        (void)robot->Publish(exchange::Snapshot{.agent = request->agent,
                                                .client = request->client,
                                                .request = request->request,
                                                .picture = {0xFF, 0xD8},
                                                .detail = "seen"});
      }
    }
    return !drivers.empty() && !seen_by.empty() && starred->hears() == Names{"server"};
  }));
  EXPECT_EQ(drivers, Names{"meshed"});
  EXPECT_EQ(lookers, Names{"meshed"});
  EXPECT_EQ(seen_by, Names{"meshed"});
}

TEST_F(DdsStarTest, AServerThatStartsAnewIsFoundAndServersFindEachOther) {
  auto server = Server();
  const auto agent = Agent(Discovery::kStar, "agent");
  ASSERT_TRUE(
      Until({server.get(), agent.get()}, [&] { return agent->hears().count("server") > 0; }));
  server.reset();
  ASSERT_TRUE(Until({agent.get()}, [&] { return agent->hears().empty(); }));
  server = Server();
  const auto other = Server("other");
  EXPECT_TRUE(Until({server.get(), other.get(), agent.get()}, [&] {
    return agent->hears() == Names{"server", "other"} && other->hears().count("server") > 0;
  }));
}

TEST_F(DdsStarTest, WithoutAServerThereIsAMeshAndWithOneAStar) {
  const auto one = Agent(Discovery::kAuto, "one");
  const auto two = Agent(Discovery::kAuto, "two");
  ASSERT_TRUE(Until({one.get(), two.get()},
                    [&] { return one->hears() == Names{"two"} && two->hears() == Names{"one"}; }));
  EXPECT_NE(told_.find("looking for everybody"), std::string::npos) << told_;
  const auto server = Server();
  EXPECT_TRUE(Until({one.get(), two.get(), server.get()}, [&] {
    return one->hears() == Names{"server"} && two->hears() == Names{"server"};
  }));
}

TEST_F(DdsStarTest, AnAddressIsEnough) {
  // Its server has the fixed ports: below those that the kernel gives to others.
  domain_ = 10 + static_cast<std::uint32_t>(getpid()) % 90;
  DdsOptions options = Options(Discovery::kStar);
  options.server_addresses = {"localhost"};
  Member agent(options, "agent");
  const auto server = Server();
  ASSERT_EQ(told_, "");
  EXPECT_TRUE(Until({&agent, server.get()}, [&] {
    return agent.hears() == Names{"server"} && server->hears() == Names{"agent"};
  }));
  const auto other = Server("other");
  EXPECT_NE(told_.find("ports"), std::string::npos) << told_;
}

}  // namespace
}  // namespace trailcast::dds
