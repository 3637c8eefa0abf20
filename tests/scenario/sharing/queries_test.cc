// Five hundred robots ask at once where they are: the server goes on saying that it is well.
#include <arpa/inet.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <thread>

#include "services/dds/dds_exchange.h"
#include "services/route/manifest.h"
#include "services/store/route_store.h"
#include "tests/scenario/programs.h"
#include "tests/support/await.h"
#include "tests/support/pieces.h"
#include "tests/support/seen_segment.h"

namespace trailcast::test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr int kClients = 500;
constexpr unsigned kSegments = 2000;
constexpr milliseconds kPollEvery{10};

int FreePort() {
  const int any = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  EXPECT_EQ(bind(any, reinterpret_cast<const sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(any, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(any);
  return ntohs(address.sin_port);
}

class QueriesTest : public ProgramsTest {
 protected:
  QueriesTest() {
    route::RouteInfo info;
    info.key = KeyNumber(1);
    info.name = "hall";
    info.scout = AgentId("scout");
    info.taught_unix_ms = 1;
    route::RouteBuilder builder(info);
    std::vector<route::SegmentPiece> pieces;
    for (unsigned i = 0; i < kSegments; ++i) pieces.push_back(builder.Add(SegmentToSee(i, i)));
    builder.Complete();
    const auto store = store::OpenSqliteStore(Path("server.db")).value();
    EXPECT_TRUE(store->AppendSegments(pieces));
    EXPECT_TRUE(store->PutRoute(builder.info()));
  }
  std::unique_ptr<exchange::RouteExchange> Join() const {
    dds::DdsOptions options;
    options.discovery_tag = tag_;
    options.network_interface = "lo";
    options.self = AgentId("robots");
    return dds::OpenDdsExchange(options, exchange::ObserverTopics()).value();
  }
  // Each robot is at a segment of its own, and every other one sees it in disorder: nothing looks
  // like that, which the server knows once it has compared as many candidates as it ever does.
  static std::uint32_t Whereabouts(int client) { return static_cast<std::uint32_t>(client) * 3; }
  static bool IsNowhere(int client) { return client % 2 == 1; }
  static exchange::CatalogRequest Question(int client) {
    const route::View view =
        ViewOf(SegmentToSee(Whereabouts(client), 0), {.shuffled = IsNowhere(client)});
    return {AgentId(fmt::format("robot-{}", client)), 1, {.view = view}};
  }
  static bool IsRight(const exchange::CatalogReply& reply, int client) {
    if (IsNowhere(client)) return reply.places.empty();
    return !reply.places.empty() &&
           reply.places.front().segment == SegmentIndex(Whereabouts(client));
  }
  // Replies that came meanwhile.
  std::vector<exchange::CatalogReply> Take(milliseconds wait) {
    std::vector<exchange::CatalogReply> replies;
    for (exchange::Message& message : robots_->Take(wait)) {
      if (auto* reply = std::get_if<exchange::CatalogReply>(&message)) {
        replies.push_back(std::move(*reply));
      }
    }
    return replies;
  }
  // All is indexed, and the way there and back is known.
  void AwaitReady() {
    const auto deadline = Clock::now() + test::kLongEnough;
    while (Clock::now() < deadline) {
      (void)robots_->Publish(Question(kClients));
      for (const exchange::CatalogReply& reply : Take(milliseconds(200))) {
        if (reply.coverage.segments_indexed == kSegments) return;
      }
    }
    FAIL() << "the server did not answer by all of its segments";
  }
  void Ask(const std::set<int>& clients) {
    for (const int client : clients) {
      EXPECT_TRUE(robots_->Publish(Question(client)));
    }
  }

  const int port_ = FreePort();
  std::unique_ptr<exchange::RouteExchange> robots_;
};

// The longest that one took, and how many there were.
struct Asked {
  int times = 0;
  milliseconds longest{0};
  std::string wrong;
  void Note(Clock::time_point began, const std::string& trouble) {
    ++times;
    longest = std::max(longest, std::chrono::duration_cast<milliseconds>(Clock::now() - began));
    if (!trouble.empty()) wrong = trouble;
  }
};

TEST_F(QueriesTest, FiveHundredByViewAtOnceHoldUpNoWordOnHealth) {
  const Words options{"--store",     Path("server.db"), "--http-port", std::to_string(port_),
                      "--heartbeat", Path("heartbeat")};
  const auto server = Start("trailcast-server", options, "server");
  ASSERT_TRUE(server->WaitForOutput("ready")) << server->output();
  robots_ = Join();
  AwaitReady();

  std::set<int> waiting;
  for (int client = 0; client < kClients; ++client) waiting.insert(client);
  Asked page;
  Asked command;
  std::jthread asks_page([&](const std::stop_token& stop) {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(test::kLongEnough);
    while (!stop.stop_requested()) {
      const auto began = Clock::now();
      const auto got = client.Get("/health");
      page.Note(began, got && got->status == 200 ? "" : "no 200 of /health");
      std::this_thread::sleep_for(kPollEvery);
    }
  });
  std::jthread asks_command([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto began = Clock::now();
      const auto ended =
          End(*Start("trailcast-server", {"--heartbeat", Path("heartbeat"), "health"}, "health"));
      command.Note(began, ended.status == 0 ? "" : ended.output);
    }
  });
  const auto began = Clock::now();
  Ask(waiting);
  milliseconds last{0};
  int right = 0;
  while (!waiting.empty() && Clock::now() < began + test::kLongEnough) {
    for (const exchange::CatalogReply& reply : Take(milliseconds(50))) {
      const int client = std::stoi(reply.client.value().substr(std::string("robot-").size()));
      if (waiting.erase(client) == 0) continue;
      EXPECT_EQ(reply.error, "");
      right += IsRight(reply, client) ? 1 : 0;
    }
    last = std::chrono::duration_cast<milliseconds>(Clock::now() - began);
  }
  asks_page = {};
  asks_command = {};
  EXPECT_TRUE(waiting.empty()) << waiting.size() << " robots were not answered";
  EXPECT_EQ(right, kClients);
  // Some hundred in the second or so that they take: held up it would be one. Time itself says
  // less: a busy machine stands for as long.
  EXPECT_GE(page.times, 10);
  EXPECT_GE(command.times, 2);
  EXPECT_EQ(page.wrong, "");
  EXPECT_EQ(command.wrong, "");
  fmt::print("{} answers in {} ms; /health asked {} times, {} ms at most; health {} times, {} ms\n",
             kClients, last.count(), page.times, page.longest.count(), command.times,
             command.longest.count());
}

}  // namespace
}  // namespace trailcast::test
