#include "services/fleet/photo_wish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::fleet {
namespace {

using testing::HasSubstr;

Result<std::vector<std::string>> Network() {
  return std::vector<std::string>{"route hall 20", "name dock hall@12", "name bay yard@2@3 home"};
}

TEST(PhotoWish, FindsWhereNamedPlacesAre) {
  const auto wish = PhotoWishFor(5.0, {"dock", "hall@3.5", "bay"}, Network);
  ASSERT_TRUE(wish) << wish.error().message;
  EXPECT_EQ(ToText(*wish), "photo every 5 at dock=hall@12 at hall@3.5 at bay=yard@2@3");
}

TEST(PhotoWish, AsksNoServerWithoutNames) {
  const auto wish = PhotoWishFor(0.0, {"hall@3.5"}, []() -> Result<std::vector<std::string>> {
    ADD_FAILURE() << "nobody is to be asked";
    return std::vector<std::string>();
  });
  ASSERT_TRUE(wish);
  EXPECT_EQ(ToText(*wish), "photo at hall@3.5");
  EXPECT_FALSE(PhotoWishFor(0.0, {}, Network)->any());
}

TEST(PhotoWish, SaysWhatThereIsInPlaceOfAnUnknownName) {
  const auto wish = PhotoWishFor(0.0, {"dok"}, Network);
  ASSERT_FALSE(wish);
  EXPECT_EQ(wish.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(wish.error().message, HasSubstr("'dok': there are bay, dock"));
  EXPECT_EQ(PhotoWishFor(0.0, {"hall@far"}, Network).error().code, ErrorCode::kInvalidArgument);
}

TEST(PhotoWish, GoesIntoOrdersOfAnyKind) {
  const mission::PhotoWish wish{.every_m = 5.0};
  EXPECT_EQ(*OrdersWithPhotos("follow hall ..9 wait 2", wish),
            "photo every 5 follow hall ..9 wait 2");
  EXPECT_EQ(*OrdersWithPhotos("goto bay follow hall 0..9", wish),
            "goto bay photo every 5 follow hall 0..9");
  EXPECT_EQ(*OrdersWithPhotos("photo every 1 follow hall", wish), "photo every 5 follow hall");
  EXPECT_EQ(*OrdersWithPhotos("follow hall", {}), "follow hall");
  EXPECT_THAT(OrdersWithPhotos("follow hall", {.every_m = 0.1}).error().message,
              HasSubstr("0.2 or more"));
  std::string longest = "follow h";
  while (longest.size() < 505) longest += " wait 1";
  EXPECT_THAT(OrdersWithPhotos(longest, wish).error().message, HasSubstr("too long by"));
}

TEST(PhotoWish, GoesIntoSchedulesOfAnyKind) {
  const mission::PhotoWish wish{.every_m = 5.0};
  const auto orders = [&](const char* before, const mission::PhotoWish& asked) {
    const auto with = ScheduleWithPhotos({.orders = before}, asked);
    return with ? with->orders : with.error().message;
  };
  EXPECT_EQ(orders("follow hall", wish), "photo every 5 follow hall");
  EXPECT_EQ(orders("goto office@8", wish), "goto office@8 photo every 5");
  EXPECT_EQ(orders("goto dock photo every 1", wish), "goto dock photo every 5");
  EXPECT_EQ(orders("goto dock photo every 1", {}), "goto dock photo every 1");
  EXPECT_THAT(orders("goto dock", {.every_m = 0.1}), HasSubstr("0.2 or more"));
}

}  // namespace
}  // namespace trailcast::fleet
