#include "services/lab/trial/recording/ordered_frames.h"

#include <gmock/gmock.h>

#include "tests/support/temp_dir.h"

namespace trailcast::trial {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A recording whose frame i is grey level 10 i all over.
class OrderedFramesTest : public testing::Test {
 protected:
  OrderedFramesTest() {
    for (int i = 0; i < 5; ++i) {
      const image::GrayImage frame{4, 3, std::vector<std::uint8_t>(12, 10 * i)};
      const auto written = image::WritePng(frame, folder_ / (std::to_string(i) + ".png"));
      if (!written) throw std::runtime_error(written.error().message);
    }
  }
  std::vector<int> GreysIn(const std::vector<int>& order) {
    std::vector<Shown> shown;
    for (const int frame : order) shown.push_back({frame, false});
    auto frames = OrderedFrames::Open(folder_.path(), shown);
    if (!frames) throw std::runtime_error(frames.error().message);
    std::vector<int> greys;
    while (true) {
      const auto frame = frames->Next();
      if (!frame) throw std::runtime_error(frame.error().message);
      if (!*frame) return greys;
      greys.push_back((*frame)->at(0, 0));
    }
  }
  test::TempDir folder_;
};

TEST_F(OrderedFramesTest, CountsThem) { EXPECT_EQ(CountFrames(folder_.path()).value_or(-1), 5); }

TEST_F(OrderedFramesTest, ForwardWithGapsAndRepeats) {
  EXPECT_THAT(GreysIn({0, 0, 2, 4}), ElementsAre(0, 0, 20, 40));
}

TEST_F(OrderedFramesTest, ToAndFro) {
  EXPECT_THAT(GreysIn({4, 2, 3, 0, 4}), ElementsAre(40, 20, 30, 0, 40));
}

TEST_F(OrderedFramesTest, ForAFrameThatCannotBeReadTheNextStandsIn) {
  for (const char* damaged : {"1.png", "4.png"}) std::filesystem::resize_file(folder_ / damaged, 3);
  EXPECT_THAT(GreysIn({0, 1, 2, 3, 4}), ElementsAre(0, 20, 20, 30, 30));
  EXPECT_THAT(GreysIn({4, 1, 2}), ElementsAre(30, 20, 20));
  auto frames = OrderedFrames::Open(folder_.path(), {{0, false}, {4, false}});
  ASSERT_TRUE(frames);
  while (frames->Next().value()) {
  }
  EXPECT_THAT(frames->TakeNews(), ElementsAre(HasSubstr("2 of 5 pictures cannot be read")));
}

TEST_F(OrderedFramesTest, OfNothingThereIsNothing) { EXPECT_TRUE(GreysIn({}).empty()); }

TEST_F(OrderedFramesTest, AFrameThatIsNotThereIsAnError) {
  auto forward = OrderedFrames::Open(folder_.path(), {{5, false}});
  ASSERT_TRUE(forward);
  const auto frame = forward->Next();
  ASSERT_FALSE(frame);
  EXPECT_THAT(frame.error().message, HasSubstr("ends before frame 5, at frame 5"));
  EXPECT_FALSE(OrderedFrames::Open(folder_.path(), {{7, false}, {1, false}}));
  EXPECT_FALSE(CountFrames(folder_ / "absent"));
}

}  // namespace
}  // namespace trailcast::trial
