#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "tests/contract/network.h"
#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using route::RouteKey;
using test::KeyNumber;
using test::TakeUntil;
using testing::Each;
using testing::Field;
using testing::IsEmpty;

// Segments go to those who listen to their route, and to who reads all.
class ListeningContract : public testing::TestWithParam<test::NetworkKind> {
 protected:
  struct Listener {
    std::unique_ptr<RouteExchange> exchange;
    std::vector<route::SegmentPiece> got{};
  };

  std::unique_ptr<RouteExchange> Open(const TopicUse& use) { return network_->Open(use); }
  Listener Listening(const std::set<RouteKey>& routes) {
    Listener listener{Open(FollowerTopics())};
    EXPECT_TRUE(listener.exchange->Listen(Topic::kSegments, routes));
    return listener;
  }

  static void Keep(Listener& listener, const std::vector<Message>& messages) {
    for (route::SegmentPiece& piece : test::PiecesIn(messages)) {
      listener.got.push_back(std::move(piece));
    }
  }
  // The scout says a segment of the route until the listener has one.
  bool Reaches(const RouteKey& route, Listener& listener) {
    const auto has = [&] {
      return std::any_of(listener.got.begin(), listener.got.end(),
                         [&](const auto& piece) { return piece.key == route; });
    };
    for (int time = 0; time < 1000 && !has(); ++time) {
      if (!Say({test::PieceOf(route, 0)})) return false;
      Keep(listener, listener.exchange->Take(std::chrono::milliseconds(20)));
    }
    return has();
  }
  bool Say(const std::vector<route::SegmentPiece>& pieces) {
    return scout_->Publish(SegmentBatch{AgentId("scout-1"), pieces}).has_value();
  }
  // Takes all that reached it before an announcement that the scout makes now.
  bool TakeTheRest(Listener& listener) {
    const auto info = test::InfoOf(KeyNumber(99), {}, route::RouteState::kTeaching);
    if (!scout_->Publish(RouteAnnouncement{AgentId("scout-1"), info})) return false;
    bool heard = false;
    return TakeUntil(
        *listener.exchange,
        [&](const Message& message) {
          heard |= std::holds_alternative<RouteAnnouncement>(message);
          Keep(listener, {message});
        },
        [&] { return heard; });
  }

  const RouteKey hall_ = KeyNumber(1, 1);
  const RouteKey yard_ = KeyNumber(2, 2);
  const RouteKey attic_ = KeyNumber(3, 33);  // over DDS it shares a scope with the hall

 private:
  std::unique_ptr<test::Network> network_ = test::MakeNetwork(GetParam());

 protected:
  std::unique_ptr<RouteExchange> scout_ = Open(ScoutTopics());
};

TEST_P(ListeningContract, WhoDoesNotListenGetsNothing) {
  Listener idle = Listening({});
  Listener follower = Listening({hall_});
  ASSERT_TRUE(Reaches(hall_, follower));
  ASSERT_TRUE(TakeTheRest(idle));
  EXPECT_THAT(idle.got, IsEmpty());
}

TEST_P(ListeningContract, OfTwoRoutesEachGetsItsOwn) {
  Listener in_hall = Listening({hall_});
  Listener in_yard = Listening({yard_});
  Listener in_attic = Listening({attic_});
  ASSERT_TRUE(Reaches(hall_, in_hall));
  ASSERT_TRUE(Reaches(yard_, in_yard));
  ASSERT_TRUE(Reaches(attic_, in_attic));
  // One message, of which everybody gets a part.
  ASSERT_TRUE(Say({test::PieceOf(hall_, 1), test::PieceOf(yard_, 1), test::PieceOf(attic_, 1)}));
  const std::vector<std::pair<Listener*, RouteKey>> all{
      {&in_hall, hall_}, {&in_yard, yard_}, {&in_attic, attic_}};
  for (const auto& [listener, route] : all) {
    const auto second = test::PieceOf(route, 1);
    ASSERT_TRUE(TakeUntil(
        *listener->exchange, [&, to = listener](const Message& m) { Keep(*to, {m}); },
        [&, to = listener] { return to->got.back() == second; }));
    ASSERT_TRUE(TakeTheRest(*listener));
    EXPECT_THAT(listener->got, Each(Field(&route::SegmentPiece::key, route)));
  }
}

TEST_P(ListeningContract, WhoListensToTwoRoutesGetsBoth) {
  Listener follower = Listening({hall_, yard_});
  EXPECT_TRUE(Reaches(hall_, follower));
  EXPECT_TRUE(Reaches(yard_, follower));
}

TEST_P(ListeningContract, OnceHeardEverythingComesInOrder) {
  Listener follower = Listening({hall_});
  ASSERT_TRUE(Reaches(hall_, follower));
  const auto sent = test::PiecesOf(hall_, 300, 4096);
  follower.got.clear();
  ASSERT_TRUE(Say(sent));
  ASSERT_TRUE(TakeUntil(
      *follower.exchange, [&](const Message& message) { Keep(follower, {message}); },
      [&] { return !follower.got.empty() && follower.got.back() == sent.back(); }));
  const auto first = std::find(follower.got.begin(), follower.got.end(), sent.front());
  EXPECT_TRUE(std::equal(first, follower.got.end(), sent.begin(), sent.end()));
}

TEST_P(ListeningContract, WhoStopsListeningGetsNoMoreUntilItListensAgain) {
  Listener leaves = Listening({hall_});
  Listener stays = Listening({hall_});
  ASSERT_TRUE(Reaches(hall_, leaves));
  ASSERT_TRUE(leaves.exchange->Listen(Topic::kSegments, {}));
  (void)leaves.exchange->Take(std::chrono::milliseconds(0));
  leaves.got.clear();
  ASSERT_TRUE(Reaches(hall_, stays));
  ASSERT_TRUE(TakeTheRest(leaves));
  EXPECT_THAT(leaves.got, IsEmpty());
  ASSERT_TRUE(leaves.exchange->Listen(Topic::kSegments, {hall_}));
  EXPECT_TRUE(Reaches(hall_, leaves));
}

TEST_P(ListeningContract, AHolderThatIsAnotherProcessNowIsHeardAgain) {
  Listener follower = Listening({hall_});
  ASSERT_TRUE(Reaches(hall_, follower));
  scout_ = Open(ScoutTopics());
  follower.got.clear();
  EXPECT_TRUE(Reaches(hall_, follower));
}

TEST_P(ListeningContract, NeighboursAreToldToThoseOnTheRoute) {
  const auto server = Open(ServerTopics());
  const auto on_it = Open(FollowerTopics());
  const auto elsewhere = Open(FollowerTopics());
  const RouteFollowers told{.server = AgentId("s"),
                            .key = hall_,
                            .followers = std::vector<RouteFollower>(
                                kMaxFollowersTold, {AgentId(std::string(64, 'f')), 1e7, -1000.0,
                                                    false, std::chrono::milliseconds(~0U)})};
  ASSERT_TRUE(on_it->Listen(Topic::kNeighbours, {hall_}));
  ASSERT_TRUE(elsewhere->Listen(Topic::kNeighbours, {KeyNumber(77)}));
  std::vector<Message> got;
  EXPECT_TRUE(TakeUntil(
      *on_it, [&](const Message& message) { got.push_back(message); },
      [&] {
        (void)server->Publish(told);
        return !got.empty();
      }));
  EXPECT_EQ(got.front(), Message(told));
  EXPECT_THAT(elsewhere->Take(std::chrono::milliseconds(50)), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(On, ListeningContract,
                         testing::Values(test::NetworkKind::kInProcess, test::NetworkKind::kDds),
                         [](const auto& param) { return test::NameOf(param.param); });

}  // namespace
}  // namespace trailcast::exchange
