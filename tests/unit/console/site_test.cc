#include "services/console/site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/temp_dir.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class SiteTest : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // The error of opening it.
  std::string Refusal() {
    const auto site = Site::Open(folder_ / "");
    return site ? "" : site.error().message;
  }

  const RouteId hall_{"00112233445566778899aabbccddeeff"};
  test::TempDir folder_;
};

TEST_F(SiteTest, WhereARouteWasPutIsThereAfterwards) {
  const Placement put{.x_m = 3.5, .y_m = -1.0, .heading_rad = 1.25, .scale = 1.02};
  {
    const auto site = Site::Open(folder_ / "");
    ASSERT_TRUE(site) << site.error().message;
    EXPECT_FALSE((*site)->plan());
    EXPECT_EQ(json::parse((*site)->Body())["placements"], json::object());
    ASSERT_TRUE((*site)->Place(hall_, put));
  }
  const auto again = Site::Open(folder_ / "");
  ASSERT_TRUE(again) << again.error().message;
  const json placements = json::parse((*again)->Body())["placements"];
  EXPECT_EQ(placements[hall_.value()]["x_m"], 3.5);
  EXPECT_EQ(placements[hall_.value()]["heading_rad"], 1.25);
  ASSERT_TRUE((*again)->Place(hall_, std::nullopt));
  EXPECT_EQ(json::parse((*again)->Body())["placements"], json::object());
}

TEST_F(SiteTest, AFloorPlanIsAPictureOfAKnownScale) {
  Write("plan.png", "\x89PNG\r\n\x1a\n and so on");
  EXPECT_THAT(Refusal(), HasSubstr("how many metres a pixel"));
  Write("site.json",
        R"({"metres_per_pixel": 0.05, "origin": {"longitude_deg": 11.5, "latitude_deg": 48.2}})");
  const auto site = Site::Open(folder_ / "");
  ASSERT_TRUE(site) << site.error().message;
  EXPECT_STREQ((*site)->plan()->type, "image/png");
  const json body = json::parse((*site)->Body());
  EXPECT_EQ(body["plan"]["metres_per_pixel"], 0.05);
  EXPECT_EQ(body["origin"]["latitude_deg"], 48.2);
  Write("plan.png", "<svg onload='alert(1)'/>");
  EXPECT_THAT(Refusal(), HasSubstr("no picture of this kind"));
}

TEST_F(SiteTest, WhatIsWrongIsNamedAndLeftAsItIs) {
  EXPECT_THAT(Site::Open(folder_ / "absent").error().message, HasSubstr("there is no folder"));
  Write("placements.json", R"({"hall": {"x_m": 1}})");
  EXPECT_THAT(Refusal(), HasSubstr("placements.json"));
  std::filesystem::remove(folder_ / "placements.json");
  for (const char* text : {"", "[]", R"({"metres_per_pixel": 0})", R"({"metres": 1})",
                           R"({"origin": {"longitude_deg": 200, "latitude_deg": 0}})"}) {
    Write("site.json", text);
    EXPECT_THAT(Refusal(), HasSubstr("site.json")) << text;
  }
}

TEST(ReadPlacement, TakesFourNumbersWithinReason) {
  const auto read = ReadPlacement(R"({"x_m": 1, "y_m": 2.5, "heading_rad": -7, "scale": 1})");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->y_m, 2.5);
  EXPECT_NEAR(read->heading_rad, -7.0 + 2.0 * 3.14159265, 1e-6);
  for (const char* body : {"", "[]", "{", R"({"x_m": 1, "y_m": 2, "heading_rad": 0})",
                           R"({"x_m": 1e9, "y_m": 2, "heading_rad": 0, "scale": 1})",
                           R"({"x_m": 1, "y_m": "2", "heading_rad": 0, "scale": 1})",
                           R"({"x_m": 1, "y_m": 2, "heading_rad": 0, "scale": 0})",
                           R"({"x_m": 1, "y_m": 2, "heading_rad": 0, "scale": 1, "more": 1})"}) {
    EXPECT_FALSE(ReadPlacement(body)) << body;
  }
}

}  // namespace
}  // namespace trailcast::console
