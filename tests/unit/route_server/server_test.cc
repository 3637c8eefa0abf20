#include "route_server/server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_sender.h"
#include "services/program/presence.h"
#include "services/route/digest.h"
#include "tests/support/await.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/photos/a_photo.h"
#include "tests/unit/photos/held_disk.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Takes whatever is appended, and thinks for a while about each query.
class SlowStore : public test::MemoryStore {
 public:
  Result<route::RoutePage> QueryRoutes(const route::RouteQuery& query) override {
    std::this_thread::sleep_for(milliseconds(10));
    return MemoryStore::QueryRoutes(query);
  }
  Result<void> AppendSegments(std::span<const route::SegmentPiece>) override {
    if (disk_full) return Fail(ErrorCode::kUnavailable, "the disk is full");
    return {};
  }
  std::atomic<bool> disk_full = false;
};

class ServerTest : public testing::Test {
 protected:
  void Start(const QuotaOptions& quotas = {}, const std::filesystem::path& junctions = {},
             const std::filesystem::path& missions = {},
             std::unique_ptr<photos::PhotoFolder> photos = nullptr) {
    auto store = std::make_unique<SlowStore>();
    store_ = store.get();
    auto server = Server::Open(AgentId("server"), std::move(store),
                               bus_.Open(program::WithAgents(exchange::ServerTopics())));
    server_ = std::move(*server);
    auto page = HttpPage::Open("127.0.0.1", 0, [](const Error&) {}).value();
    port_ = page->port();
    server_->ShowOn(std::move(page));
    if (quotas.any()) server_->Limit(quotas);
    if (!junctions.empty()) {
      ASSERT_TRUE(server_->KeepNetwork(store::NetworkStore::Open(junctions).value()));
    }
    if (!missions.empty()) {
      ASSERT_TRUE(server_->KeepMissions(store::MissionStore::Open(missions).value()));
    }
    if (photos) server_->KeepPhotos(std::move(photos));
    running_ = std::thread([this] { (void)server_->Run([this] { return stopping_.load(); }); });
  }
  void TearDown() override {
    stopping_ = true;
    if (running_.joinable()) running_.join();
  }

  // The whole route, as its scout has it.
  static exchange::RouteSender SenderOf(const route::RouteKey& key, std::uint32_t segments) {
    std::vector<route::SegmentPiece> pieces = test::PiecesOf(key, segments);
    std::vector<route::Digest> digests;
    for (route::SegmentPiece& piece : pieces) {
      piece.digest = route::Sha256(piece.bytes);
      digests.push_back(piece.digest);
    }
    route::RouteInfo info = test::InfoOf(key, pieces, route::RouteState::kComplete);
    info.manifest_digest = route::ManifestDigest(digests);
    const auto read = [pieces](SegmentIndex index) -> Result<route::SegmentPiece> {
      return pieces.at(index.value());
    };
    return {info.scout, info, read, exchange::SegmentDigests(digests), {}};
  }
  // Runs until all is acknowledged, or the server refuses something for a reason like this.
  static bool Delivers(exchange::RouteSender& sender, exchange::RouteExchange& exchange,
                       const std::string& until_refused = {}) {
    bool refused = false;
    const auto until = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < until && !sender.AllReceipted() && !refused) {
      for (const exchange::Message& message : exchange.Take(milliseconds(20))) {
        sender.Handle(message, steady_clock::now());
      }
      refused = !until_refused.empty() && sender.refused() &&
                sender.refused()->reason.find(until_refused) != std::string::npos;
      (void)exchange::PublishAll(exchange, sender.Tick(steady_clock::now()));
    }
    return refused || sender.AllReceipted();
  }
  // Messages are taken until one of them, or time, is right.
  static bool Hears(exchange::RouteExchange& exchange,
                    const std::function<bool(const exchange::Message&)>& right) {
    const auto until = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < until) {
      for (const exchange::Message& message : exchange.Take(milliseconds(20))) {
        if (right(message)) return true;
      }
    }
    return false;
  }

  // Returns the reply to words about the network: lines, or the error.
  template <typename Words>
  std::string NetworkSays(exchange::RouteExchange& desk, const Words& words) {
    std::string said;
    EXPECT_TRUE(desk.Publish(words));
    EXPECT_TRUE(Hears(desk, [&](const exchange::Message& message) {
      const auto* reply = std::get_if<exchange::NetworkReply>(&message);
      if (reply == nullptr || reply->client != words.client || reply->request != words.request) {
        return false;
      }
      said = reply->error;
      for (const std::string& line : reply->lines) said += line + "\n";
      return true;
    }));
    return said;
  }

  exchange::InProcessBus bus_;
  SlowStore* store_ = nullptr;  // the server's
  int port_ = 0;                // of its page
  std::unique_ptr<Server> server_;
  std::atomic<bool> stopping_{false};
  std::thread running_;
};

TEST_F(ServerTest, PassesOnWhatOperatorsTellRobotsAndTheirAnswersOnce) {
  Start();
  const auto desk = bus_.Open(exchange::DispatcherTopics());
  const auto robot = bus_.Open(program::WithAgents(exchange::FollowerTopics()));
  const exchange::NowCommand stop{.client = AgentId("desk"), .number = 1};
  ASSERT_TRUE(desk->Publish(stop));
  EXPECT_TRUE(Hears(*robot, [](const exchange::Message& message) {
    const auto* command = std::get_if<exchange::NowCommand>(&message);
    return command != nullptr && command->relayed && command->client == AgentId("desk");
  }));
  const exchange::NowAnswer answer{
      .agent = AgentId("robot"), .client = AgentId("desk"), .number = 1};
  ASSERT_TRUE(robot->Publish(answer));
  EXPECT_TRUE(Hears(*desk, [](const exchange::Message& message) {
    const auto* passed = std::get_if<exchange::NowAnswer>(&message);
    return passed != nullptr && passed->relayed && passed->agent == AgentId("robot");
  }));
  // A command that another server has passed on already is not passed on again.
  exchange::NowCommand relayed = stop;
  relayed.relayed = true;
  relayed.number = 2;
  ASSERT_TRUE(desk->Publish(relayed));
  exchange::NowCommand next = stop;
  next.number = 3;
  ASSERT_TRUE(desk->Publish(next));
  int heard = 0;
  EXPECT_TRUE(Hears(*robot, [&](const exchange::Message& message) {
    const auto* command = std::get_if<exchange::NowCommand>(&message);
    heard += command != nullptr && command->number == 2 ? 1 : 0;
    return command != nullptr && command->number == 3 && command->relayed;
  }));
  EXPECT_EQ(heard, 1);
}

TEST_F(ServerTest, HundredsOfSlowQueriesHoldUpNeitherReceiptsNorItsStatus) {
  Start();
  constexpr int kClients = 500;
  const auto desk = bus_.Open(exchange::OperatorTopics());
  ASSERT_TRUE(Hears(*desk, [](const exchange::Message& message) {
    const auto* status = std::get_if<exchange::AgentStatus>(&message);
    return status != nullptr && status->mode == exchange::AgentMode::kWaiting;
  })) << "it serves";
  for (int i = 0; i < kClients; ++i) {
    ASSERT_TRUE(desk->Publish(
        exchange::CatalogRequest{AgentId(fmt::format("client-{}", i)), 1, {.name = "hall"}}));
  }
  const auto scout = bus_.Open(exchange::ScoutTopics());
  route::SegmentPiece piece{test::KeyNumber(1), SegmentIndex(0), {}, {1, 2, 3}};
  piece.digest = route::Sha256(piece.bytes);
  ASSERT_TRUE(scout->Publish(exchange::SegmentBatch{AgentId("scout"), {piece}}));
  ASSERT_TRUE(Hears(*scout, [](const exchange::Message& message) {
    const auto* receipt = std::get_if<exchange::Receipt>(&message);
    return receipt != nullptr && receipt->durable_prefix == 1;
  }));
  int statuses = 0;
  int answered = 0;
  const auto count = [&](const exchange::Message& message) {
    statuses += std::holds_alternative<exchange::AgentStatus>(message) && answered < kClients;
    answered += std::holds_alternative<exchange::CatalogReply>(message);
    return answered == kClients;
  };
  for (const exchange::Message& message : desk->Take(milliseconds(0))) (void)count(message);
  EXPECT_LT(answered, kClients / 2) << "a receipt does not wait for them";
  EXPECT_TRUE(Hears(*desk, count)) << "all are answered in the end";
  EXPECT_GE(statuses, 2) << "it tells of itself each second meanwhile";
}

TEST_F(ServerTest, APhotoOnASlowDiskHoldsUpNoMessages) {
  const test::TempDir folder;
  photos::HeldDisk disk;
  Start({}, {}, {}, photos::PhotoFolder::Open(folder.path(), 1'000'000, disk.Write()).value());
  const auto robot = bus_.Open(program::WithAgents(exchange::OnDutyTopics()));
  const auto desk = bus_.Open(exchange::DispatcherTopics());
  const auto jpeg = photos::SomeJpeg(100);
  const photos::Photo photo = photos::APhoto('a', jpeg);
  ASSERT_TRUE(robot->Publish(exchange::PhotoPiece{.holder = photo.robot,
                                                  .client = AgentId("server"),
                                                  .photo = photo.id,
                                                  .words = ToText(photo),
                                                  .bytes = jpeg}));
  EXPECT_TRUE(desk->Publish(exchange::NowCommand{.client = AgentId("desk"), .number = 1}));
  bool is_kept = false;
  EXPECT_TRUE(Hears(*robot, [&](const exchange::Message& message) {
    is_kept = is_kept || std::holds_alternative<exchange::PhotoRequest>(message);
    const auto* command = std::get_if<exchange::NowCommand>(&message);
    return command != nullptr && command->relayed;
  })) << "a stop is passed on while the disk is busy";
  EXPECT_FALSE(is_kept);
  disk.Let();
  EXPECT_TRUE(Hears(*robot, [&](const exchange::Message& message) {
    const auto* told = std::get_if<exchange::PhotoRequest>(&message);
    return told != nullptr && told->photo == photo.id && told->kept;
  }));
}

TEST_F(ServerTest, ADeliveredRouteIsPartOfTheNetworkAtOnce) {
  const test::TempDir folder;
  Start({}, folder / "joints");
  const auto desk = bus_.Open(exchange::JoinerTopics());
  const auto observer = bus_.Open(exchange::NetworkTopics());
  const exchange::NetworkEdit close{AgentId("desk"), 1, "close corridor 5..7"};
  EXPECT_EQ(NetworkSays(*desk, close), "there is no route 'corridor'");
  const auto scout = bus_.Open(exchange::ScoutTopics());
  exchange::RouteSender sender = SenderOf(test::KeyNumber(1), 12);
  ASSERT_TRUE(Delivers(sender, *scout));
  exchange::NetworkEdit again = close;
  again.request = 2;
  EXPECT_EQ(NetworkSays(*desk, again), "close corridor 5..7\n");
  const auto ask = [](std::uint64_t request, const std::string& words) {
    return exchange::NetworkRequest{AgentId("observer"), request, words, 0};
  };
  EXPECT_EQ(NetworkSays(*observer, ask(1, "way corridor@1 corridor@5")), "follow corridor 1..5\n");
  EXPECT_THAT(NetworkSays(*observer, ask(2, "way corridor@1 corridor@6")),
              testing::HasSubstr("corridor 5..7"));
  EXPECT_EQ(NetworkSays(*observer, ask(3, "")), "route corridor 24.00\nclose corridor 5..7\n");
}

TEST_F(ServerTest, AServerWithoutANetworkSaysSo) {
  Start();
  const auto desk = bus_.Open(exchange::JoinerTopics());
  EXPECT_THAT(NetworkSays(*desk, exchange::NetworkEdit{AgentId("desk"), 1, "open corridor"}),
              testing::HasSubstr("keeps no network of routes"));
}

TEST_F(ServerTest, ThatItsDiskIsFullItsHealthTellsUntilThereIsRoom) {
  Start();
  const auto is_full = [this]() -> std::optional<bool> {
    httplib::Client client("127.0.0.1", port_);
    const auto got = client.Get("/health");
    if (!got || got->status != 200) return std::nullopt;
    return got->body.find("nothing that scouts send is stored: the disk is full") !=
           std::string::npos;
  };
  ASSERT_TRUE(test::Await([&] { return is_full() == false; }, "a server that is well"));
  store_->disk_full = true;
  const auto scout = bus_.Open(exchange::ScoutTopics());
  exchange::RouteSender sender = SenderOf(test::KeyNumber(1), 3);
  EXPECT_TRUE(Delivers(sender, *scout, "the disk is full"));
  EXPECT_TRUE(test::Await([&] { return is_full() == true; }, "that it is told"));
  store_->disk_full = false;
  EXPECT_TRUE(Delivers(sender, *scout));
  EXPECT_TRUE(test::Await([&] { return is_full() == false; }, "that there is room again"));
}

TEST_F(ServerTest, AScoutOverItsQuotaIsToldSoAndLosesNothing) {
  Start({.segments_per_s = 5});
  const auto scout = bus_.Open(exchange::ScoutTopics());
  exchange::RouteSender sender = SenderOf(test::KeyNumber(1), 12);
  EXPECT_TRUE(Delivers(sender, *scout, "may have 5 segments a second"));
  EXPECT_FALSE(sender.AllReceipted());
  EXPECT_TRUE(Delivers(sender, *scout)) << sender.Unreceipted().size() << " left";
}

TEST_F(ServerTest, ARouteBeyondAScoutsQuotaWaits) {
  Start({.routes = 1});
  const auto scout = bus_.Open(exchange::ScoutTopics());
  exchange::RouteSender first = SenderOf(test::KeyNumber(1), 2);
  EXPECT_TRUE(Delivers(first, *scout));
  exchange::RouteSender second = SenderOf(test::KeyNumber(2), 2);
  EXPECT_TRUE(Delivers(second, *scout, "may have 1 routes here"));
  EXPECT_EQ(second.Unreceipted().size(), 2U);
}

TEST_F(ServerTest, AClientOverItsQuotaIsAnsweredWithTheReason) {
  Start({.requests_per_s = 1});
  const auto desk = bus_.Open(exchange::OperatorTopics());
  std::uint64_t asked = 0;
  int refused = 0;
  int answered = 0;
  // A server that is slow to look has room for one more each second.
  const auto until = steady_clock::now() + test::kLongEnough;
  while ((refused == 0 || answered == 0) && steady_clock::now() < until) {
    for (int i = 0; i < 3; ++i) {
      ++asked;
      ASSERT_TRUE(desk->Publish(
          exchange::CatalogRequest{AgentId("desk"), asked, {.name = fmt::format("r{}", asked)}}));
    }
    (void)Hears(*desk, [&](const exchange::Message& message) {
      if (const auto* reply = std::get_if<exchange::CatalogReply>(&message)) {
        ++(reply->error.find("over quota") != std::string::npos ? refused : answered);
      }
      return refused + answered == static_cast<int>(asked);
    });
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(answered, 0);
  EXPECT_EQ(refused + answered, static_cast<int>(asked)) << "each has its reply";
}

class MissionsTest : public ServerTest {
 protected:
  static exchange::TopicUse SendingTopics() {
    exchange::TopicUse use = exchange::DispatcherTopics();
    use.write.push_back(exchange::Topic::kMissions);
    use.write.push_back(exchange::Topic::kMissionRequests);
    use.write.push_back(exchange::Topic::kCatalogRequests);
    use.read.push_back(exchange::Topic::kMissionStates);
    use.read.push_back(exchange::Topic::kMissionReplies);
    return use;
  }
  static mission::Mission Of(const std::string& client, const std::string& id,
                             const std::string& orders = "follow hall") {
    return {.agent = AgentId("robot1"), .id = id, .client = AgentId(client), .orders = orders};
  }
  // The server's answer to a mission that is sent.
  mission::Report Answered(const mission::Mission& mission) {
    EXPECT_TRUE(desk_->Publish(mission));
    mission::Report answer;
    EXPECT_TRUE(Hears(*desk_, [&](const exchange::Message& message) {
      const auto* report = std::get_if<mission::Report>(&message);
      if (report == nullptr || report->mission != mission.id) return false;
      answer = *report;
      return true;
    }));
    return answer;
  }

  const test::TempDir folder_;
  std::unique_ptr<exchange::RouteExchange> desk_ = bus_.Open(SendingTopics());
};

TEST_F(MissionsTest, OfAMemberOverItsQuotaArePutOffAndAStopIsNot) {
  Start({.requests_per_s = 1}, {}, folder_ / "missions");
  const auto robot = bus_.Open(program::WithAgents(exchange::FollowerTopics()));
  // A server that is slow has room for one more each second.
  std::optional<mission::Mission> put_off;
  test::Await(
      [&, sent = 0]() mutable {
        const std::string process = std::to_string(++sent);
        const mission::Mission mission = Of("desk-p" + process, "m" + process);
        const mission::Report answer = Answered(mission);
        if (answer.state == mission::State::kPutOff) {
          EXPECT_THAT(answer.detail, testing::HasSubstr("over quota: 'desk' may ask 1 times"));
          put_off = mission;
        }
        return put_off.has_value();
      },
      "a mission that is put off");
  ASSERT_TRUE(put_off);
  EXPECT_EQ(Answered(Of("desk-p1", "wrong", "dance")).state, mission::State::kRefused)
      << "what nobody understands costs nothing and is refused for good";
  ASSERT_TRUE(desk_->Publish(exchange::NowCommand{.client = AgentId("desk"), .number = 1}));
  EXPECT_TRUE(Hears(*robot, [](const exchange::Message& message) {
    const auto* command = std::get_if<exchange::NowCommand>(&message);
    return command != nullptr && command->relayed;
  }));
  test::Await([&] { return Answered(*put_off).state == mission::State::kSent; },
              "the mission that was put off, sent again");
}

TEST_F(MissionsTest, QuestionsAboutThemCountAsOthersDo) {
  Start({.requests_per_s = 1}, {}, folder_ / "missions");
  bool refused = false;
  test::Await(
      [&, request = std::uint64_t{0}]() mutable {
        ++request;
        EXPECT_TRUE(desk_->Publish(exchange::MissionRequest{
            .client = AgentId("desk-p" + std::to_string(request)), .request = request}));
        EXPECT_TRUE(Hears(*desk_, [&](const exchange::Message& message) {
          const auto* reply = std::get_if<exchange::MissionReply>(&message);
          if (reply == nullptr || reply->request != request) return false;
          refused = reply->error.find("over quota: 'desk'") != std::string::npos;
          return true;
        }));
        return refused;
      },
      "a question over the quota");
}

TEST_F(MissionsTest, AServerThatKeepsNoneSaysSo) {
  Start();
  ASSERT_TRUE(desk_->Publish(exchange::MissionRequest{.client = AgentId("desk"), .request = 1}));
  EXPECT_TRUE(Hears(*desk_, [](const exchange::Message& message) {
    const auto* reply = std::get_if<exchange::MissionReply>(&message);
    return reply != nullptr && reply->error.find("keeps no missions") != std::string::npos;
  }));
}

TEST_F(MissionsTest, ThatWaitForTheirTurnAreMeantByACancellationToo) {
  Start({}, {}, folder_ / "missions");
  // These are slow, and before it.
  for (std::uint64_t i = 1; i < RequestQueue::kMostOfAMember; ++i) {
    ASSERT_TRUE(desk_->Publish(
        exchange::CatalogRequest{AgentId("desk"), i, {.name = fmt::format("r{}", i)}}));
  }
  ASSERT_TRUE(desk_->Publish(Of("desk", "m1")));
  // A message on another topic may come first: the server has the mission once this is answered.
  ASSERT_TRUE(desk_->Publish(exchange::MissionRequest{.client = AgentId("lab"), .request = 1}));
  ASSERT_TRUE(Hears(*desk_, [](const exchange::Message& message) {
    return std::holds_alternative<exchange::MissionReply>(message);
  }));
  ASSERT_TRUE(desk_->Publish(exchange::NowCommand{
      .client = AgentId("lab"), .number = 1, .order = mission::NowOrder::kCancel}));
  EXPECT_TRUE(Hears(*desk_, [](const exchange::Message& message) {
    const auto* report = std::get_if<mission::Report>(&message);
    return report != nullptr && report->state == mission::State::kCancelled;
  }));
}

}  // namespace
}  // namespace trailcast::server
