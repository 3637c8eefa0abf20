#include "services/console/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/console/parameters.h"

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

TEST(ConsoleBodies, AStopsReasonIsWhatCanBeReadOfIt) {
  EXPECT_EQ(ReasonIfAny(R"({"reason": "rain", "by": [1]})"), "rain");
  EXPECT_EQ(ReasonIfAny(R"({"reason": "a\nb"})"), "a b");
  EXPECT_EQ(ReasonIfAny(R"({"reason": ")" + std::string(600, 'x') + "\"}").size(), 512U);
  for (const std::string& none :
       {std::string(), std::string("x"), std::string("[]"), std::string(R"({"reason": 1})"),
        std::string(R"({"reason": ")"), std::string("\xff\xfe"), std::string(60'000, '[')}) {
    EXPECT_EQ(ReasonIfAny(none), "") << none.substr(0, 20);
  }
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
  EXPECT_EQ(ReadSend(R"({"to": "@cart,lift", "orders": "wait 1"})", true)->to, "@cart,lift");
  EXPECT_THAT(ReadSend(R"({"orders": "wait 1"})", true).error().message, HasSubstr("'to': '' is"));
  EXPECT_FALSE(ReadSend(R"({"to": "lift", "orders": "wait 1"})")) << "its address says that";
  EXPECT_THAT(ReadSend(R"({"orders": "dance"})").error().message, HasSubstr("dance"));
  for (const char* wrong :
       {"", "{}", R"({"orders": "wait 1", "id": "a b"})", R"({"orders": "wait 1", "valid_s": -1})",
        R"({"orders": "wait 1", "valid_s": 1e99})",
        R"({"orders": "wait 1", "valid_s": 4294967296})", R"({"orders": "wait 1", "goes_on": 1})",
        R"({"orders": ["wait 1"]})", R"({"orders": "wait 1", "robot": "other"})"}) {
    EXPECT_FALSE(ReadSend(wrong)) << wrong;
  }
}

TEST(ConsoleBodies, MissionsAndSchedulesMayTakePhotos) {
  const auto send = ReadSend(R"({"orders": "wait 1", "photo_every_m": 5, "photo_at": ["dock"]})");
  ASSERT_TRUE(send) << send.error().message;
  EXPECT_EQ(send->photos.every_m, 5.0);
  EXPECT_EQ(send->photos.at, std::vector<std::string>{"dock"});
  const auto schedule = ReadSchedule(
      R"({"words": "s to r at 08:30 zone UTC do wait 1", "photo_every_m": 5, "photo_at": ["dock"]})");
  ASSERT_TRUE(schedule) << schedule.error().message;
  EXPECT_EQ(schedule->schedule.orders, "wait 1");
  EXPECT_EQ(schedule->photos.every_m, 5.0);
  EXPECT_EQ(schedule->photos.at, std::vector<std::string>{"dock"});
  for (const std::string wrong :
       {R"("photo_every_m": 0)", R"("photo_every_m": "5")", R"("photo_at": "dock")",
        R"("photo_at": [1])", R"("photos": 1)"}) {
    EXPECT_FALSE(ReadSend(R"({"orders": "wait 1", )" + wrong + "}")) << wrong;
    EXPECT_FALSE(ReadSchedule(R"({"words": "s to r at 08:30 zone UTC do wait 1", )" + wrong + "}"))
        << wrong;
  }
}

TEST(ConsoleBodies, TheNetworkIsChangedInWordsThatAreUnderstood) {
  EXPECT_EQ(ReadNetworkEdit(R"({"words": "close hall 3..7"})").value(), "close hall 3..7");
  EXPECT_THAT(ReadNetworkEdit(R"({"words": "dance"})").error().message, HasSubstr("dance"));
  for (const char* wrong : {"", "{}", R"({"words": ""})", R"({"words": 1})",
                            R"({"words": "close hall", "by": "anna"})"}) {
    EXPECT_FALSE(ReadNetworkEdit(wrong)) << wrong;
  }
}

TEST(ConsoleBodies, AQueryIsAsTheCatalogHasIt) {
  EXPECT_EQ(ReadRouteQuery({})->page_size, 50U);
  const auto query = ReadRouteQuery({{"prefix", "barn-"},
                                     {"tag", "wet"},
                                     {"tag", "night"},
                                     {"scout", ""},
                                     {"min_length_m", "2.5"},
                                     {"taught_from_unix_ms", "5"},
                                     {"state", "active"},
                                     {"near_gps", "48.25,11.5"},
                                     {"within_m", "200"},
                                     {"sort", "longest"},
                                     {"limit", "200"},
                                     {"cursor", "x"}});
  ASSERT_TRUE(query) << query.error().message;
  EXPECT_EQ(query->name_prefix, "barn-");
  EXPECT_EQ(query->tags, (std::vector<std::string>{"night", "wet"}));
  EXPECT_EQ(query->min_length_m, 2.5);
  EXPECT_EQ(query->taught_from_unix_ms, 5);
  EXPECT_EQ(query->state, route::RouteState::kComplete);
  EXPECT_EQ(query->standing, route::Standing::kActive);
  EXPECT_EQ(query->near->middle.y, 48.25) << "north";
  EXPECT_EQ(query->near->radius_m, 200.0);
  EXPECT_EQ(query->order, route::RouteOrder::kLongest);
  EXPECT_EQ(query->page_size, 200U);
  EXPECT_EQ(query->cursor, "x");
}

TEST(ConsoleBodies, AQueryThatMakesNoSenseIsRefusedByName) {
  const std::vector<Parameters> wrong{{{"limit", "0"}},
                                      {{"limit", "201"}},
                                      {{"limit", "x"}},
                                      {{"name", "a/b"}},
                                      {{"name", "a"}, {"name", "b"}},
                                      {{"prefix", std::string(65, 'x')}},
                                      {{"tag", "a b"}},
                                      {{"min_length_m", "nan"}},
                                      {{"max_length_m", "-1"}},
                                      {{"state", "sold"}},
                                      {{"sort", "best"}},
                                      {{"near_site", "1"}},
                                      {{"near_gps", "91,0"}},
                                      {{"near_gps", "1,2"}, {"within_m", "0"}},
                                      {{"cursor", "a\nb"}},
                                      {{"dance", "1"}}};
  for (const Parameters& parameters : wrong) {
    const auto query = ReadRouteQuery(parameters);
    ASSERT_FALSE(query) << parameters.begin()->first << "=" << parameters.begin()->second;
    EXPECT_EQ(query.error().code, ErrorCode::kInvalidArgument);
  }
  EXPECT_THAT(ReadRouteQuery({{"state", "sold"}}).error().message,
              testing::AllOf(HasSubstr("'state'"), HasSubstr("active, complete")));
}

TEST(ConsoleBodies, AnEditSaysWhatIsToBecomeOfARoute) {
  const auto edit =
      ReadRouteEdit("hall", R"({"action": "tag", "revision": 2, "tags": ["wet", "night", "wet"]})");
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->action, route::EditAction::kTag);
  EXPECT_EQ(edit->route, "hall");
  EXPECT_EQ(edit->revision, 2U);
  EXPECT_EQ(edit->tags, (std::vector<std::string>{"night", "wet"}));
  EXPECT_TRUE(ReadRouteEdit("hall", R"({"action": "delete", "revision": 2})"));
  EXPECT_THAT(ReadRouteEdit("hall", R"({"action": "delete"})").error().message,
              HasSubstr("one 'revision'"))
      << "nobody deletes a whole route by leaving something out";
  EXPECT_THAT(ReadRouteEdit("hall", R"({"action": "sell"})").error().message,
              testing::AllOf(HasSubstr("'action'"), HasSubstr("activate")));
}

TEST(ConsoleBodies, AnErrorIsJsonWhateverItSays) {
  EXPECT_EQ(ErrorBody("\"no\"\xff"), "{\"error\":\"\\\"no\\\"\uFFFD\"}");
}

TEST(ConsoleBodies, ALogInNeedsUserAndPassword) {
  const auto log_in = ReadLogIn(R"({"user": "anna", "password": "correct horse"})");
  ASSERT_TRUE(log_in) << log_in.error().message;
  EXPECT_EQ(log_in->user, "anna");
  EXPECT_EQ(log_in->password, "correct horse");
  for (const char* wrong : {"", "{}", R"({"user": "anna"})", R"({"user": "anna", "password": 1})",
                            R"({"user": [], "password": ""})",
                            R"({"user": "", "password": "", "role": "administer"})"}) {
    EXPECT_FALSE(ReadLogIn(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace trailcast::console
