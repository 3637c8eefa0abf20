// A byte flipped on a disk, and whoever has the segment mends it.
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "services/store/route_store.h"
#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

const SegmentIndex kDamaged(1);

class RepairTest : public ProgramsTest {
 protected:
  std::unique_ptr<Process> NamedServer(const std::string& name, const std::string& log) {
    auto server = Start("trailcast-server", {"--store", Path(name + ".db"), "--name", name}, log);
    EXPECT_TRUE(server->WaitForOutput("ready")) << server->output();
    return server;
  }
  void Teach() {
    const auto scout =
        RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
    ASSERT_EQ(scout.status, 0) << scout.output;
  }
  static void Stop(Process& process) {
    process.Signal(SIGINT);
    EXPECT_EQ(End(process).status, 0);
  }
  static void Open(const std::string& file, std::unique_ptr<store::RouteStore>& store,
                   route::RouteKey& key) {
    store = store::OpenSqliteStore(file).value();
    key = store->FindRoutesByName("hall").value().at(0).key;
  }
  // A byte of the segment's, on the disk.
  static void Damage(const std::string& file) {
    std::unique_ptr<store::RouteStore> store;
    route::RouteKey key;
    Open(file, store, key);
    const route::Bytes bytes = store->ReadSegment(key, kDamaged).value().bytes;
    store.reset();
    std::ifstream in(file, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(in), {}};
    // Its end, so that no page's border lies within.
    const auto at =
        std::search(content.begin(), content.end(), bytes.end() - 24, bytes.end(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    ASSERT_NE(at, content.end());
    *at = static_cast<char>(*at ^ 1);
    std::ofstream(file, std::ios::binary) << content;
  }
  static void ExpectDamaged(const std::string& file, bool damaged) {
    std::unique_ptr<store::RouteStore> store;
    route::RouteKey key;
    Open(file, store, key);
    EXPECT_EQ(store->ReadSegment(key, kDamaged).has_value(), !damaged);
    EXPECT_EQ(store->Verify().value().empty(), !damaged);
  }
};

TEST_F(RepairTest, AnotherServerMendsADamagedSegment) {
  auto barn = NamedServer("barn", "barn");
  auto shed = NamedServer("shed", "shed");
  Teach();
  ASSERT_TRUE(barn->WaitForOutput("is complete")) << barn->output();
  ASSERT_TRUE(shed->WaitForOutput("is complete")) << shed->output();
  Stop(*barn);
  Damage(Path("barn.db"));
  ExpectDamaged(Path("barn.db"), true);
  barn = NamedServer("barn", "barn-again");
  EXPECT_TRUE(barn->WaitForOutput("is damaged on the disk")) << barn->output();
  EXPECT_TRUE(barn->WaitForOutput("is whole again")) << barn->output();
  Stop(*barn);
  ExpectDamaged(Path("barn.db"), false);
}

TEST_F(RepairTest, AFollowerThatHasTheRouteMendsADamagedSegment) {
  auto barn = NamedServer("barn", "barn");
  Teach();
  ASSERT_EQ(RunAgent({"fetch", "--route", "hall", "--store", Path("follower.db")}).status, 0);
  Stop(*barn);
  Damage(Path("barn.db"));
  barn = NamedServer("barn", "barn-again");
  EXPECT_TRUE(barn->WaitForOutput("is damaged on the disk")) << barn->output();
  // Busy with something else, and about.
  const auto follower = Agent({"replay", "--frames", Walk("seen", 2), "--route", "another",
                               "--store", Path("follower.db"), "--server", "--wait-for-route"});
  EXPECT_TRUE(barn->WaitForOutput("is whole again")) << barn->output() << follower->output();
  Stop(*barn);
  ExpectDamaged(Path("barn.db"), false);
}

TEST_F(RepairTest, AFollowersDamagedSegmentIsFetchedAnew) {
  const auto barn = NamedServer("barn", "barn");
  Teach();
  const Words fetch{"fetch", "--route", "hall", "--store", Path("follower.db")};
  ASSERT_EQ(RunAgent(fetch).status, 0);
  Damage(Path("follower.db"));
  const auto again = RunAgent(fetch);
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("fetching it anew"));
  ExpectDamaged(Path("follower.db"), false);
}

}  // namespace
}  // namespace trailcast::test
