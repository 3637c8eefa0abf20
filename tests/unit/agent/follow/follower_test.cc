#include "agent/follow/follower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <future>
#include <memory>
#include <set>
#include <stdexcept>

#include "agent/fetch/fetch.h"
#include "services/base/angles.h"
#include "services/route/labels.h"
#include "tests/support/await.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using test::WalkDevice;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int kFrames = 150;
// The follower walks a little further than the scout: the last milestone lies at the taught end.
constexpr int kFollowerFrames = 220;

class FollowerTest : public testing::Test {
 protected:
  void TeachInto(const std::string& agent) {
    WalkDevice scout(kFrames);
    const auto summary = swarm_.Teach(scout, swarm_.ScoutNamed(agent), false);
    ASSERT_TRUE(summary) << summary.error().message;
  }
  // The route, and its segments, in a store.
  std::optional<route::RouteInfo> RouteIn(store::RouteStore& store) {
    const auto routes = store.FindRoutesByName("hall").value();
    return routes.empty() ? std::nullopt : std::optional(routes[0]);
  }
  std::vector<route::SegmentPiece> PiecesIn(const std::string& agent) {
    const auto store = swarm_.OpenStore(agent);
    const auto info = RouteIn(*store);
    std::vector<route::SegmentPiece> pieces;
    const std::vector<SegmentIndex> held = store->HeldSegments(info->key).value();
    for (const SegmentIndex index : held) {
      pieces.push_back(store->ReadSegment(info->key, index).value());
    }
    info_ = info;
    return pieces;
  }
  // Each whole, and at another's place.
  void StoreWrongly(const std::string& agent, std::vector<route::SegmentPiece> pieces) {
    ASSERT_GT(pieces.size(), 1U);
    std::swap(pieces[0].index, pieces[1].index);
    const auto store = swarm_.OpenStore(agent);
    ASSERT_TRUE(store->AppendSegments(pieces));
    ASSERT_TRUE(store->PutRoute(*info_));
  }
  Result<Summary> FetchInto(const std::string& agent) {
    return Fetch(swarm_.FollowerNamed(agent).link, swarm_.OpenStore(agent),
                 swarm_.Join(exchange::FollowerTopics()));
  }

  test::Swarm swarm_;
  WalkDevice device_{kFollowerFrames};
  std::optional<route::RouteInfo> info_;  // that PiecesIn found
};

TEST_F(FollowerTest, ArrivesAtTheEndOfARouteFromItsOwnStore) {
  TeachInto("robot");
  const auto outcome = swarm_.Replay(device_, swarm_.FollowerNamed("robot"), false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->reason;
  EXPECT_EQ(outcome->end, RunEnd::kArrived);
  EXPECT_EQ(*outcome->summary.Find("arrived"), "1");
  EXPECT_EQ(*outcome->summary.Find("frames"), std::to_string(outcome->log.frames()));
  ASSERT_GT(device_.told.size(), 100U);
  EXPECT_GT(device_.told[50].linear_mps, 0.0);
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

// Throws once it is told to.
class ThrowingExchange : public exchange::RouteExchange {
 public:
  struct State {
    std::atomic<bool> throws{false};
    std::promise<void> thrown;
  };
  ThrowingExchange(std::unique_ptr<RouteExchange> inner, State& state)
      : inner_(std::move(inner)), state_(state) {}

  Result<void> Publish(const exchange::Message& message) override {
    return inner_->Publish(message);
  }
  std::vector<exchange::Message> Take(milliseconds max_wait) override {
    if (state_.throws.exchange(false)) {
      state_.thrown.set_value();
      throw std::runtime_error("no such index");
    }
    return inner_->Take(max_wait);
  }
  Result<void> Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) override {
    return inner_->Listen(topic, routes);
  }
  std::uint64_t dropped() const override { return inner_->dropped(); }

 private:
  std::unique_ptr<RouteExchange> inner_;
  State& state_;
};

TEST_F(FollowerTest, IsToldToStandAndSaysWhyWhenItsLinkThreadThrows) {
  TeachInto("robot");
  ThrowingExchange::State link;
  device_.before_frame = [&](int frame) -> Result<void> {
    if (frame != kFrames / 3) return {};
    link.throws = true;
    const auto thrown = link.thrown.get_future().wait_for(test::kLongEnough);
    EXPECT_EQ(thrown, std::future_status::ready);
    return {};
  };
  const auto options = swarm_.FollowerNamed("robot");
  const auto outcome =
      Replay(device_, options, swarm_.OpenStore("robot"),
             std::make_unique<ThrowingExchange>(swarm_.Join(exchange::ReplayTopics()), link));
  ASSERT_TRUE(outcome) << outcome.error().message;
  ASSERT_TRUE(outcome->error) << outcome->state << ": " << outcome->reason;
  EXPECT_THAT(outcome->error->message, AllOf(HasSubstr("thread that fetches and stores the route"),
                                             HasSubstr("no such index")));
  EXPECT_GT(device_.told[20].linear_mps, 0.0);
  EXPECT_LT(device_.next, kFollowerFrames) << "it drove on as if nothing had happened";
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

// These are about a hill that goes up by 0.1 rad.
class SlopeTest : public FollowerTest {
 protected:
  void TeachUphill(const std::string& agent, bool send) {
    WalkDevice scout(kFrames);
    scout.imu = {{.attitude = motion::Attitude{0.0, -std::sin(0.05), 0.0, std::cos(0.05)}}};
    const auto summary = swarm_.Teach(scout, swarm_.ScoutNamed(agent), send);
    ASSERT_TRUE(summary) << summary.error().message;
  }
  FollowerOptions Limited(double slope_deg) {
    auto options = swarm_.FollowerNamed("robot");
    options.how.terrain.slope_rad = Radians(slope_deg);
    return options;
  }
};

TEST_F(SlopeTest, ARouteThatIsTooSteepIsRefusedBeforeTheRobotMoves) {
  TeachUphill("robot", false);
  const auto outcome = swarm_.Replay(device_, Limited(5.0), false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_FALSE(outcome->success);
  EXPECT_EQ(outcome->end, RunEnd::kRefused);
  EXPECT_THAT(outcome->reason, HasSubstr("in segment 0, 0.0 to "));
  EXPECT_THAT(outcome->reason, HasSubstr("it goes 5.7 degrees uphill, and this robot's limit is "
                                         "5.0 degrees"));
  for (const auto& command : device_.told) EXPECT_EQ(command, motion::VelocityCommand{});
  EXPECT_EQ(outcome->log.frames(), 0);
}

TEST_F(SlopeTest, OneThatIsNotTooSteepIsFetchedWholeAndFollowed) {
  swarm_.StartServer();
  TeachUphill("scout", true);
  const auto outcome = swarm_.Replay(device_, Limited(6.0), true);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->reason;
}

TEST_F(FollowerTest, WritesOneRowAFrame) {
  TeachInto("robot");
  auto options = swarm_.FollowerNamed("robot");
  options.open_loop = true;
  const auto outcome = swarm_.Replay(device_, options, false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  const test::TempDir folder;
  ASSERT_TRUE(outcome->log.WriteCsv(folder / "out.csv"));
  std::ifstream csv(folder / "out.csv");
  std::string line;
  std::getline(csv, line);
  EXPECT_THAT(line, StartsWith("frame,segment,progress,features,turn_rad,state"));
  int rows = 0;
  for (; std::getline(csv, line); ++rows) EXPECT_THAT(line, StartsWith(std::to_string(rows) + ","));
  EXPECT_EQ(rows, kFollowerFrames) << "a recording is looked at to its end";
}

TEST_F(FollowerTest, HoldsANewRevisionInAdvanceAndStillFollowsTheActiveOne) {
  swarm_.StartServer();
  for (int revision = 1; revision <= 2; ++revision) {
    WalkDevice scout(kFrames);
    ASSERT_TRUE(swarm_.Teach(scout, swarm_.ScoutNamed("scout"), true));
  }
  FollowerLinkOptions link = swarm_.FollowerNamed("robot").link;
  link.revision.newest = true;
  const auto fetched =
      Fetch(link, swarm_.OpenStore("robot"), swarm_.Join(exchange::FollowerTopics()));
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_EQ(*fetched->Find("revision"), "2");
  const auto held = swarm_.OpenStore("robot")->FindRoutesByName("hall").value();
  ASSERT_EQ(held.size(), 1U);
  EXPECT_EQ(held[0].state, route::RouteState::kComplete);
  const auto outcome = swarm_.Replay(device_, swarm_.FollowerNamed("robot"), true);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->reason;
  const auto both = swarm_.OpenStore("robot")->FindRoutesByName("hall").value();
  EXPECT_EQ(exchange::ChooseRoute(both)->revision, RevisionNumber(1))
      << "also out of the server's reach";
}

TEST_F(FollowerTest, SaysWhatIsMissingOfARevisionThatTheServerDoesNotHave) {
  swarm_.StartServer();
  WalkDevice scout(kFrames);
  ASSERT_TRUE(swarm_.Teach(scout, swarm_.ScoutNamed("scout"), true));
  FollowerLinkOptions link = swarm_.FollowerNamed("robot").link;
  link.wait_for_route = false;
  link.revision.number = 7;
  const auto fetched =
      Fetch(link, swarm_.OpenStore("robot"), swarm_.Join(exchange::FollowerTopics()));
  ASSERT_FALSE(fetched);
  EXPECT_THAT(fetched.error().message, HasSubstr("no revision 7 of route 'hall'"));
}

TEST_F(FollowerTest, FollowsWhileTheScoutStillTeaches) {
  swarm_.StartServer();
  auto following = std::async(std::launch::async, [&] {
    return swarm_.Replay(device_, swarm_.FollowerNamed("robot"), true);
  });
  WalkDevice scout(kFrames);
  const auto taught = swarm_.Teach(scout, swarm_.ScoutNamed("scout"), true);
  EXPECT_TRUE(taught) << taught.error().message;
  const auto outcome = following.get();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->state << ": " << outcome->reason;
  const auto theirs = swarm_.OpenStore("scout")->FindRoutesByName("hall");
  const auto ours = swarm_.OpenStore("robot")->FindRoutesByName("hall");
  EXPECT_TRUE(route::SameTeaching(ours->at(0), theirs->at(0)));
}

TEST_F(FollowerTest, GoesOnFromItsOwnStoreWhenTheServerIsGone) {
  TeachInto("server");
  swarm_.StartServer();
  WalkDevice first(kFollowerFrames);
  ASSERT_TRUE(swarm_.Replay(first, swarm_.FollowerNamed("robot"), true)->success);
  swarm_.StopServer();
  const auto outcome = swarm_.Replay(device_, swarm_.FollowerNamed("robot"), true);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->reason;
}

TEST_F(FollowerTest, FollowsFromItsOwnStoreByTheBeginningOfTheRoutesId) {
  TeachInto("robot");
  const std::string id =
      swarm_.OpenStore("robot")->FindRoutesByName("hall")->front().key.route.value();
  FollowerOptions options = swarm_.FollowerNamed("robot");
  options.link.route = id.substr(0, route::kLeastIdDigits);
  const auto outcome = swarm_.Replay(device_, options, false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->reason;
}

TEST_F(FollowerTest, WrongSegmentsInItsOwnStoreAreFetchedAnew) {
  TeachInto("server");
  const auto pieces = PiecesIn("server");
  StoreWrongly("robot", pieces);
  swarm_.StartServer();
  const auto fetched = FetchInto("robot");
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_EQ(PiecesIn("robot"), pieces);
}

TEST_F(FollowerTest, WhoSendsWrongSegmentsIsNamed) {
  TeachInto("scout");
  StoreWrongly("server", PiecesIn("scout"));
  StoreWrongly("robot", PiecesIn("scout"));
  swarm_.StartServer();
  const auto fetched = FetchInto("robot");
  ASSERT_FALSE(fetched);
  EXPECT_EQ(fetched.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(fetched.error().message, HasSubstr("'server' sent them"));
  EXPECT_TRUE(PiecesIn("robot").empty());
}

TEST_F(FollowerTest, NamesTheRoutesThereAreWhenItsOwnIsNotAmongThem) {
  TeachInto("server");
  swarm_.StartServer();
  auto options = swarm_.FollowerNamed("robot");
  options.link.route = "hell";
  options.link.wait_for_route = false;
  const auto outcome = swarm_.Replay(device_, options, true);
  ASSERT_TRUE(outcome && outcome->error);
  EXPECT_THAT(outcome->reason, AllOf(HasSubstr("no route 'hell'"), HasSubstr("hall")));
  EXPECT_EQ(device_.next, 0);
}

TEST_F(FollowerTest, SaysThatTheTeachingWasCutOffWhenNobodyFinishesIt) {
  swarm_.StartServer();
  WalkDevice scout(kFrames);
  scout.before_frame = [](int frame) -> Result<void> {
    if (frame < 110) return {};
    return Fail(ErrorCode::kUnavailable, "the camera is unplugged");
  };
  ASSERT_FALSE(swarm_.Teach(scout, swarm_.ScoutNamed("scout"), true));
  auto options = swarm_.FollowerNamed("robot");
  options.link.wait = milliseconds(2000);
  const auto outcome = swarm_.Replay(device_, options, true);
  ASSERT_TRUE(outcome && outcome->error);
  EXPECT_EQ(outcome->error->code, ErrorCode::kNotFound);
  EXPECT_THAT(outcome->reason,
              AllOf(StartsWith("waited 2 s in vain: server 'server' has no active revision of "
                               "route 'hall'; it has "),
                    HasSubstr(" (cut off): its teaching was cut off, and robots follow no revision "
                              "of it; teach it again, or finish it")));
  EXPECT_EQ(device_.next, 0);
}

TEST_F(FollowerTest, SaysWhyAServerCouldNotAnswer) {
  const auto server = swarm_.Join(exchange::ServerTopics());
  auto options = swarm_.FollowerNamed("robot");
  options.link.wait = milliseconds(2000);
  auto following =
      std::async(std::launch::async, [&] { return swarm_.Replay(device_, options, true); });
  while (following.wait_for(milliseconds(0)) != std::future_status::ready) {
    for (const exchange::Message& message : server->Take(milliseconds(5))) {
      const auto* asked = std::get_if<exchange::CatalogRequest>(&message);
      if (asked == nullptr) continue;
      exchange::CatalogReply reply{AgentId("server"), asked->client, asked->request, {}, {}, {}};
      reply.error = "the store is damaged";
      EXPECT_TRUE(server->Publish(reply));
    }
  }
  const auto outcome = following.get();
  ASSERT_TRUE(outcome && outcome->error);
  EXPECT_EQ(outcome->error->code, ErrorCode::kUnavailable);
  EXPECT_THAT(outcome->reason, HasSubstr("route 'hall' is meant: the store is damaged"));
}

TEST_F(FollowerTest, SaysSoWhenNoServerAnswers) {
  auto options = swarm_.FollowerNamed("robot");
  options.link.wait = milliseconds(100);
  const auto outcome = swarm_.Replay(device_, options, true);
  ASSERT_TRUE(outcome && outcome->error);
  EXPECT_THAT(outcome->reason, HasSubstr("no server answered"));
}

TEST_F(FollowerTest, StandsAndGivesUpWhenTheRestOfTheRouteDoesNotCome) {
  auto scout_options = swarm_.ScoutNamed("scout");
  scout_options.link.delivery_timeout = milliseconds(0);
  swarm_.StartServer();
  const auto watcher = swarm_.Join(exchange::ScoutTopics());
  // A scout that stands still in the middle of its route.
  std::promise<void> followed;
  WalkDevice scout(kFrames);
  scout.before_frame = [&](int frame) -> Result<void> {
    if (frame == 120) followed.get_future().wait();
    return {};
  };
  auto teaching =
      std::async(std::launch::async, [&] { return swarm_.Teach(scout, scout_options, true); });
  // The server has some of it before it is asked: the follower waits for nothing but the rest.
  bool stored = false;
  const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
  while (!stored && std::chrono::steady_clock::now() < deadline) {
    for (const exchange::Message& message : watcher->Take(milliseconds(50))) {
      const auto* receipt = std::get_if<exchange::Receipt>(&message);
      stored |= receipt != nullptr && receipt->durable_prefix > 0;
    }
  }
  EXPECT_TRUE(stored);
  auto options = swarm_.FollowerNamed("robot");
  options.link.wait = milliseconds(4000);
  const auto outcome = swarm_.Replay(device_, options, true);
  followed.set_value();
  (void)teaching.get();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_FALSE(outcome->success);
  EXPECT_EQ(outcome->end, RunEnd::kWaiting) << outcome->reason;
  EXPECT_THAT(outcome->reason, HasSubstr("no further segment"));
  EXPECT_GT(outcome->log.frames(), 0);
  ASSERT_FALSE(device_.told.empty());
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

TEST_F(FollowerTest, StopsTheRobotWhenTheCameraFails) {
  TeachInto("robot");
  device_.before_frame = [](int frame) -> Result<void> {
    if (frame < 50) return {};
    return Fail(ErrorCode::kUnavailable, "the camera is unplugged");
  };
  const auto outcome = swarm_.Replay(device_, swarm_.FollowerNamed("robot"), false);
  ASSERT_TRUE(outcome && outcome->error);
  EXPECT_EQ(outcome->reason, "the camera is unplugged");
  EXPECT_GT(device_.told[40].linear_mps, 0.0);
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

TEST_F(FollowerTest, StopsTheRobotOnASignal) {
  TeachInto("robot");
  auto options = swarm_.FollowerNamed("robot");
  std::atomic<bool> stop{false};
  options.link.stop = [&] { return stop.load(); };
  device_.before_frame = [&](int frame) {
    stop = frame >= 50;
    return Result<void>{};
  };
  const auto outcome = swarm_.Replay(device_, options, false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->end, RunEnd::kStopped);
  EXPECT_FALSE(outcome->success);
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

TEST_F(FollowerTest, ArrivesWhereItsSectionEndsAndIsLostWhereItIsFoundFarBeyond) {
  TeachInto("robot");
  auto options = swarm_.FollowerNamed("robot");
  options.end_m = [] { return 1.0; };
  const auto there = swarm_.Replay(device_, options, false);
  ASSERT_TRUE(there) << there.error().message;
  EXPECT_EQ(there->state, "ARRIVED");
  EXPECT_THAT(there->reason, HasSubstr("1.0 m along the route"));

  // It has got beyond before it is asked where the end is, as if carried there.
  WalkDevice carried(kFollowerFrames);
  int frames = 0;
  options.end_m = [&frames] { return ++frames < 100 ? 100.0 : 0.5; };
  const auto beyond = swarm_.Replay(carried, options, false);
  ASSERT_TRUE(beyond) << beyond.error().message;
  EXPECT_EQ(beyond->state, "LOST");
  EXPECT_FALSE(beyond->success);
  EXPECT_THAT(beyond->reason, HasSubstr("was to end 0.5 m along the route"));
  EXPECT_EQ(carried.told.back(), motion::VelocityCommand{});
}

// This is a device whose pictures show nothing above so many of their rows.
class FoggyDevice : public WalkDevice {
 public:
  FoggyDevice(int frames, std::function<std::size_t(int)> rows)
      : WalkDevice(frames), rows_(std::move(rows)) {}
  Result<std::optional<Observation>> Next() override {
    auto observation = WalkDevice::Next();
    if (observation && *observation) {
      image::GrayImage& image = (*observation)->image;
      std::fill_n(image.pixels.begin(), rows_(next) * static_cast<std::size_t>(image.width), 128);
    }
    return observation;
  }

 private:
  std::function<std::size_t(int)> rows_;
};

TEST_F(FollowerTest, StopsWhereItsSectionEndsThoughItSeesNothingOfIt) {
  constexpr std::size_t kFew = 104;  // too few features to take the lens for covered without them
  constexpr std::size_t kNone = 120;
  FoggyDevice scout(kFrames, [](int) { return kFew; });
  ASSERT_TRUE(swarm_.Teach(scout, swarm_.ScoutNamed("robot"), false));
  FoggyDevice device(kFollowerFrames, [](int frame) { return frame < 70 ? kFew : kNone; });
  auto options = swarm_.FollowerNamed("robot");
  options.end_m = [] { return 1.6; };
  const auto there = swarm_.Replay(device, options, false);
  ASSERT_TRUE(there) << there.error().message;
  EXPECT_EQ(there->state, "ARRIVED") << there->reason;
  EXPECT_THAT(there->reason, HasSubstr("1.6 m along the route, where it was to end"));
  EXPECT_EQ(device.told.back(), motion::VelocityCommand{});
}

TEST_F(FollowerTest, LooksForItsNextRouteByTheCameraThatItKnows) {
  TeachInto("robot");
  auto options = swarm_.FollowerNamed("robot");
  device_.before_frame = [&](int frame) {
    device_.blind = frame < 10;  // it has not found its path yet
    return Result<void>{};
  };
  std::vector<std::optional<OwnLens>> told;
  options.next = [&told](const std::optional<OwnLens>& lens) {
    told.push_back(lens);
    return std::nullopt;
  };
  ASSERT_TRUE(swarm_.Replay(device_, options, false)->success);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(told.front());
}

TEST_F(FollowerTest, TellsServersHowItFollowedAndWhereItWasLost) {
  swarm_.StartServer();
  WalkDevice scout(kFrames);
  ASSERT_TRUE(swarm_.Teach(scout, swarm_.ScoutNamed("scout"), true));
  const auto server = swarm_.Join({.write = {}, .read = {exchange::Topic::kFollowed}});
  const auto told = [&] {
    using namespace std::chrono_literals;
    std::vector<exchange::FollowedSections::Section> sections;
    for (const exchange::Message& message : server->Take(0ms)) {
      const auto* followed = std::get_if<exchange::FollowedSections>(&message);
      if (followed != nullptr && followed->agent == AgentId("robot")) {
        sections.insert(sections.end(), followed->sections.begin(), followed->sections.end());
      }
    }
    return sections;
  };
  auto options = swarm_.FollowerNamed("robot");
  ASSERT_TRUE(swarm_.Replay(device_, options, true)->success);
  using Section = exchange::FollowedSections::Section;
  EXPECT_THAT(told(), testing::ElementsAre(Section{0, 1, 0}));
  // By this method it drives on for a while, as if the lens was not covered.
  options.how.session.method = ReplayMethod::kPaper;
  WalkDevice loses(kFollowerFrames);
  loses.before_frame = [&](int frame) {
    loses.blind = frame > 60;
    return Result<void>{};
  };
  EXPECT_EQ(swarm_.Replay(loses, options, true)->state, "LOST");
  EXPECT_THAT(told(), testing::ElementsAre(Section{0, 1, 1}));
}

TEST_F(FollowerTest, GivesUpWhereItGetsNoFurther) {
  TeachInto("robot");
  class Wall : public WalkDevice {
   public:
    Wall() : WalkDevice(100'000) {}
    // Wheels and picture stand still from frame 60 on, time goes on.
    Result<std::optional<Observation>> Next() override {
      auto frame = WalkDevice::Next();
      (*frame)->stamp = FromSeconds(count_++ / 30.0);
      next = std::min(next, 60);
      return frame;
    }

   private:
    int count_ = 0;
  } device;
  auto options = swarm_.FollowerNamed("robot");
  options.stuck_after = std::chrono::seconds(5);
  const auto outcome = swarm_.Replay(device, options, false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->end, RunEnd::kStuck);
  EXPECT_THAT(outcome->reason, HasSubstr("no progress for 5 s"));
}

// Walks back the way that it came.
class WalkBackDevice : public WalkDevice {
 public:
  using WalkDevice::WalkDevice;
  Result<std::optional<Observation>> Next() override {
    const int frame = next;
    next = std::max(0, kFrames - 1 - frame);
    auto seen = WalkDevice::Next();
    next = frame + 1;
    if (seen && *seen) (*seen)->stamp = FromSeconds(frame / 30.0);
    return seen;
  }
};

TEST_F(FollowerTest, BacksFromTheEndOfARouteToItsBeginning) {
  TeachInto("robot");
  WalkBackDevice back(kFrames + 40);
  FollowerOptions options = swarm_.FollowerNamed("robot");
  options.how.backwards = true;
  options.link.begin_m = 2.6;
  back.next = 18;  // there
  const auto outcome = swarm_.Replay(back, options, false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->end, RunEnd::kArrived) << outcome->reason;
  EXPECT_EQ(*outcome->summary.Find("segment"), "0");
  EXPECT_LT(back.told[20].linear_mps, 0.0);
  for (const auto& told : back.told) EXPECT_LE(told.linear_mps, 0.0);
}

TEST_F(FollowerTest, BacksAsFarAsItIsTo) {
  TeachInto("robot");
  WalkBackDevice back(kFrames);
  FollowerOptions options = swarm_.FollowerNamed("robot");
  options.how.backwards = true;
  options.end_m = [] { return 1.2; };
  const auto outcome = swarm_.Replay(back, options, false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->end, RunEnd::kArrived);
  EXPECT_THAT(outcome->reason, HasSubstr("1.2 m along the route, where it was to end"));
  // A wall that is only ever magnified tells the place roughly.
  EXPECT_NEAR(2.98 - 0.02 * back.next, 1.2, 0.4);
}

}  // namespace
}  // namespace trailcast::agent
