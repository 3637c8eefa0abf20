#include "services/tool/junctions_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::tool {
namespace {

using testing::HasSubstr;

JoinableRoute Route(const std::string& name, char id, bool odometry = true) {
  JoinableRoute route{{}, junctions::RouteViews(320)};
  route.info.key.route = RouteId(std::string(32, id));
  route.info.name = name;
  route::Segment segment;
  segment.has_odometry = odometry;
  route.views.Add(segment);
  return route;
}

junctions::Junction Found() {
  junctions::Junction junction;
  junction.at_a = 12.04;
  junction.end_a = 17.34;
  junction.at_b = 0.4;
  junction.end_b = 5.6;
  junction.views = 5;
  junction.features = 43;
  junction.confidence = 0.97;
  junction.heading_rad = -0.05;
  return junction;
}

TEST(JunctionsReport, SaysWhereAndHowLong) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("office", 'b')};
  EXPECT_EQ(JunctionsText(routes, {{0, 1, Found()}}),
            "hall@12.0 office@0.4 for 5.3 m, agreed by 43 features, 0.97 sure, 3 degrees to the "
            "right\n");
}

TEST(JunctionsReport, TellsRoutesOfOneNameApart) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("hall", 'b')};
  EXPECT_THAT(JunctionsText(routes, {{0, 1, Found()}}), HasSubstr("aaaaaaa@12.0 bbbbbbb@0.4 for"));
}

TEST(JunctionsReport, MeasuresInSecondsWithoutOdometry) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a', false), Route("office", 'b')};
  EXPECT_THAT(JunctionsText(routes, {{0, 1, Found()}}),
              HasSubstr("hall@12.0s office@0.4 for 5.3 s,"));
}

TEST(JunctionsReport, SaysThatThereAreNone) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("office", 'b')};
  EXPECT_TRUE(FindAllJunctions(routes, false).empty());
  EXPECT_EQ(JunctionsText(routes, {}), "no junctions of 2 routes\n");
  EXPECT_EQ(JunctionsJson(routes, {}).dump(), R"({"routes":2,"joints":[]})");
}

TEST(JunctionsReport, IsAnObjectForPrograms) {
  const std::vector<JoinableRoute> routes{Route("hall", 'a'), Route("office", 'b')};
  const std::string json = JunctionsJson(routes, {{0, 1, Found()}}).dump();
  EXPECT_THAT(json, HasSubstr(R"("a":{"name":"hall","route":"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",)"
                              R"("revision":0,"at":12.04,"end":17.34,"unit":"m"})"));
  EXPECT_THAT(json, HasSubstr(R"("length":5.3,"views":5,"features":43,"confidence":0.97,)"
                              R"("heading_deg":-2.9,"heading_measured":false)"));
}

}  // namespace
}  // namespace trailcast::tool
