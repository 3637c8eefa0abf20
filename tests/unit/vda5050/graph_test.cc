#include "services/vda5050/graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::vda5050 {
namespace {

using testing::HasSubstr;

Graph Site() {
  return Graph::Read({"route hall 10", "route office 6", "route attic 3",
                      "join hall@4.5 office@0.5", "name dock office@5", "route hall 10",
                      "join hall@9 shed@0", "close attic 1..2", "unused name old hall@2",
                      "unused join hall@1 office@1", "something of a later version"})
      .value();
}

TEST(GraphTest, NodesAreNamesAndPlacesOnRoutes) {
  const Graph graph = Site();
  EXPECT_EQ(graph.Find("dock")->goal, "dock");
  EXPECT_EQ(graph.Find("dock")->place, (network::Place{"office", 5.0}));
  for (const char* id : {"hall:2.5", "hall@2.5"}) {
    EXPECT_EQ(graph.Find(id)->goal, "hall@2.5");
    EXPECT_EQ(graph.Find(id)->place, (network::Place{"hall", 2.5}));
  }
  EXPECT_THAT(graph.Find("bay").error().message, HasSubstr("there is no node 'bay'"));
  EXPECT_THAT(graph.Find("old").error().message, HasSubstr("there is no node 'old'"));
  EXPECT_THAT(graph.Find("yard:2").error().message, HasSubstr("there is no node"));
  EXPECT_THAT(graph.Find("hall:11").error().message, HasSubstr("hall is 10.00 m long"));
  EXPECT_FALSE(graph.Find(""));
  EXPECT_FALSE(graph.Find("hall:-1"));
  EXPECT_FALSE(graph.Find("hall:nan"));
}

TEST(GraphTest, WaysLeadOverJunctionsAndRoundWhatIsClosed) {
  const Graph graph = Site();
  const auto way = graph.WayBetween({"hall", 1.0}, {"office", 5.0});
  ASSERT_TRUE(way);
  ASSERT_EQ(way->sections.size(), 2U);
  EXPECT_DOUBLE_EQ(way->length_m, 8.0);
  EXPECT_FALSE(graph.WayBetween({"hall", 5.0}, {"hall", 1.0})) << "the wrong way";
  EXPECT_THAT(graph.WayBetween({"attic", 0.0}, {"attic", 3.0}).error().message,
              HasSubstr("closed"));
}

TEST(GraphTest, ARobotStandsOnANodeThatIsNearAlongRoutes) {
  const Graph graph = Site();
  EXPECT_TRUE(graph.IsOn({"hall", 2.0}, {"hall", 2.9}));
  EXPECT_TRUE(graph.IsOn({"hall", 2.9}, {"hall", 2.0})) << "a little beyond it";
  EXPECT_FALSE(graph.IsOn({"hall", 2.0}, {"hall", 3.1}));
  EXPECT_TRUE(graph.IsOn({"hall", 4.3}, {"office", 0.5})) << "by the junction";
  EXPECT_FALSE(graph.IsOn({"attic", 0.5}, {"office", 0.5}));
  EXPECT_EQ(graph.NodeAt({"hall", 4.4}), "hall:4.5");
  EXPECT_EQ(graph.NodeAt({"office", 5.2}), "dock");
  EXPECT_EQ(graph.NodeAt({"hall", 9.5}), "hall:10");
  EXPECT_EQ(graph.NodeAt({"hall", 2.0}), std::nullopt);
}

}  // namespace
}  // namespace trailcast::vda5050
