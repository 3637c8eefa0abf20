#include "agent/session/frame_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Observation Frame(int width, int height) {
  const std::size_t pixels = image::PixelIndex(0, height, width);
  Observation observation;
  observation.image = {width, height, std::vector<std::uint8_t>(pixels, 100)};
  return observation;
}

TEST(FrameCheck, PicturesTooSmallToSeeAnythingInAreRefusedInWords) {
  for (const auto& frame : {Frame(1, 1), Frame(160, 1), Frame(2, 2), Frame(7, 400)}) {
    const auto checked = FrameCheck().Check(frame);
    ASSERT_FALSE(checked) << frame.image.width;
    EXPECT_THAT(checked.error().message, AllOf(HasSubstr("pixels"), HasSubstr("at least 8")));
  }
  EXPECT_TRUE(FrameCheck().Check(Frame(8, 8)));
}

TEST(FrameCheck, AFrameOfAnotherSizeThanTheFirstIsNamedWithBoth) {
  FrameCheck check;
  ASSERT_TRUE(check.Check(Frame(16, 12)));
  const auto checked = check.Check(Frame(12, 16));
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, AllOf(HasSubstr("12x16"), HasSubstr("16x12")));
}

}  // namespace
}  // namespace trailcast::agent
