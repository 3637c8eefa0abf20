#include "services/tool/diff_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::tool {
namespace {

using testing::AllOf;
using testing::HasSubstr;

route::RouteInfo Revision(const std::string& name, char id, unsigned number) {
  route::RouteInfo info;
  info.key.route = RouteId(std::string(32, id));
  info.name = name;
  info.revision = RevisionNumber(number);
  info.length_m = 12.0;
  info.bytes = 60'000;
  return info;
}

// Twelve metres, of which less stayed from the fourth to the seventh, aside of the first's path.
junctions::Comparison Found() {
  junctions::Comparison found{.length = 12.0, .parts = {}};
  for (int i = 0; i < 12; ++i) {
    const bool changed = i >= 4 && i < 7;
    found.parts.push_back({1.0 * i, i + 1.0, i + 0.5, i + 1.5, 40, changed ? 5 : 30,
                           changed ? 20 : 2, 36, changed ? -0.5 : 0.02});
  }
  return found;
}

TEST(DiffReport, TellsTheSectionsThatDifferAndSumsUp) {
  const RouteDiff diff{Revision("hall", 'a', 1), Revision("hall", 'a', 3), Found()};
  EXPECT_EQ(
      DiffText(diff),
      "        hall@1 [m]          hall@3 [m]  stayed   went   came  path moved\n"
      "          4.0..7.0            4.5..7.5    12 %    105     60  0.5 m right\n"
      "hall@3 goes the way of hall@1 for 12.0 of its 12.0 m: 59 % of 480 features stayed, 195 "
      "went, 78 came; 12.0 m, 60 kB and 12.0 m, 60 kB\n");
  const auto json = DiffJson(diff);
  EXPECT_EQ(json["refreshed"], false);
  EXPECT_EQ(json["b"]["name"], "hall");
  EXPECT_EQ(json["differing"].dump(),
            R"([{"begin":4.0,"end":7.0,"begin_b":4.5,"end_b":7.5,"features":120,"stayed":15,)"
            R"("went":105,"came":60,"aside_m":-0.5}])");
}

TEST(DiffReport, SaysThatNothingDiffersOrThatTheyGoOtherWays) {
  RouteDiff diff{Revision("hall", 'a', 1), Revision("hall", 'a', 2), Found()};
  diff.found.refreshed = true;
  diff.found.parts.resize(4);
  EXPECT_THAT(DiffText(diff), AllOf(HasSubstr("no section differs more than the others\n"),
                                    HasSubstr("hall@2 has the path of hall@1: 75 % of 160")));
  diff.found.parts.clear();
  diff.found.refreshed = false;
  diff.b = Revision("hall", 'b', 1);
  EXPECT_EQ(DiffText(diff),
            "bbbbbbb@1 does not go the way of aaaaaaa@1: 12.0 m, 60 kB and 12.0 m, 60 kB\n");
  const auto drawn = DrawDiff(diff);
  ASSERT_FALSE(drawn);
  EXPECT_THAT(drawn.error().message, HasSubstr("does not go the way of"));
}

TEST(DiffReport, IsDrawnWithAStripForThePathWhereThatIsKnown) {
  RouteDiff diff{Revision("hall", 'a', 1), Revision("hall", 'a', 3), Found()};
  const auto moved = DrawDiff(diff);
  ASSERT_TRUE(moved) << moved.error().message;
  for (junctions::Part& part : diff.found.parts) part.aside_m.reset();
  const auto flat = DrawDiff(diff);
  ASSERT_TRUE(flat) << flat.error().message;
  EXPECT_GT(moved->height(), flat->height() + 100);
  // The band of what differs lies behind the curves of both strips.
  const image::RgbImage picture = flat->Render();
  const auto is_band = [&](int x) {
    const std::uint8_t* const pixel =
        &picture.pixels[3 * static_cast<std::size_t>(150 * picture.width + x)];
    return pixel[0] > 240 && pixel[2] < 200;
  };
  EXPECT_TRUE(is_band(62 + 1016 * 5 / 12 + 20));
  EXPECT_FALSE(is_band(62 + 1016 * 9 / 12 + 20));
}

}  // namespace
}  // namespace trailcast::tool
