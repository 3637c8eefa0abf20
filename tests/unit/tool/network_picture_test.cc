#include "services/tool/network_picture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::tool {
namespace {

using plot::NetworkPicture;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(NetworkPictureOf, HasWhatTheServerLists) {
  const auto picture = PictureOf({"route office 10.00", "route hall 20.00",
                                  "join hall@12 office@0 both", "unused join hall@1@15 office@9",
                                  "close hall 3..7", "back hall 8..9", "limit office speed 0.5",
                                  "name loading-bay office@8", "unused name attic attic@1@3",
                                  "proposed join office@3 hall@4 both confidence 0.93",
                                  "lost office 5..10 1 of 1 cost 2.3", "what a later server says"});
  ASSERT_TRUE(picture);
  ASSERT_THAT(picture->routes, SizeIs(2));
  EXPECT_EQ(picture->routes[1].name, "office");
  EXPECT_EQ(picture->routes[1].length_m, 10.0);
  ASSERT_THAT(picture->routes[0].marked, SizeIs(2));
  EXPECT_EQ(picture->routes[0].marked[1].part, NetworkPicture::Part::kBacked);
  EXPECT_EQ(picture->routes[0].marked[0].part, NetworkPicture::Part::kClosed);
  EXPECT_EQ(picture->routes[0].marked[0].from_m, 3.0);
  ASSERT_THAT(picture->routes[1].marked, SizeIs(2));
  EXPECT_EQ(picture->routes[1].marked[0].to_m, 10.0) << "up to its end";
  EXPECT_EQ(picture->routes[1].marked[1].part, NetworkPicture::Part::kLost);
  EXPECT_EQ(picture->routes[1].marked[1].from_m, 5.0);
  ASSERT_THAT(picture->junctions, SizeIs(3));
  EXPECT_TRUE(picture->junctions[0].both && picture->junctions[0].used);
  EXPECT_EQ(picture->junctions[0].from.along_m, 12.0);
  EXPECT_EQ(picture->junctions[0].to.route, 1U);
  EXPECT_FALSE(picture->junctions[1].used);
  EXPECT_EQ(picture->junctions[1].from.route, 0U) << "another revision's, on the row of this one";
  EXPECT_FALSE(picture->junctions[2].used);
  EXPECT_EQ(picture->junctions[2].to.along_m, 4.0);
  ASSERT_THAT(picture->names, SizeIs(1));
  EXPECT_EQ(picture->names[0].name, "loading-bay");
}

TEST(NetworkPictureOf, NothingAndTooMuchAreRefused) {
  EXPECT_EQ(PictureOf({}).error().code, ErrorCode::kNotFound);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i <= kMostRoutesInPicture; ++i) {
    lines.push_back(fmt::format("route r{} 3.00", i));
  }
  EXPECT_THAT(PictureOf(lines).error().message, HasSubstr("--json"));
  lines.pop_back();
  EXPECT_THAT(PictureOf(lines).value().junctions, IsEmpty());
}

}  // namespace
}  // namespace trailcast::tool
