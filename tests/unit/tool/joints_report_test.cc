#include "services/tool/joints_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::tool {
namespace {

using testing::HasSubstr;

JoinableRoute Route(const std::string& name, char id, bool odometry = true) {
  JoinableRoute route{{}, joints::RouteViews(320)};
  route.info.key.route = RouteId(std::string(32, id));
  route.info.name = name;
  route::Segment segment;
  segment.has_odometry = odometry;
  route.views.Add(segment);
  return route;
}

joints::Joint Found() {
  joints::Joint joint;
  joint.at_a = 12.04;
  joint.end_a = 17.34;
  joint.at_b = 0.4;
  joint.end_b = 5.6;
  joint.views = 5;
  joint.features = 43;
  joint.confidence = 0.97;
  joint.heading_rad = -0.05;
  return joint;
}

TEST(JointsReport, SaysWhereAndHowLong) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("office", 'b')};
  EXPECT_EQ(JointsText(routes, {{0, 1, Found()}}),
            "hall@12.0 office@0.4 for 5.3 m, agreed by 43 features, 0.97 sure, 3 degrees to the "
            "right\n");
}

TEST(JointsReport, TellsRoutesOfOneNameApart) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("hall", 'b')};
  EXPECT_THAT(JointsText(routes, {{0, 1, Found()}}), HasSubstr("aaaaaaa@12.0 bbbbbbb@0.4 for"));
}

TEST(JointsReport, MeasuresInSecondsWithoutOdometry) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a', false), Route("office", 'b')};
  EXPECT_THAT(JointsText(routes, {{0, 1, Found()}}), HasSubstr("hall@12.0s office@0.4 for 5.3 s,"));
}

TEST(JointsReport, SaysThatThereAreNone) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("office", 'b')};
  EXPECT_TRUE(FindAllJoints(routes, false).empty());
  EXPECT_EQ(JointsText(routes, {}), "no junctions of 2 routes\n");
  EXPECT_EQ(JointsJson(routes, {}).dump(), R"({"routes":2,"joints":[]})");
}

TEST(JointsReport, IsAnObjectForPrograms) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("office", 'b')};
  const std::string json = JointsJson(routes, {{0, 1, Found()}}).dump();
  EXPECT_THAT(json, HasSubstr(R"("a":{"name":"hall","route":"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",)"
                              R"("revision":0,"at":12.04,"end":17.34,"unit":"m"})"));
  EXPECT_THAT(json, HasSubstr(R"("length":5.3,"views":5,"features":43,"confidence":0.97,)"
                              R"("heading_deg":-2.9,"heading_measured":false)"));
}

}  // namespace
}  // namespace trailcast::tool
