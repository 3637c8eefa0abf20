#include "route_server/routes/mirror_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_store.h"
#include "tests/support/pieces.h"

namespace trailcast::server {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MirrorWatchTest : public testing::Test {
 protected:
  using Lines = std::vector<std::string>;

  MirrorWatchTest() {
    const exchange::AgentStatus there{.agent = kOther, .role = exchange::AgentRole::kServer};
    for (exchange::Mirror* mirror : {&ours_, &theirs_}) mirror->Handle(there, now_);
    Read();
  }
  // All parts of both stores.
  void Read() {
    for (int i = 0; i < 20; ++i) {
      (void)ours_.Tick(now_);
      for (exchange::Message& message : theirs_.Tick(now_)) said_ = std::move(message);
    }
  }
  // Compares with what the other has said of all that it holds.
  Lines Compare() {
    ours_.Handle(said_, now_);
    return watch_.Look(ours_, now_);
  }
  void Put(test::MemoryStore& store) {
    auto info = test::InfoOf(test::KeyNumber(1), test::PiecesOf(test::KeyNumber(1), 1),
                             route::RouteState::kComplete);
    ASSERT_TRUE(store.PutRoute(info));
    ours_.NoteStored(info.key);
    theirs_.NoteStored(info.key);
  }

  const AgentId kOther{"site-b"};
  test::MemoryStore our_store_;
  test::MemoryStore their_store_;
  exchange::Mirror ours_{AgentId("site-a"), our_store_};
  exchange::Mirror theirs_{kOther, their_store_};
  MirrorWatch watch_;
  MirrorWatch::Time now_{1h};
  exchange::Message said_;
};

TEST_F(MirrorWatchTest, TellsOnceThatTheSameIsHeld) {
  EXPECT_THAT(watch_.Look(ours_, now_), IsEmpty()) << "nothing is known of it yet";
  EXPECT_THAT(Compare(), ElementsAre("'site-b' holds the same routes"));
  EXPECT_THAT(Compare(), IsEmpty());
}

TEST_F(MirrorWatchTest, TellsOfADifferenceThatLasts) {
  (void)Compare();
  Put(our_store_);
  EXPECT_THAT(Compare(), IsEmpty()) << "it may be on its way";
  now_ += MirrorWatch::kMoment;
  EXPECT_THAT(Compare(),
              ElementsAre(AllOf(HasSubstr("holds other routes"), HasSubstr("1 of 256"))));
  EXPECT_EQ(MirrorWatch::Behind(ours_, now_), "");
  now_ += MirrorWatch::kLong;
  EXPECT_EQ(MirrorWatch::Behind(ours_, now_), "'site-b' has held other routes for 75 s");
  Put(their_store_);
  Read();
  EXPECT_THAT(Compare(), ElementsAre(HasSubstr("holds the same routes")));
  EXPECT_EQ(MirrorWatch::Behind(ours_, now_), "");
}

TEST_F(MirrorWatchTest, WhoWentWithoutAWordIsOutOfReachUntilItIsComparedAgain) {
  (void)Compare();
  ours_.Handle(exchange::AgentGone{.agent = kOther}, now_);
  EXPECT_THAT(watch_.Look(ours_, now_), ElementsAre(HasSubstr("out of reach")));
  now_ += MirrorWatch::kLong;
  EXPECT_EQ(MirrorWatch::Behind(ours_, now_), "'site-b' has been out of reach for 60 s");
  ours_.Handle(exchange::AgentStatus{.agent = kOther, .role = exchange::AgentRole::kServer}, now_);
  EXPECT_THAT(watch_.Look(ours_, now_), IsEmpty());
  EXPECT_THAT(Compare(), ElementsAre(HasSubstr("holds the same routes")));
}

TEST_F(MirrorWatchTest, WhoSaidGoodByeIsNotWaitedFor) {
  (void)Compare();
  exchange::AgentStatus bye{.agent = kOther, .role = exchange::AgentRole::kServer};
  bye.mode = exchange::AgentMode::kStopped;
  ours_.Handle(bye, now_);
  now_ += MirrorWatch::kLong;
  EXPECT_THAT(watch_.Look(ours_, now_), IsEmpty());
  EXPECT_EQ(MirrorWatch::Behind(ours_, now_), "");
}

}  // namespace
}  // namespace trailcast::server
