// A robot whose software is of another vendor shares routes with ours: Fast DDS, its types made by
// its own generator of idl/trailcast.idl.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "services/store/route_store.h"
#include "tests/interop/fast_dds_programs.h"
#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

// Nobody else listens to the discovery port of this domain. Fast DDS knows no tags, so that this
// alone keeps tests apart. Ports of domains above 100 may be anybody's.
bool IsFree(int domain) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain));
  const bool bound = bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(probe);
  return bound;
}

int FreeDomain() {
  constexpr int kDomains = 100;
  for (int i = 0; i < kDomains; ++i) {
    const int domain = 1 + (getpid() + i) % kDomains;
    if (IsFree(domain)) return domain;
  }
  throw std::runtime_error("every DDS domain from 1 to 100 is in use");
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class FastDds : public ProgramsTest {
 protected:
  void SetUp() override {
    if (std::string(kFastDdsPeer).empty()) GTEST_SKIP() << kNoFastDds;
    tag_ = "";
    common_ = {"--domain", std::to_string(FreeDomain())};
    server_ = Start("trailcast-server", With(common_, {"--store", Path("server.db")}), "server");
    ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
    const auto scout =
        Run("trailcast-agent",
            With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
    ASSERT_EQ(scout.status, 0) << scout.output;
  }

  Ended Run(const std::string& program, const Words& words) {
    return End(*Start(program, With(common_, words), program));
  }
  Ended RunPeer(const Words& words) {
    Process peer(With({kFastDdsPeer, common_.back()}, words), Path("peer.log"));
    return End(peer);
  }
  // Returns what the project's own tool lists, in the peer's words.
  std::vector<std::string> OurList() {
    const auto listed = Run("trailcast", {"routes", "--json"});
    EXPECT_EQ(listed.status, 0) << listed.output;
    std::vector<std::string> lines;
    for (const auto& route : nlohmann::json::parse(listed.output, nullptr, false)) {
      const auto word = [&](const char* name) { return route.at(name).get<std::string>(); };
      const auto number = [&](const char* name) { return route.at(name).get<std::uint64_t>(); };
      lines.push_back(fmt::format("{} {} {} {} {} {:.3f} {} {} {} {}", word("name"), word("route"),
                                  number("revision"), word("state"), number("segments"),
                                  route.at("length_m").get<double>(), number("bytes"),
                                  word("scout"), word("manifest_sha256"), word("camera")));
    }
    return lines;
  }
  std::vector<route::SegmentPiece> Held(const std::string& file, const std::string& name) {
    std::vector<route::SegmentPiece> pieces;
    const auto store = store::OpenSqliteStore(Path(file));
    EXPECT_TRUE(store) << store.error().message;
    if (!store) return pieces;
    const auto routes = (*store)->FindRoutesByName(name).value();
    for (const route::RouteInfo& info : routes) {
      const auto held = (*store)->HeldSegments(info.key).value();
      for (const SegmentIndex index : held) {
        pieces.push_back((*store)->ReadSegment(info.key, index).value());
      }
    }
    return pieces;
  }

  Words common_;
  std::unique_ptr<Process> server_;
};

TEST_F(FastDds, ListsTheCatalogAsOurOperatorDoes) {
  const auto listed = RunPeer({"list"});
  ASSERT_EQ(listed.status, 0) << listed.output;
  EXPECT_EQ(Lines(listed.output), OurList());
  EXPECT_THAT(Lines(listed.output), SizeIs(1));
}

TEST_F(FastDds, FetchesEverySegmentAndFindsItWhole) {
  const auto fetched = RunPeer({"fetch", "hall"});
  ASSERT_EQ(fetched.status, 0) << fetched.output;
  std::vector<std::string> taught;
  for (const route::SegmentPiece& piece : Held("scout.db", "hall")) {
    std::string digest;
    for (const std::uint8_t byte : piece.digest) digest += fmt::format("{:02x}", byte);
    taught.push_back(fmt::format("{} {} {}", piece.index.value(), piece.bytes.size(), digest));
  }
  EXPECT_FALSE(taught.empty());
  EXPECT_EQ(Lines(fetched.output), taught);
}

TEST_F(FastDds, PublishesARouteThatIsStoredAndListedAndFollowed) {
  const auto copied = RunPeer({"copy", "hall", "hall-copied"});
  ASSERT_EQ(copied.status, 0) << copied.output << server_->output();
  EXPECT_TRUE(server_->WaitForOutput("scout 'fast-dds' is there")) << server_->output();
  const auto listed = RunPeer({"list"});
  EXPECT_EQ(Lines(listed.output), OurList());
  EXPECT_THAT(OurList(), SizeIs(2));
  EXPECT_THAT(listed.output, HasSubstr("hall-copied"));

  const auto follower =
      Run("trailcast-agent", {"replay", "--frames", Walk("seen", kFollowerFrames), "--route",
                              "hall-copied", "--store", Path("follower.db"), "--server"});
  EXPECT_EQ(follower.status, 0) << follower.output;
  EXPECT_THAT(follower.output, HasSubstr("state=ARRIVED"));
  const auto taught = Held("scout.db", "hall");
  const auto followed = Held("follower.db", "hall-copied");
  ASSERT_EQ(followed.size(), taught.size());
  for (std::size_t i = 0; i < taught.size(); ++i) EXPECT_EQ(followed[i].bytes, taught[i].bytes);
}

TEST_F(FastDds, IsToldThatThereIsNoSuchRoute) {
  const auto fetched = RunPeer({"fetch", "hell"});
  EXPECT_EQ(fetched.status, 1);
  EXPECT_THAT(fetched.output, HasSubstr("no complete route 'hell'"));
}

}  // namespace
}  // namespace trailcast::test
