#include "services/mission/orders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/mission/mission.h"

namespace trailcast::mission {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

TEST(Orders, AreFollowedAndWaitedForInTheirOrder) {
  const auto tasks = ParseOrders(
      "follow hall@2 3..10 laps 4 speed 0.5  wait 20 follow yard ..7.5 follow dock 2..");
  ASSERT_TRUE(tasks) << tasks.error().message;
  ASSERT_THAT(*tasks, SizeIs(4));
  const Task& hall = (*tasks)[0];
  EXPECT_EQ(hall.kind, Task::Kind::kFollow);
  EXPECT_EQ(hall.route.route, "hall");
  EXPECT_EQ(hall.route.revision, 2U);
  EXPECT_DOUBLE_EQ(hall.from_m, 3.0);
  EXPECT_DOUBLE_EQ(hall.to_m, 10.0);
  EXPECT_EQ(hall.laps, 4U);
  EXPECT_DOUBLE_EQ(hall.speed_factor, 0.5);
  EXPECT_EQ((*tasks)[1].kind, Task::Kind::kWait);
  EXPECT_DOUBLE_EQ((*tasks)[1].wait_s, 20.0);
  EXPECT_DOUBLE_EQ((*tasks)[2].from_m, 0.0);
  EXPECT_DOUBLE_EQ((*tasks)[2].to_m, 7.5);
  EXPECT_DOUBLE_EQ((*tasks)[3].from_m, 2.0);
  EXPECT_DOUBLE_EQ((*tasks)[3].to_m, 0.0);
}

TEST(Orders, AsTextAreTheSameOrders) {
  for (const char* text :
       {"follow hall", "follow hall@2 3..10 laps 4 speed 0.5", "wait 2.5", "follow a3f9c21 2..",
        "follow hall 0..7.5", "follow hall backwards", "follow hall backwards 10..3 speed 0.5",
        "follow hall backwards ..3", "follow hall@2 backwards 10..", "teach yard",
        "teach yard wet laps 2.5-ton", "turn 180", "turn -57.5"}) {
    const auto tasks = ParseOrders(text);
    ASSERT_TRUE(tasks) << tasks.error().message;
    EXPECT_EQ(ToText(tasks->front()), text);
  }
}

TEST(Orders, OfAWayToAPlaceSayWhereItLeadsAndWhyItIsAnotherOne) {
  for (const char* text :
       {"goto office@3 follow hall 0..1.5 follow office 1.5..3",
        "goto loading-bay way 2 follow hall 0.4..1.5 follow yard 0..3 because hall 3..7 was closed",
        "goto way way 3 wait way because every way there is closed",
        "goto bay way 2 queued wait lane follow hall 0..3 because waits for robot1",
        "goto bay way 3 admitted follow hall 0..3",
        "goto office@3 way 2 follow because 0..2 wait way",
        "goto office@3 wait lane follow hall 0..12 wait lane follow office 0..3",
        "goto bay follow hall 2..5 follow hall backwards 5..1 turn 180 follow office 0..3",
        "goto bay follow hall backwards 5.."}) {
    const auto tasks = ParseOrders(text);
    const auto going = GoingIn(text);
    ASSERT_TRUE(tasks && going) << text;
    EXPECT_EQ(ToText(*going, *tasks), text);
  }
  const auto going = GoingIn("goto bay way 7 follow hall 0..1 because  it   was so");
  ASSERT_TRUE(going);
  EXPECT_EQ(going->to, "bay");
  EXPECT_EQ(going->way, 7U);
  EXPECT_EQ(going->because, "it was so");
  EXPECT_EQ(going->why, Going::Why::kReplanned);
  EXPECT_EQ(GoingIn("goto bay way 2 queued wait lane")->why, Going::Why::kQueued);
  EXPECT_EQ(GoingIn("goto bay way 2 admitted follow hall 0..1")->why, Going::Why::kAdmitted);
  EXPECT_FALSE(GoingIn("goto bay queued follow hall 0..1")) << "of the first way there is none";
  EXPECT_FALSE(GoingIn("follow hall"));
  EXPECT_FALSE(GoingIn("goto bay teach yard"));
}

TEST(Orders, AskForPhotosBeforeTheFirstOrder) {
  const PhotoWish wish =
      PhotosIn("photo every 2.5 at hall@3 at dock=yard@2@0.5 follow hall follow yard@2");
  EXPECT_DOUBLE_EQ(wish.every_m, 2.5);
  ASSERT_THAT(wish.at, SizeIs(2));
  EXPECT_EQ(wish.at[0].route.route, "hall");
  EXPECT_DOUBLE_EQ(wish.at[0].along_m, 3.0);
  EXPECT_EQ(wish.at[1].name, "dock");
  EXPECT_EQ(wish.at[1].route.revision, 2U);
  EXPECT_DOUBLE_EQ(wish.at[1].along_m, 0.5);
  EXPECT_EQ(ToText(wish), "photo every 2.5 at hall@3 at dock=yard@2@0.5");
  EXPECT_THAT(*ParseOrders("photo at hall@3 follow hall wait 2"), SizeIs(2));
  EXPECT_FALSE(PhotosIn("follow hall").any());
  EXPECT_FALSE(PhotosIn("photo every 5 dance").any());
}

// A server that sends a robot along another path has it take the same pictures there.
TEST(Orders, OfAWayToAPlaceKeepItsPhotos) {
  const char* text = "goto bay way 2 photo every 5 follow hall 0..3 because there is a way";
  const auto going = GoingIn(text);
  ASSERT_TRUE(going);
  EXPECT_DOUBLE_EQ(going->photos.every_m, 5.0);
  EXPECT_EQ(ToText(*going, *ParseOrders(text)), text);
}

// Routes may be called as the words of orders are.
TEST(Orders, OfARouteCalledLikeAWord) {
  const auto tasks = ParseOrders("follow follow follow wait wait 1");
  ASSERT_TRUE(tasks) << tasks.error().message;
  ASSERT_THAT(*tasks, SizeIs(3));
  EXPECT_EQ((*tasks)[0].route.route, "follow");
  EXPECT_EQ((*tasks)[1].route.route, "wait");
}

TEST(Orders, OfATeachingHaveItsTagsUpToTheNextOrder) {
  const auto tasks = ParseOrders("teach yard wet gravel wait 2 teach teach follow yard");
  ASSERT_TRUE(tasks) << tasks.error().message;
  ASSERT_THAT(*tasks, SizeIs(4));
  EXPECT_EQ((*tasks)[0].kind, Task::Kind::kTeach);
  EXPECT_EQ((*tasks)[0].route.route, "yard");
  EXPECT_THAT((*tasks)[0].tags, testing::ElementsAre("wet", "gravel"));
  EXPECT_EQ((*tasks)[1].kind, Task::Kind::kWait);
  EXPECT_EQ((*tasks)[2].route.route, "teach");
  EXPECT_EQ((*tasks)[3].kind, Task::Kind::kFollow);
}

TEST(Orders, ThatAreNotUnderstoodAreNamed) {
  const auto why = [](const char* text) {
    const auto tasks = ParseOrders(text);
    if (tasks) return std::string("understood");
    EXPECT_EQ(tasks.error().code, ErrorCode::kInvalidArgument);
    return tasks.error().message;
  };
  EXPECT_THAT(why(""), HasSubstr("no orders: say 'follow ROUTE"));
  EXPECT_THAT(why("go hall"), HasSubstr("'go' was not understood"));
  EXPECT_THAT(why("follow hall sideways"), HasSubstr("'sideways'"));
  EXPECT_THAT(why("follow"), HasSubstr("route"));
  EXPECT_THAT(why("follow hall laps 0"), HasSubstr("'0'"));
  EXPECT_THAT(why("follow hall laps"), HasSubstr("laps, 1 to 10000"));
  EXPECT_THAT(why("follow hall laps 1e9"), HasSubstr("'1e9'"));
  EXPECT_THAT(why("follow hall speed 7"), HasSubstr("'7'"));
  EXPECT_THAT(why("follow hall speed nan"), HasSubstr("'nan'"));
  EXPECT_THAT(why("follow hall 10..3"), HasSubstr("FROM..TO"));
  EXPECT_THAT(why("follow hall -1..3"), HasSubstr("FROM..TO"));
  EXPECT_THAT(why("follow hall backwards 3..10"), HasSubstr("backwards, as 10..3"));
  EXPECT_THAT(why("follow hall backwards laps 2"), HasSubstr("'laps'"));
  EXPECT_THAT(why("goto bay follow hall backwards ..1"), HasSubstr("FROM..TO' alone"));
  EXPECT_THAT(why("turn left"), HasSubstr("'left' was not understood: expected degrees"));
  EXPECT_THAT(why("turn 400"), HasSubstr("-360 to 360"));
  EXPECT_THAT(why("teach"), HasSubstr("route to teach"));
  EXPECT_THAT(why("teach hall@2"), HasSubstr("hall@2"));
  EXPECT_THAT(why("teach hall a/b"), HasSubstr("'a/b' was not understood: expected a tag"));
  EXPECT_THAT(why("teach hall 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17"), HasSubstr("tags"));
  EXPECT_THAT(why("goto"), HasSubstr("a place to go to"));
  EXPECT_THAT(why("goto bay"), HasSubstr("no orders"));
  EXPECT_THAT(why("goto bay way 1 follow hall"), HasSubstr("which way it is, 2 or more"));
  EXPECT_THAT(why("goto bay follow hall"), HasSubstr("'follow ROUTE FROM..TO' alone"));
  EXPECT_THAT(why("goto bay wait 3"), HasSubstr("'follow ROUTE FROM..TO' alone"));
  EXPECT_THAT(why("goto bay wait way follow hall 0..1"), HasSubstr("FROM..TO' alone"));
  EXPECT_THAT(why("follow hall because"), HasSubstr("'because' was not understood"));
  EXPECT_THAT(why("wait way"), HasSubstr("seconds"));
  EXPECT_THAT(why("follow hall wait lane"), HasSubstr("seconds"));
  EXPECT_THAT(why("wait"), HasSubstr("seconds"));
  EXPECT_THAT(why("wait -1"), HasSubstr("seconds"));
  EXPECT_THAT(why("photo follow hall"), HasSubstr("'every METRES' or 'at PLACE'"));
  EXPECT_THAT(why("photo every 0.1 follow hall"), HasSubstr("0.2 or more"));
  EXPECT_THAT(why("photo every nan follow hall"), HasSubstr("'nan'"));
  EXPECT_THAT(why("photo at hall follow hall"), HasSubstr("'hall' was not understood"));
  EXPECT_THAT(why("photo at a b=hall@1 follow hall"), HasSubstr("as hall@12.5"));
  EXPECT_THAT(why("photo at hall@-1 follow hall"), HasSubstr("as hall@12.5"));
  EXPECT_THAT(why("photo every 5"), HasSubstr("no orders"));
  EXPECT_THAT(why("follow hall photo every 5"), HasSubstr("before the first of them"));
  std::string many = "photo";
  for (int i = 0; i < 17; ++i) many += " at h@1";
  EXPECT_THAT(why((many + " follow h").c_str()), HasSubstr("16 places"));
  EXPECT_THAT(why("wait inf"), HasSubstr("seconds"));
}

TEST(Orders, NameTheirRoutesOnce) {
  EXPECT_EQ(RoutesIn("follow hall wait 1 follow yard@2 follow hall teach dock wet"),
            (std::set<std::string>{"dock", "hall", "yard"}));
  EXPECT_TRUE(RoutesIn("dance").empty());
}

TEST(Report, OfARobotIsNewerByItsNumberAndThanAnyOfAServer) {
  const auto report = [](std::uint32_t change, State state) {
    return Report{.change = change, .state = state};
  };
  EXPECT_TRUE(IsNewer(report(2, State::kUnderWay), report(1, State::kAccepted)));
  EXPECT_FALSE(IsNewer(report(1, State::kAccepted), report(1, State::kAccepted)));
  EXPECT_TRUE(IsNewer(report(1, State::kAccepted), report(0, State::kExpired)));
  EXPECT_FALSE(IsNewer(report(0, State::kExpired), report(1, State::kAccepted)));
  EXPECT_TRUE(IsNewer(report(0, State::kExpired), report(0, State::kSent)));
  EXPECT_FALSE(IsNewer(report(0, State::kSent), report(0, State::kExpired)));
  EXPECT_FALSE(IsNewer(report(0, State::kSent), report(0, State::kSent)));
}

TEST(State, HasANameEach) {
  for (std::uint8_t i = 0; i < kStates; ++i) {
    EXPECT_STRNE(ToString(static_cast<State>(i)), "unknown");
  }
  EXPECT_STREQ(ToString(State::kPutOff), "put off");
  EXPECT_FALSE(HasEnded(State::kPutOff));
  EXPECT_TRUE(HasEnded(State::kExpired));
  EXPECT_FALSE(HasEnded(State::kPaused));
}

}  // namespace
}  // namespace trailcast::mission
