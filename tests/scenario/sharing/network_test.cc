// Programs on networks that are slow, lossy, or cut for a while. TRAILCAST_OUTAGE_S=60 also cuts
// the link for so long.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>

#include "services/store/route_store.h"
#include "tests/scenario/programs.h"
#include "tests/support/await.h"
#include "tests/support/network_lab.h"
#include "tests/support/places.h"
#include "tests/support/taught_route.h"

namespace trailcast::test {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

constexpr int kServer = 1;
constexpr int kRobot = 2;
constexpr int kFeatures = 38;  // of a segment: some 4 KB

double SecondOfDay(const std::string& line) {
  int hour = 0;
  int minute = 0;
  double second = 0.0;
  EXPECT_EQ(std::sscanf(line.c_str(), "%d:%d:%lf", &hour, &minute, &second), 3) << line;
  return hour * 3600.0 + minute * 60.0 + second;
}

class NetworkTest : public ProgramsTest {
 protected:
  void SetUp() override {
    if (const std::string obstacle = NetworkLab::Obstacle(); !obstacle.empty()) {
      GTEST_SKIP() << obstacle;
    }
    lab_.emplace();
    lab_->AddHost(kServer);
    lab_->AddHost(kRobot);
  }

  std::unique_ptr<Process> StartAt(int host, const std::string& program, const Words& words,
                                   const std::string& log) {
    Words all{"/usr/bin/env", "CYCLONEDDS_URI=" + cyclonedds_uri_, ProgramsDir() + "/" + program,
              "--network-interface", "eth0"};
    all.insert(all.end(), words.begin(), words.end());
    return std::make_unique<Process>(lab_->At(host, all), Path(log + ".log"));
  }
  std::unique_ptr<Process> RobotAt(const Words& words, const std::string& log = "agent") {
    return StartAt(kRobot, "trailcast-agent", words, log);
  }
  void StartServer() {
    server_ = StartAt(kServer, "trailcast-server", {"--store", Path("server.db")}, "server");
    ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
  }
  // Ends the server; what it counted, in its own words: "segments stored".
  std::uint64_t ServersCountOf(const std::string& what) {
    server_->Signal(SIGTERM);
    EXPECT_EQ(server_->Wait(), 0);
    return NumberIn(server_->output(), "([0-9]+) " + what);
  }
  static std::uint64_t NumberIn(const std::string& text, const std::string& pattern) {
    std::smatch found;
    if (std::regex_search(text, found, std::regex(pattern))) return std::stoull(found[1]);
    ADD_FAILURE() << pattern << " is not in:\n" << text;
    return 0;
  }
  // Some seventeen segments in as many seconds.
  Words TeachSimulated(const Words& more) {
    return With({"teach", "--sim", "indoor", "--camera", kSmallPictures, "--speed", "0.8",
                 "--route", "hall", "--store", Path("scout.db"), "--server"},
                more);
  }
  // Everything is there, and nothing went over the air twice.
  void ExpectDeliveredOnce() {
    const auto taught = HeldBy("scout.db");
    EXPECT_FALSE(taught.empty());
    EXPECT_EQ(ServersCountOf("segments stored,"), taught.size());
    EXPECT_EQ(ServersCountOf("received again"), 0U);
    EXPECT_EQ(HeldBy("server.db"), taught);
  }
  std::vector<route::SegmentPiece> HeldBy(const std::string& file) {
    std::vector<route::SegmentPiece> pieces;
    auto store = store::OpenSqliteStore(Path(file));
    EXPECT_TRUE(store) << store.error().message;
    if (!store) return pieces;
    const auto routes = (*store)->ListRoutes().value();
    for (const route::RouteInfo& info : routes) {
      EXPECT_EQ(info.state, route::RouteState::kComplete);
      const auto held = (*store)->HeldSegments(info.key).value();
      for (const SegmentIndex index : held) {
        pieces.push_back((*store)->ReadSegment(info.key, index).value());
      }
    }
    return pieces;
  }

  void OutageWhileTeaching(seconds outage) {
    StartServer();
    const auto scout = RobotAt(TeachSimulated({"--delivery-timeout", "60"}));
    ASSERT_TRUE(server_->WaitForOutput("segments stored and acknowledged")) << scout->output();
    lab_->Cut(kRobot);
    std::this_thread::sleep_for(outage);
    lab_->Join(kRobot);
    const auto ended = End(*scout);
    EXPECT_EQ(ended.status, 0) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr("unreceipted=0"));
    ExpectDeliveredOnce();
  }

  std::optional<NetworkLab> lab_;
  std::string cyclonedds_uri_ = "<CycloneDDS/>";
  std::unique_ptr<Process> server_;
};

using StoreAndForward = NetworkTest;

TEST_F(StoreAndForward, DeliversAfterAnOutageShorterThanTheLease) {
  OutageWhileTeaching(seconds(4));
}

TEST_F(StoreAndForward, DeliversAfterAnOutageLongerThanTheLease) {
  OutageWhileTeaching(seconds(15));
}

TEST_F(StoreAndForward, DeliversAfterAnOutageOfAsLongAsWasAskedFor) {
  const char* wanted = std::getenv("TRAILCAST_OUTAGE_S");  // NOLINT(concurrency-mt-unsafe)
  if (wanted == nullptr) GTEST_SKIP() << "TRAILCAST_OUTAGE_S=60 asks for it";
  OutageWhileTeaching(seconds(std::atoi(wanted)));
}

TEST_F(StoreAndForward, DeliversWhatWasTaughtOutOfRangeFromStartToEnd) {
  StartServer();
  lab_->Cut(kRobot);
  const auto scout = RobotAt(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"),
                                  {"--server", "--delivery-timeout", "60", "--discovery", "star"}));
  ASSERT_TRUE(scout->WaitForOutput("waiting for a server's acknowledgement")) << scout->output();
  ASSERT_TRUE(scout->WaitForOutput("no server heard yet")) << scout->output();
  lab_->Join(kRobot);
  const auto ended = End(*scout);
  EXPECT_EQ(ended.status, 0) << ended.output;
  ExpectDeliveredOnce();
}

TEST_F(StoreAndForward, AScoutKilledOutOfRangeDeliversWhatItHadTaught) {
  StartServer();
  auto scout = RobotAt(TeachSimulated({}));
  ASSERT_TRUE(server_->WaitForOutput("segments stored and acknowledged")) << scout->output();
  lab_->Cut(kRobot);
  ASSERT_TRUE(scout->WaitForOutput("segment 4 of 'hall'")) << scout->output();
  scout->Signal(SIGKILL);
  (void)scout->Wait();
  lab_->Join(kRobot);
  scout = RobotAt({"deliver", "--store", Path("scout.db")}, "again");
  const auto ended = End(*scout);
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_GE(HeldBy("scout.db").size(), 5U);
  ExpectDeliveredOnce();
}

class FetchOverBadNetworks : public NetworkTest {
 protected:
  // The server has a route of so many segments.
  void Prepare(std::uint32_t segments, const std::string& rate) {
    taught_ = TeachSamples(segments, kFeatures);
    taught_.info.standing = route::Standing::kActive;
    {
      auto store = store::OpenSqliteStore(Path("server.db"));
      ASSERT_TRUE(store) << store.error().message;
      ASSERT_TRUE((*store)->PutRoute(taught_.info));
      ASSERT_TRUE((*store)->AppendSegments(taught_.pieces));
    }
    lab_->Limit(kServer, rate);
    StartServer();
  }
  std::unique_ptr<Process> Fetch(const std::string& log = "agent") {
    return RobotAt({"--log-level", "debug", "--store", Path("robot.db"), "--name", "robot", "fetch",
                    "--route", "hall"},
                   log);
  }
  void ExpectAllHere() { EXPECT_EQ(HeldBy("robot.db"), taught_.pieces); }
  std::size_t HeldByRobot() {
    auto store = store::OpenSqliteStore(Path("robot.db"));
    return store ? (*store)->HeldSegments(taught_.info.key).value().size() : 0;
  }
  // Each estimate against what it came to in the end.
  static void ExpectEstimatesRight(const std::string& log) {
    std::istringstream lines(log);
    std::vector<std::pair<double, double>> estimates;  // said at, seconds left
    double ended = 0.0;
    const std::regex estimate("are here, about ([0-9]+) s left");
    for (std::string line; std::getline(lines, line);) {
      std::smatch found;
      if (std::regex_search(line, found, estimate)) {
        estimates.emplace_back(SecondOfDay(line), std::stod(found[1]));
      } else if (line.find(" all ") != std::string::npos) {
        ended = SecondOfDay(line);
      }
    }
    ASSERT_FALSE(estimates.empty()) << log;
    for (const auto& [said_at, left_s] : estimates) {
      if (ended < said_at) continue;  // midnight
      EXPECT_NEAR(left_s, ended - said_at, 3.0 + 0.4 * (ended - said_at)) << log;
    }
  }

  TaughtRoute taught_;
};

TEST_F(FetchOverBadNetworks, ResumesWithWhatIsMissingWhereverItWasCut) {
  constexpr std::uint32_t kSegments = 600;
  Prepare(kSegments, "8mbit");
  std::size_t held = 0;
  int kills = 0;
  while (kills < 3 && held < kSegments - 100) {
    const std::size_t wanted = held + 50;
    const std::string log = fmt::format("fetch{}", kills++);
    const auto fetch = Fetch(log);
    // Killed at any moment after so many.
    const auto enough = [&] {
      std::smatch found;
      std::string last;
      const std::string output = fetch->output();
      const std::regex here("robot: ([0-9]+) segments of 'hall' are here");
      for (std::sregex_iterator at(output.begin(), output.end(), here), end; at != end; ++at) {
        last = (*at)[1];
      }
      return !last.empty() && std::stoul(last) >= wanted;
    };
    const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
    while (!enough() && !fetch->Ended() && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(enough()) << fetch->output();
    fetch->Signal(SIGKILL);
    (void)fetch->Wait();
    ASSERT_GT(HeldByRobot(), held);
    held = HeldByRobot();
  }
  const auto fetch = Fetch("last");
  const auto ended = End(*fetch);
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr(fmt::format("{} of them here", held)));
  ExpectAllHere();
  // Only segments that were on their way at a cut are sent again.
  constexpr std::uint64_t kUnderWay = 160;
  EXPECT_LE(ServersCountOf("sent to followers"), kSegments + 3 * kUnderWay);
}

TEST_F(FetchOverBadNetworks, GoesOnAfterTheLinkWasCut) {
  constexpr std::uint32_t kSegments = 600;
  Prepare(kSegments, "4mbit");
  const auto fetch = Fetch();
  ASSERT_TRUE(fetch->WaitForOutput("s left")) << fetch->output();
  lab_->Cut(kRobot);
  std::this_thread::sleep_for(seconds(15));
  lab_->Join(kRobot);
  const auto ended = End(*fetch);
  EXPECT_EQ(ended.status, 0) << ended.output;
  ExpectAllHere();
  // The outage costs less than fetching all of it anew.
  EXPECT_LT(ServersCountOf("sent to followers"), 2 * kSegments);
}

TEST_F(FetchOverBadNetworks, SaysHowLongItTakesAndCountsOnlyWhatThisRunFetched) {
  Prepare(1100, "1mbit");
  {
    auto store = store::OpenSqliteStore(Path("robot.db"));
    ASSERT_TRUE(store) << store.error().message;
    ASSERT_TRUE((*store)->AppendSegments(std::span(taught_.pieces).first(800)));
  }
  const auto ended = End(*Fetch());
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("800 of them here"));
  ExpectEstimatesRight(ended.output);
  ExpectAllHere();
}

class FetchWithLoss : public FetchOverBadNetworks, public testing::WithParamInterface<int> {};

TEST_P(FetchWithLoss, Completes) {
  // This is out of a thousand packets, as each end sends them.
  cyclonedds_uri_ = fmt::format(
      "<CycloneDDS><Domain><Internal><Test><XmitLossiness>{}</XmitLossiness></Test></Internal>"
      "</Domain></CycloneDDS>",
      10 * GetParam());
  Prepare(500, "20mbit");
  const auto ended = End(*Fetch());
  EXPECT_EQ(ended.status, 0) << ended.output;
  ExpectAllHere();
}

INSTANTIATE_TEST_SUITE_P(Percent, FetchWithLoss, testing::Values(0, 1, 5, 20),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace trailcast::test
