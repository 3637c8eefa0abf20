#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/swarm.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Faults kBadRadio{.drop = 0.2, .duplicate = 0.2, .delay = 0.2, .corrupt = 0.1};

// From the scout's camera to the last follower's disk, over a bad network.
class ProtocolContract : public testing::TestWithParam<test::NetworkKind> {
 protected:
  test::Swarm MakeSwarm(Faults faults = kBadRadio) { return test::Swarm(GetParam(), faults); }

  static void TeachSome(test::Swarm& swarm, int count) {
    for (int i = 0; i < count; ++i) {
      swarm.Teach();
      swarm.StepFor(milliseconds(200));
    }
  }
};

TEST_P(ProtocolContract, FollowersBeforeDuringAndAfterTeachingGetEveryByte) {
  test::Swarm swarm = MakeSwarm();
  swarm.StartServer();
  swarm.StartScout();
  const auto& before = swarm.AddFollower();
  TeachSome(swarm, 20);
  const auto& during = swarm.AddFollower();
  TeachSome(swarm, 20);
  // Until both have met with a damaged one: which are is drawn in the order in which they come.
  const auto met_damage = [&] {
    return before.fetcher->Progress(swarm.now()).bad_pieces > 0 &&
           swarm.keeper().counters().corrupt > 0;
  };
  for (int more = 0; more < 200 && !met_damage(); ++more) TeachSome(swarm, 1);
  EXPECT_TRUE(met_damage());
  swarm.TeachLast();
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  swarm.StopScout();
  const auto& after = swarm.AddFollower();
  ASSERT_TRUE(swarm.StepUntil([&] { return after.fetcher->Complete(); }));

  EXPECT_TRUE(swarm.HoldsExactly(swarm.ServerPieces()));
  for (const auto* follower : {&before, &during, &after}) {
    EXPECT_TRUE(swarm.HoldsExactly(follower->arrived));
  }
}

TEST_P(ProtocolContract, ServerRestartsInTheMiddle) {
  test::Swarm swarm = MakeSwarm();
  swarm.StartServer();
  swarm.StartScout();
  const auto& follower = swarm.AddFollower();
  TeachSome(swarm, 15);
  swarm.StopServer();
  TeachSome(swarm, 15);
  swarm.StartServer();
  TeachSome(swarm, 5);
  swarm.TeachLast();
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  EXPECT_TRUE(swarm.HoldsExactly(swarm.ServerPieces()));
  EXPECT_TRUE(swarm.HoldsExactly(follower.arrived));
}

TEST_P(ProtocolContract, FollowerIsServedByTheServerAloneAfterItsRestart) {
  test::Swarm swarm = MakeSwarm();
  swarm.StartServer();
  swarm.StartScout();
  TeachSome(swarm, 10);
  swarm.TeachLast();
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  swarm.StopScout();
  swarm.StopServer();
  swarm.StartServer();
  const auto& follower = swarm.AddFollower();
  ASSERT_TRUE(swarm.StepUntil([&] { return follower.fetcher->Complete(); }));
  EXPECT_TRUE(swarm.HoldsExactly(follower.arrived));
}

TEST_P(ProtocolContract, BacklogGoesUpWhenTheScoutIsBackInRange) {
  test::Swarm swarm = MakeSwarm();
  swarm.StartServer();
  swarm.StartScout();
  TeachSome(swarm, 5);
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.sender().Unreceipted().empty(); }));
  swarm.scout().set_cut_off(true);
  TeachSome(swarm, 10);
  swarm.TeachLast();
  swarm.StepFor(seconds(5));
  EXPECT_EQ(swarm.sender().Unreceipted().size(), 11U);
  swarm.scout().set_cut_off(false);
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  EXPECT_TRUE(swarm.HoldsExactly(swarm.ServerPieces()));
}

TEST_P(ProtocolContract, ScoutRestartsWithABacklog) {
  test::Swarm swarm = MakeSwarm();
  swarm.StartScout();
  TeachSome(swarm, 10);
  swarm.TeachLast();
  swarm.StopScout();
  swarm.StartServer();
  swarm.StartScout();
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  EXPECT_TRUE(swarm.HoldsExactly(swarm.ServerPieces()));
}

TEST_P(ProtocolContract, NothingIsReceiptedWhileTheServersDiskIsFull) {
  test::Swarm swarm = MakeSwarm();
  swarm.StartServer();
  swarm.StartScout();
  swarm.server_store().full = true;
  TeachSome(swarm, 5);
  swarm.TeachLast();
  swarm.StepFor(seconds(5));
  EXPECT_EQ(swarm.sender().Unreceipted().size(), 6U);
  EXPECT_THAT(swarm.keeper().TakeNotes(),
              testing::Contains(testing::Field(&Note::severity, Note::Severity::kError)));
  swarm.server_store().full = false;
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  EXPECT_TRUE(swarm.HoldsExactly(swarm.ServerPieces()));
}

TEST_P(ProtocolContract, RefusedPublishesAreMadeUpFor) {
  test::Swarm swarm = MakeSwarm({});
  swarm.StartServer();
  swarm.StartScout();
  const auto& follower = swarm.AddFollower();
  swarm.scout().set_refusing(true);
  TeachSome(swarm, 10);
  swarm.scout().set_refusing(false);
  swarm.TeachLast();
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  EXPECT_TRUE(swarm.HoldsExactly(follower.arrived));
}

TEST_P(ProtocolContract, AFetchGoesOnWithAServerThatIsAnotherProcessNow) {
  test::Swarm swarm = MakeSwarm({});
  swarm.StartServer();
  swarm.StartScout();
  for (int i = 0; i < 50; ++i) swarm.Teach();
  swarm.TeachLast();
  ASSERT_TRUE(swarm.StepUntil([&] { return swarm.EverythingArrived(); }));
  swarm.StopScout();
  const auto& follower = swarm.AddFollower();
  ASSERT_TRUE(swarm.StepUntil([&] { return !follower.arrived.empty(); }));
  ASSERT_FALSE(follower.fetcher->Complete());
  swarm.StopServer();
  swarm.StepFor(seconds(2));
  swarm.StartServer();
  ASSERT_TRUE(swarm.StepUntil([&] { return follower.fetcher->Complete(); }));
  EXPECT_TRUE(swarm.HoldsExactly(follower.arrived));
}

TEST_P(ProtocolContract, AFollowerLendsWhatNobodyElseHas) {
  test::Swarm swarm = MakeSwarm({});
  for (int i = 0; i < 10; ++i) swarm.Teach();
  swarm.TeachLast();
  swarm.AddLender();
  const auto& follower = swarm.AddFollower();
  follower.fetcher->Learn(swarm.Info(), swarm.now());
  ASSERT_TRUE(swarm.StepUntil([&] { return follower.fetcher->Complete(); }));
  EXPECT_TRUE(swarm.HoldsExactly(follower.arrived));
}

INSTANTIATE_TEST_SUITE_P(On, ProtocolContract,
                         testing::Values(test::NetworkKind::kInProcess, test::NetworkKind::kDds),
                         [](const auto& param) { return test::NameOf(param.param); });

}  // namespace
}  // namespace trailcast::exchange
