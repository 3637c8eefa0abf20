#include "route_server/status/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::server {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(LatencyHistogram, CountsEachTimeInEveryBoundAboveIt) {
  LatencyHistogram histogram;
  histogram.Note(0.0002);
  histogram.Note(0.003);
  histogram.Note(7.0);
  const std::string text = histogram.Text("seconds", R"(kind="tag")");
  EXPECT_THAT(text, HasSubstr("seconds_bucket{kind=\"tag\",le=\"0.0001\"} 0\n"));
  EXPECT_THAT(text, HasSubstr("seconds_bucket{kind=\"tag\",le=\"0.00025\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("seconds_bucket{kind=\"tag\",le=\"0.005\"} 2\n"));
  EXPECT_THAT(text, HasSubstr("seconds_bucket{kind=\"tag\",le=\"1\"} 2\n"));
  EXPECT_THAT(text, HasSubstr("seconds_bucket{kind=\"tag\",le=\"+Inf\"} 3\n"));
  EXPECT_THAT(text, HasSubstr("seconds_sum{kind=\"tag\"} 7.0032\n"));
  EXPECT_THAT(text, HasSubstr("seconds_count{kind=\"tag\"} 3\n"));
}

TEST(Metrics, EachHasItsHelpAndType) {
  Metrics metrics;
  metrics.routes = 7;
  metrics.keeper.appended = 42;
  metrics.over_quota.segments = 3;
  metrics.queries["name"].Note(0.001);
  const std::string text = metrics.Text();
  EXPECT_THAT(text, HasSubstr("# HELP trailcast_routes "));
  EXPECT_THAT(text, HasSubstr("# TYPE trailcast_routes gauge\ntrailcast_routes 7\n"));
  EXPECT_THAT(text, HasSubstr("# TYPE trailcast_segments_stored_total counter\n"
                              "trailcast_segments_stored_total 42\n"));
  EXPECT_THAT(text, HasSubstr("\ntrailcast_over_quota_segments_total 3\n"));
  EXPECT_THAT(text, HasSubstr("# TYPE trailcast_catalog_query_seconds histogram\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_catalog_query_seconds_count{kind=\"name\"} 1\n"));
  EXPECT_THAT(text, Not(HasSubstr("\n\n")));
  EXPECT_EQ(text.back(), '\n');
}

TEST(KindOf, IsByWhatMostNarrowsDown) {
  EXPECT_STREQ(KindOf({}), "other");
  EXPECT_STREQ(KindOf({.tags = {"wet"}}), "tag");
  EXPECT_STREQ(KindOf({.tags = {"wet"}, .near = route::Surroundings{{}, 1.0}}), "place");
  EXPECT_STREQ(KindOf({.name = "yard", .tags = {"wet"}}), "name");
  EXPECT_STREQ(KindOf({.view = route::View(1)}), "view");
}

}  // namespace
}  // namespace trailcast::server
