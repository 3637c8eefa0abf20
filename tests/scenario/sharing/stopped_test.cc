// A process that is stopped in the middle (SIGSTOP: neither gone nor there) costs the others no
// memory: they do not keep for it what it does not take.
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <utility>

#include "services/route/manifest.h"
#include "services/store/route_store.h"
#include "tests/scenario/programs.h"
#include "tests/support/await.h"
#include "tests/support/pieces.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::test {
namespace {

// Few, with long tracks: what a server keeps of each in its index of views shall not matter.
constexpr int kFeatures = 8;
constexpr int kKnots = 64;
constexpr double kBeginningMB = 2.0;  // of the route has arrived when somebody is stopped
// On their way to one reader are 12 MB at most; the rest is what the allocator keeps.
constexpr double kBoundMB = 25.0;

// More: TRAILCAST_STOPPED_MB=100.
double RouteMB() {
  const char* wanted = std::getenv("TRAILCAST_STOPPED_MB");  // NOLINT(concurrency-mt-unsafe)
  return wanted == nullptr ? 45.0 : std::atof(wanted);
}

double StatusMB(pid_t pid, const std::string& field) {
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  std::string word;
  double kB = -1.0;
  while (status >> word) {
    if (word == field && status >> kB) break;
  }
  return kB / 1000.0;
}

// How far a process's resident memory went beyond what it was at the beginning.
class MemoryWatch {
 public:
  explicit MemoryWatch(const Process& process) : pid_(process.pid()) {
    std::ofstream(fmt::format("/proc/{}/clear_refs", pid_)) << "5";  // the peak is what is there
    begin_mb_ = StatusMB(pid_, "VmRSS:");
  }
  [[nodiscard]] double begin_mb() const { return begin_mb_; }
  [[nodiscard]] double grown_mb() const { return StatusMB(pid_, "VmHWM:") - begin_mb_; }

 private:
  pid_t pid_;
  double begin_mb_ = 0.0;
};

class StoppedTest : public ProgramsTest {
 protected:
  // A store with the route, as its server or its scout has it.
  void Put(const std::string& store, unsigned number, route::Standing standing) const {
    route::RouteInfo info;
    info.key = KeyNumber(number);
    info.name = fmt::format("hall-{}", number);
    info.scout = AgentId("scout");
    info.standing = standing;
    route::RouteBuilder route(info);
    const auto opened = store::OpenSqliteStore(Path(store)).value();
    std::vector<route::SegmentPiece> pieces;
    for (std::uint32_t i = 0; 1e-6 * route.info().bytes < RouteMB(); ++i) {
      pieces.push_back(route.Add(route::SampleSegment(i, kFeatures, kKnots)));
      if (pieces.size() < 1000) continue;
      ASSERT_TRUE(opened->AppendSegments(std::exchange(pieces, {})));
    }
    route.Complete();
    ASSERT_TRUE(opened->AppendSegments(pieces));
    ASSERT_TRUE(opened->PutRoute(route.info()));
  }
  std::unique_ptr<Process> Fetch(const std::string& name) {
    return Agent({"fetch", "--name", name, "--route", "hall-1", "--store", Path(name + ".db")},
                 name);
  }
  std::unique_ptr<Process> Deliver(const std::string& name) {
    return Agent(
        {"deliver", "--name", name, "--store", Path(name + ".db"), "--delivery-timeout", "120"},
        name);
  }
  [[nodiscard]] double SizeMB(const std::string& store) const {
    double bytes = 0.0;
    for (const char* end : {"", "-wal"}) {
      struct stat file {};
      if (stat(Path(store + end).c_str(), &file) == 0) bytes += static_cast<double>(file.st_size);
    }
    return 1e-6 * bytes;
  }
  // In the middle of what fills that store, which was so large before.
  void AwaitGrown(const std::string& store, const Process& filling, double begin_mb = 0.0) const {
    const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
    while (SizeMB(store) < begin_mb + kBeginningMB) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << filling.output();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  static void ExpectDone(Process& process) {
    process.Signal(SIGCONT);
    EXPECT_EQ(process.Wait(), 0) << process.output();
  }
  static void ExpectBounded(const char* whose, const MemoryWatch& watch) {
    EXPECT_LT(watch.grown_mb(), kBoundMB) << whose;
    fmt::print("{:.0f} MB: {}: {:.1f} MB and {:.1f} more at most\n", RouteMB(), whose,
               watch.begin_mb(), watch.grown_mb());
  }
};

TEST_F(StoppedTest, AFollowerInMidFetchCostsTheServerNoMemoryWhileAnotherFetches) {
  Put("server.db", 1, route::Standing::kActive);
  const auto server =
      Start("trailcast-server", {"--store", Path("server.db"), "--log-level", "debug"}, "server");
  ASSERT_TRUE(server->WaitForOutput("segments indexed by view")) << server->output();
  const auto stopped = Fetch("stopped");
  AwaitGrown("stopped.db", *stopped);
  stopped->Signal(SIGSTOP);
  const MemoryWatch watch(*server);
  ExpectDone(*Fetch("another"));
  ExpectBounded("the server, a follower stopped", watch);
  ExpectDone(*stopped);
}

TEST_F(StoppedTest, AScoutInMidDeliveryCostsTheServerNoMemoryWhileAnotherDelivers) {
  Put("stopped.db", 1, route::Standing::kStaged);
  Put("another.db", 2, route::Standing::kStaged);
  const auto server = Server();
  const auto stopped = Deliver("stopped");
  AwaitGrown("server.db", *stopped);
  stopped->Signal(SIGSTOP);
  const MemoryWatch watch(*server);
  ExpectDone(*Deliver("another"));
  ExpectBounded("the server, a scout stopped", watch);
  ExpectDone(*stopped);
}

TEST_F(StoppedTest, AServerCostsNeitherItsFollowerNorItsScoutMemory) {
  Put("server.db", 1, route::Standing::kActive);
  Put("scout.db", 2, route::Standing::kStaged);
  const auto server = Server();
  const double held_mb = SizeMB("server.db");
  const auto follower = Fetch("follower");
  const auto scout = Deliver("scout");
  AwaitGrown("server.db", *scout, held_mb);
  AwaitGrown("follower.db", *follower);
  server->Signal(SIGSTOP);
  const MemoryWatch followers(*follower);
  const MemoryWatch scouts(*scout);
  // Longer than whoever is silent counts as there.
  EXPECT_TRUE(scout->WaitForOutput("server 'server' is gone")) << scout->output();
  ExpectBounded("a follower, the server stopped", followers);
  ExpectBounded("a scout, the server stopped", scouts);
  server->Signal(SIGCONT);
  ExpectDone(*follower);
  ExpectDone(*scout);
}

}  // namespace
}  // namespace trailcast::test
