#include "agent/link/now_handler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "services/exchange/bounds.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using exchange::NowAnswer;
using exchange::NowCommand;
using exchange::NowOrder;
using exchange::NowWhom;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kNow_ms = 1'700'000'000'000;

// Robot robot1 on route hall, and an operator's process at desk.
class NowHandlerTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path File() const { return folder_ / "robot1.stop"; }
  NowAnswer Say(NowCommand command) {
    handler_.Handle(command, "hall", kNow_ms);
    const auto answers = handler_.TakeAnswers();
    if (answers.size() != 1) return {.refused = true, .detail = "no answer"};
    return std::get<NowAnswer>(answers.front());
  }
  NowAnswer Tell(NowOrder order) {
    return Say({.client = AgentId("desk-p77"), .number = ++number_, .order = order});
  }
  NowAnswer Obeyed(NowOrder order) {
    NowAnswer answer = Tell(order);
    EXPECT_FALSE(answer.refused) << answer.detail;
    return answer;
  }
  [[nodiscard]] Hold::Kind kind() const { return handler_.hold().kind; }

  test::TempDir folder_;
  std::uint64_t number_ = 0;
  NowHandler handler_{AgentId("robot1"), folder_ / "robot1.stop"};
};

TEST_F(NowHandlerTest, IsSentHomeFromWhatItDoesUnlessItIsHeldOrTeaches) {
  handler_.Works(true);
  EXPECT_THAT(Tell(NowOrder::kHome).detail, HasSubstr("hears no server"));
  EXPECT_FALSE(handler_.hold().cancelled);
  handler_.MayBeSent(true);
  EXPECT_THAT(Obeyed(NowOrder::kHome).detail, HasSubstr("ends its mission, and is sent home"));
  EXPECT_TRUE(handler_.hold().cancelled);
  EXPECT_EQ(kind(), Hold::Kind::kNone) << "it may drive";
  handler_.ForgetCancelled();
  handler_.Works(false);
  EXPECT_THAT(Obeyed(NowOrder::kHome).detail, HasSubstr("is sent home by desk"));
  EXPECT_FALSE(handler_.hold().cancelled) << "there is nothing to end";
  handler_.Works(true);
  handler_.Teaches(true);
  EXPECT_THAT(Tell(NowOrder::kHome).detail, HasSubstr("teaches a route: end that first"));
  handler_.Teaches(false);
  (void)Obeyed(NowOrder::kPause);
  EXPECT_THAT(Tell(NowOrder::kHome).detail, HasSubstr("resume it first"));
  (void)Obeyed(NowOrder::kStop);
  const NowAnswer refused = Tell(NowOrder::kHome);
  EXPECT_TRUE(refused.refused);
  EXPECT_THAT(refused.detail, HasSubstr("release it first"));
  EXPECT_FALSE(handler_.hold().cancelled);
}

TEST_F(NowHandlerTest, EndsWhatItTeachesAndNothingElse) {
  EXPECT_TRUE(Tell(NowOrder::kEnd).refused);
  handler_.Teaches(true);
  (void)Obeyed(NowOrder::kPause);
  (void)Obeyed(NowOrder::kEnd);
  EXPECT_TRUE(handler_.hold().ended);
  EXPECT_EQ(kind(), Hold::Kind::kPaused);
  handler_.Teaches(false);
  EXPECT_FALSE(handler_.hold().ended) << "the next one is another";
  EXPECT_TRUE(Tell(NowOrder::kEnd).refused);
}

TEST_F(NowHandlerTest, PausesAndResumes) {
  const NowAnswer paused = Say({.client = AgentId("desk-p77"),
                                .number = ++number_,
                                .order = NowOrder::kPause,
                                .reason = "somebody walks here"});
  EXPECT_EQ(paused.agent, AgentId("robot1"));
  EXPECT_EQ(paused.client, AgentId("desk-p77"));
  EXPECT_EQ(paused.detail, "paused by desk: somebody walks here");
  EXPECT_EQ(kind(), Hold::Kind::kPaused);
  EXPECT_EQ(handler_.hold().text, paused.detail);
  (void)Obeyed(NowOrder::kPause);
  EXPECT_EQ(handler_.hold().text, paused.detail) << "as it was";
  (void)Obeyed(NowOrder::kResume);
  EXPECT_EQ(kind(), Hold::Kind::kNone);
}

TEST_F(NowHandlerTest, AStopOutlastsTheAgentUntilItIsReleasedAndNothingMovesUnasked) {
  const std::string stopped = Obeyed(NowOrder::kStop).detail;
  EXPECT_THAT(stopped, HasSubstr("stopped by desk on 2023-11-14 at 22:13:20 UTC"));
  EXPECT_EQ(kind(), Hold::Kind::kStopped);
  EXPECT_TRUE(Tell(NowOrder::kResume).refused);
  (void)Obeyed(NowOrder::kPause);
  EXPECT_EQ(kind(), Hold::Kind::kStopped);

  NowHandler next(AgentId("robot1"), File());
  next.Load();
  EXPECT_EQ(next.hold().kind, Hold::Kind::kStopped);
  EXPECT_EQ(next.hold().text, stopped);

  (void)Obeyed(NowOrder::kRelease);
  EXPECT_EQ(kind(), Hold::Kind::kPaused);
  EXPECT_FALSE(std::filesystem::exists(File()));
  (void)Obeyed(NowOrder::kResume);
  EXPECT_EQ(kind(), Hold::Kind::kNone);
}

TEST_F(NowHandlerTest, AStopThatCannotBeReadIsOne) {
  std::ofstream(File()) << "nonsense";
  handler_.Load();
  EXPECT_EQ(kind(), Hold::Kind::kStopped);
  EXPECT_THAT(handler_.hold().text, HasSubstr("cannot be read"));
  (void)Obeyed(NowOrder::kRelease);
  EXPECT_EQ(kind(), Hold::Kind::kPaused);
}

TEST_F(NowHandlerTest, WhereAStopCannotBeKeptTheRobotStandsAndSaysSo) {
  NowHandler handler(AgentId("robot1"), folder_ / "nowhere" / "robot1.stop");
  handler.Handle(NowCommand{.client = AgentId("desk"), .number = 1}, "hall", kNow_ms);
  EXPECT_EQ(handler.hold().kind, Hold::Kind::kStopped);
  const auto answers = handler.TakeAnswers();
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_FALSE(std::get<NowAnswer>(answers[0]).refused);
  EXPECT_THAT(std::get<NowAnswer>(answers[0]).detail, HasSubstr("but not after a restart"));
}

TEST_F(NowHandlerTest, CancellingEndsWhatItDoesAndReleasesNothing) {
  (void)Obeyed(NowOrder::kStop);
  (void)Obeyed(NowOrder::kCancel);
  EXPECT_TRUE(handler_.hold().cancelled);
  EXPECT_EQ(kind(), Hold::Kind::kStopped);
  EXPECT_TRUE(std::filesystem::exists(File()));
}

TEST_F(NowHandlerTest, WhereNothingIsToBeCancelledThatIsSaid) {
  EXPECT_EQ(Obeyed(NowOrder::kCancel).detail, "mission cancelled by desk");
  handler_.ForgetCancelled();
  handler_.Works(false);
  const NowAnswer answer = Tell(NowOrder::kCancel);
  EXPECT_TRUE(answer.refused);
  EXPECT_EQ(answer.detail, "has no mission to cancel");
  EXPECT_FALSE(handler_.hold().cancelled);
}

TEST_F(NowHandlerTest, ACommandIsObeyedOnceAndAnsweredEachTime) {
  const NowCommand pause{.client = AgentId("desk-p77"), .number = 1, .order = NowOrder::kPause};
  const NowAnswer first = Say(pause);
  EXPECT_EQ(Say({.client = AgentId("desk-p77"), .number = 2, .order = NowOrder::kResume}).refused,
            false);
  EXPECT_EQ(Say(pause), first) << "late on its way";
  EXPECT_EQ(kind(), Hold::Kind::kNone);
  const NowCommand other{.client = AgentId("desk-p78"), .number = 1, .order = NowOrder::kPause};
  const NowAnswer paused = Say(other);
  EXPECT_EQ(Say(other), paused);
  EXPECT_EQ(handler_.TakeNews().size(), 3U);
  EXPECT_EQ(first.detail, paused.detail);
}

// Their containers give each process the number 1.
TEST_F(NowHandlerTest, ObeysEachProcessOfAnOperatorWhateverItsNumbers) {
  const AgentId desk("desk-p1");
  (void)Say({.client = desk, .number = 9'000'000, .order = NowOrder::kPause});
  EXPECT_FALSE(Say({.client = desk, .number = 7, .order = NowOrder::kResume}).refused);
  EXPECT_EQ(kind(), Hold::Kind::kNone);
}

TEST_F(NowHandlerTest, AnswersAreNoLongerThanALine) {
  const NowAnswer answer = Say({.client = AgentId("desk-p77"),
                                .number = 1,
                                .order = NowOrder::kStop,
                                .reason = std::string(exchange::kMaxLineBytes, 'x')});
  EXPECT_LE(answer.detail.size(), exchange::kMaxLineBytes);
}

TEST_F(NowHandlerTest, ObeysWhatItIsMeantBy) {
  const auto command = [&](NowWhom whom, const std::string& name) {
    return NowCommand{.client = AgentId("desk-p77"),
                      .number = ++number_,
                      .order = NowOrder::kPause,
                      .whom = whom,
                      .name = name};
  };
  EXPECT_EQ(Say(command(NowWhom::kRobot, "robot2")).detail, "no answer");
  EXPECT_EQ(Say(command(NowWhom::kOnRoute, "yard")).detail, "no answer");
  EXPECT_EQ(kind(), Hold::Kind::kNone);
  EXPECT_FALSE(Say(command(NowWhom::kRobot, "robot1")).refused);
  EXPECT_FALSE(Say(command(NowWhom::kOnRoute, "hall")).refused);
  EXPECT_FALSE(Say(command(NowWhom::kAll, "")).refused);
}

}  // namespace
}  // namespace trailcast::agent
