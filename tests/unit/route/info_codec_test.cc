#include "services/route/info_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/taught_route.h"

namespace trailcast::route {
namespace {

RouteInfo EveryField() {
  RouteInfo info = test::TeachSamples(2).info;
  info.key.teaching = TeachingId(77);
  info.state = RouteState::kTeaching;
  info.cut_off = true;
  info.description = "past the greenhouse";
  info.standing = Standing::kRetired;
  info.to_review = true;
  info.edition = 4'000'000'000;
  info.refreshes = RevisionNumber(12);
  return info;
}

TEST(InfoCodec, EveryFieldComesBack) {
  for (RouteInfo info : {EveryField(), test::TeachSamples(2).info}) {
    EXPECT_EQ(DecodeInfo(EncodeInfo(info)).value(), info);
    info.place.reset();
    info.revision = {};
    EXPECT_EQ(DecodeInfo(EncodeInfo(info)).value(), info);
  }
}

TEST(InfoCodec, WhatNoRouteCanBeIsCorruptNamingTheField) {
  const auto message = [](auto&& spoil) {
    RouteInfo info = EveryField();
    spoil(info);
    const auto decoded = DecodeInfo(EncodeInfo(info));
    if (decoded) return std::string();
    EXPECT_EQ(decoded.error().code, ErrorCode::kCorrupt);
    return decoded.error().message;
  };
  using testing::HasSubstr;
  EXPECT_THAT(message([](auto& i) { i.name = "my hall"; }), HasSubstr("route name"));
  EXPECT_THAT(message([](auto& i) { i.key.route = RouteId("hall"); }), HasSubstr("route id"));
  EXPECT_THAT(message([](auto& i) { i.image_width_px = 65536; }), HasSubstr("image width"));
  EXPECT_THAT(message([](auto& i) { i.standing = static_cast<Standing>(9); }),
              HasSubstr("standing"));
  EXPECT_THAT(message([](auto& i) { i.tags = {"b", "a"}; }), HasSubstr("tags"));
  EXPECT_THAT(message([](auto& i) { i.place->x = 1e9; }), HasSubstr("longitude"));
}

}  // namespace
}  // namespace trailcast::route
