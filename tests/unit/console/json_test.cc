#include "services/console/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::console {
namespace {

using testing::HasSubstr;

TEST(ConsoleBodies, AReasonMayBeAbsent) {
  EXPECT_EQ(ReadReason("").value(), "");
  EXPECT_EQ(ReadReason("{}").value(), "");
  EXPECT_EQ(ReadReason(R"({"reason": "rain \u2602"})").value(), "rain ☂");
  for (const char* wrong : {"x", "[]", "null", R"({"reason": 1})", R"({"reason": "a\nb"})",
                            R"({"why": ""})", "{\"reason\": \"\xff\"}", R"({"reason": ")"}) {
    const auto reason = ReadReason(wrong);
    ASSERT_FALSE(reason) << wrong;
    EXPECT_EQ(reason.error().code, ErrorCode::kInvalidArgument) << wrong;
  }
  EXPECT_FALSE(ReadReason(R"({"reason": ")" + std::string(513, 'x') + "\"}"));
  EXPECT_FALSE(ReadReason(std::string(60'000, '['))) << "nested as deep as one likes";
}

TEST(ConsoleBodies, AMissionNeedsOrdersThatAreUnderstood) {
  const auto send =
      ReadSend(R"({"orders": "follow hall", "id": "trip", "valid_s": 0, "goes_on": true})");
  ASSERT_TRUE(send) << send.error().message;
  EXPECT_EQ(send->orders, "follow hall");
  EXPECT_EQ(send->id, "trip");
  EXPECT_EQ(send->valid_s, 0U);
  EXPECT_TRUE(send->goes_on);
  EXPECT_EQ(ReadSend(R"({"orders": "wait 1"})")->valid_s, 600U);
  EXPECT_THAT(ReadSend(R"({"orders": "dance"})").error().message, HasSubstr("dance"));
  for (const char* wrong :
       {"", "{}", R"({"orders": "wait 1", "id": "a b"})", R"({"orders": "wait 1", "valid_s": -1})",
        R"({"orders": "wait 1", "valid_s": 1e99})",
        R"({"orders": "wait 1", "valid_s": 4294967296})", R"({"orders": "wait 1", "goes_on": 1})",
        R"({"orders": ["wait 1"]})", R"({"orders": "wait 1", "robot": "other"})"}) {
    EXPECT_FALSE(ReadSend(wrong)) << wrong;
  }
}

TEST(ConsoleBodies, RepliesAreJsonWhateverARobotSays) {
  EXPECT_EQ(
      WordBody({.robot = "robot1", .answered = true, .refused = true, .detail = "\"no\"\xff"}),
      "{\"robot\":\"robot1\",\"answered\":true,\"obeys\":false,\"detail\":\"\\\"no\\\"\uFFFD\"}");
  EXPECT_EQ(WordsBody({}), R"({"robots":[]})");
  EXPECT_EQ(ErrorBody("why"), R"({"error":"why"})");
  const mission::Record record{.mission = {.agent = AgentId("robot1"),
                                           .id = "trip",
                                           .client = AgentId("desk-p12"),
                                           .orders = "follow hall"},
                               .last = {.state = mission::State::kUnderWay},
                               .sent_unix_ms = 5};
  EXPECT_THAT(MissionsBody({record}),
              testing::AllOf(HasSubstr(R"("state":"under way")"), HasSubstr(R"("sent_by":"desk")"),
                             HasSubstr(R"("sent_unix_ms":5)")));
}

}  // namespace
}  // namespace trailcast::console
