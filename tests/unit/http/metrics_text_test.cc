#include "services/http/metrics_text.h"

#include <gtest/gtest.h>

namespace trailcast::http {
namespace {

TEST(MetricsText, EachHasItsHelpAndType) {
  MetricsText text;
  text.Add("streams", "gauge", "Pages that look.", 2);
  text.Begin("robots", "gauge", "Robots, by state.");
  text.Add(1, {{"state", "free"}});
  text.Add(0.25, {{"state", "driving"}, {"site", "yard"}});
  EXPECT_EQ(text.text(),
            "# HELP trailcast_streams Pages that look.\n"
            "# TYPE trailcast_streams gauge\n"
            "trailcast_streams 2\n"
            "# HELP trailcast_robots Robots, by state.\n"
            "# TYPE trailcast_robots gauge\n"
            "trailcast_robots{state=\"free\"} 1\n"
            "trailcast_robots{state=\"driving\",site=\"yard\"} 0.25\n");
}

TEST(MetricsText, NobodysNameEndsItsLabel) {
  MetricsText text;
  text.Begin("info", "gauge", "Who.");
  text.Add(1, {{"name", "a\"} 1\nb\\ä"}});
  EXPECT_TRUE(text.text().ends_with("trailcast_info{name=\"a\\\"} 1\\nb\\\\ä\"} 1\n"))
      << text.text();
}

TEST(MetricsText, CountsStayWhole) {
  MetricsText text;
  text.Add("bytes_total", "counter", "Bytes.", 123456789012.0);
  text.Add("seen", "gauge", "When.", 1798765432.125);
  EXPECT_NE(text.text().find("\ntrailcast_bytes_total 123456789012\n"), std::string::npos)
      << text.text();
  EXPECT_NE(text.text().find("\ntrailcast_seen 1798765432.125\n"), std::string::npos)
      << text.text();
}

}  // namespace
}  // namespace trailcast::http
