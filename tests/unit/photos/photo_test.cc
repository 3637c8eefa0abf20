#include "services/photos/photo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "tests/unit/photos/a_photo.h"

namespace trailcast::photos {
namespace {

using testing::HasSubstr;

TEST(Photo, IsTheSameAsWords) {
  Photo photo = APhoto('a', SomeJpeg(1000));
  EXPECT_EQ(*ParsePhoto(ToText(photo)), photo);
  photo.place = "dock";
  photo.sure = false;
  photo.backwards = true;
  photo.taken_unix_ms = -1;
  EXPECT_EQ(*ParsePhoto(ToText(photo)), photo);
  EXPECT_EQ(*ParsePhoto(ToText(photo) + " and words of a later version"), photo);
}

TEST(Photo, AsWordsFitsIntoALineHoweverLongItsNamesAre) {
  Photo photo = APhoto('a', SomeJpeg(1000));
  const std::string longest(64, 'n');
  photo.robot = AgentId(longest);
  photo.mission = photo.route = photo.place = longest;
  photo.revision = ~0U;
  photo.along_m = photo.spot_m = 1e7;
  photo.taken_unix_ms = std::numeric_limits<std::int64_t>::min();
  photo.width_px = photo.height_px = 65535;
  photo.backwards = true;
  photo.sure = false;
  EXPECT_LE(ToText(photo).size(), exchange::kMaxLineBytes);
}

TEST(Photo, ThatIsWronglyDescribedIsRefused) {
  const std::string good = ToText(APhoto('a', SomeJpeg(1000)));
  const auto with = [&](const std::string& was, const std::string& is) {
    std::string words = good;
    words.replace(words.find(was), was.size(), is);
    return words;
  };
  for (const std::string& words :
       {std::string(), std::string("dance"), good.substr(0, good.size() - 1),
        with("aaaaaaaaaaaaaaaa", "../aaaaaaaaaaaaa"), with("robot2", "ro/bot"),
        with("12.61", "nan"), with("12.50", "-1"), with("640", "0"), with("480", "65536"),
        with(" 1000 ", " 0 "), with(" 3 ", " -3 ")}) {
    const auto parsed = ParsePhoto(words);
    ASSERT_FALSE(parsed) << words;
    EXPECT_EQ(parsed.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(parsed.error().message, HasSubstr("describes no photo"));
  }
}

TEST(Photo, IsOfOneSpotWithThoseOfItsPlaceOrOfTheSameMetres) {
  Photo here = APhoto('a', SomeJpeg(10));
  Photo there = here;
  EXPECT_EQ(SpotText(here), "hall@12.5");
  there.spot_m += 0.2;
  EXPECT_TRUE(AreOfOneSpot(here, there));
  there.spot_m += 0.2;
  EXPECT_FALSE(AreOfOneSpot(here, there));
  here.place = there.place = "dock";
  EXPECT_TRUE(AreOfOneSpot(here, there)) << "the place has moved";
  EXPECT_EQ(SpotText(here), "dock");
  here = there = APhoto('a', SomeJpeg(10));
  there.route = "yard";
  EXPECT_FALSE(AreOfOneSpot(here, there));
}

TEST(PhotoQuery, IsTheSameAsWordsAndNarrowsByAllThatItHas) {
  const Photo photo = APhoto('a', SomeJpeg(10));
  EXPECT_TRUE(Matches({}, photo));
  const PhotoQuery query{.id = photo.id,
                         .robot = "robot2",
                         .mission = "4f2a09c1",
                         .route = "hall",
                         .spot_m = 12.6,
                         .from_unix_ms = photo.taken_unix_ms};
  EXPECT_TRUE(Matches(query, photo));
  EXPECT_EQ(*ParsePhotoQuery(ToText(query)), query);
  EXPECT_EQ(*ParsePhotoQuery("photos"), PhotoQuery());
  for (const PhotoQuery& other :
       {PhotoQuery{.id = std::string(16, 'b')}, PhotoQuery{.robot = "robot1"},
        PhotoQuery{.mission = "m"}, PhotoQuery{.route = "yard"}, PhotoQuery{.place = "dock"},
        PhotoQuery{.spot_m = 13.0}, PhotoQuery{.from_unix_ms = photo.taken_unix_ms + 1}}) {
    EXPECT_FALSE(Matches(other, photo)) << ToText(other);
  }
  EXPECT_TRUE(AsksForPhotos("photos mission m"));
  EXPECT_FALSE(AsksForPhotos("photosynthesis"));
  EXPECT_THAT(ParsePhotoQuery("photos colour red").error().message, HasSubstr("'colour'"));
  EXPECT_THAT(ParsePhotoQuery("photos robot").error().message, HasSubstr("a name"));
  EXPECT_THAT(ParsePhotoQuery("photos spot far").error().message, HasSubstr("metres"));
}

TEST(PhotoQuery, OfAPlaceIsItsNameOrMetresAlongARoute) {
  EXPECT_EQ(AtPlace({}, "dock")->place, "dock");
  const auto hall = AtPlace({.robot = "r"}, "hall@12.5");
  ASSERT_TRUE(hall);
  EXPECT_EQ(hall->route, "hall");
  EXPECT_EQ(hall->spot_m, 12.5);
  EXPECT_EQ(hall->robot, "r");
  for (const char* wrong : {"", "a b", "hall@", "@3", "hall@nan"}) {
    EXPECT_FALSE(AtPlace({}, wrong)) << wrong;
  }
}

}  // namespace
}  // namespace trailcast::photos
