#include "services/teach/key_view_recorder.h"

#include <gtest/gtest.h>

#include <random>

namespace trailcast::teach {
namespace {

// Features of a long wall, seen through a window that is moved along it.
route::View Window(int from, int count = 60) {
  route::View view;
  for (int i = from; i < from + count; ++i) {
    std::mt19937 random(static_cast<unsigned>(i) + 1U);
    route::ViewFeature& feature = view.emplace_back();
    for (std::uint8_t& byte : feature.descriptor) byte = static_cast<std::uint8_t>(random());
    feature.u_px = 5.0F * static_cast<float>(i - from) - 150.0F;
    feature.v_px = static_cast<float>(random() % 200U) - 100.0F;
    feature.size_px = 1.0F;
  }
  return view;
}

TEST(KeyViewRecorder, KeepsTheFirstViewAndThenOneWhenHalfOfItIsGone) {
  KeyViewRecorder recorder(320);
  std::vector<int> kept;
  for (int at = 0; at < 200; ++at) {
    if (recorder.Add(Window(at))) kept.push_back(at);
  }
  ASSERT_GE(kept.size(), 5U);
  EXPECT_EQ(kept.front(), 0);
  for (std::size_t i = 1; i < kept.size(); ++i) {
    EXPECT_GE(kept[i] - kept[i - 1], 20);
    EXPECT_LE(kept[i] - kept[i - 1], 40);
  }
}

TEST(KeyViewRecorder, KeepingMoreOfEachViewDoesNotMoveThemApart) {
  KeyViewRecorder more(320);
  KeyViewRecorder fewer(320, {.features = KeyViewRecorderOptions{}.compared});
  int views = 0;
  for (int at = 0; at < 300; ++at) {
    const bool kept = more.Add(Window(at, 120));
    EXPECT_EQ(fewer.Add(Window(at, 120)), kept) << at;
    if (!kept) continue;
    ++views;
    EXPECT_EQ(more.kept().size(), KeyViewRecorderOptions{}.features);
    EXPECT_EQ(fewer.kept().size(), KeyViewRecorderOptions{}.compared);
  }
  EXPECT_GE(views, 4);
}

TEST(KeyViewRecorder, KeepsFewFeatures) {
  KeyViewRecorder recorder(320);
  ASSERT_TRUE(recorder.Add(Window(0, 300)));
  EXPECT_EQ(recorder.kept().size(), KeyViewRecorderOptions{}.features);
}

TEST(KeyViewRecorder, KeepsNothingInTheDark) {
  KeyViewRecorder recorder(320);
  EXPECT_FALSE(recorder.Add({}));
  EXPECT_FALSE(recorder.Add(Window(0, 3)));
  EXPECT_FALSE(recorder.Keep(Window(0, 3)));
  EXPECT_TRUE(recorder.Add(Window(0)));
  EXPECT_FALSE(recorder.Add({}));
  EXPECT_EQ(recorder.recognised(), 0.0);
}

TEST(KeyViewRecorder, TellsHowMuchIsRecognised) {
  KeyViewRecorder recorder(320);
  ASSERT_TRUE(recorder.Add(Window(0)));
  ASSERT_FALSE(recorder.Add(Window(0)));
  EXPECT_GT(recorder.recognised(), 0.95);
  ASSERT_TRUE(recorder.Add(Window(1000)));
  EXPECT_LT(recorder.recognised(), 0.1);
}

TEST(KeyViewRecorder, TellsWherePlacesWillNotBeRecognised) {
  KeyViewRecorder recorder(320);
  EXPECT_FALSE(recorder.Add(Window(0, 3)));
  EXPECT_EQ(recorder.weakness(), ViewWeakness::kBland);
  for (int at = 0; at < 100; at += 3) {  // a robot that is not too fast
    static_cast<void>(recorder.Add(Window(at)));
    EXPECT_EQ(recorder.weakness(), ViewWeakness::kNone) << at;
  }
  EXPECT_TRUE(recorder.Add(Window(1000)));
  ASSERT_TRUE(recorder.Add(Window(2000)));
  EXPECT_EQ(recorder.weakness(), ViewWeakness::kUnrelated);
}

}  // namespace
}  // namespace trailcast::teach
