// "Where am I?", asked of a server with a picture. The recorded run is from ../shared/data;
// skipped, visibly, where that is absent.
#include <algorithm>

#include "tests/scenario/recorded_runs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class WhereTest : public RecordedRunsTest {
 protected:
  Ended Where(const Words& words) {
    return End(*Start("trailcast", With({"where"}, words), "where"));
  }
  // The frames of a recorded run, in order.
  static std::vector<std::filesystem::path> Frames(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> frames;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      frames.push_back(entry.path());
    }
    std::sort(frames.begin(), frames.end());
    return frames;
  }
};

TEST_F(WhereTest, APictureOfATaughtWalkTellsTheRouteAndOneOfAnotherWorldNone) {
  const auto server = Server();
  const auto scout =
      RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
  ASSERT_EQ(scout.status, 0) << scout.output;
  WriteWalk(folder_ / "later", 1, 160, 120, 60);
  const std::string frame = Frames(folder_ / "later").front();
  const auto found = Where({"--frame", frame});
  EXPECT_EQ(found.status, 0) << found.output;
  EXPECT_THAT(found.output, testing::ContainsRegex("route hall [0-9a-f]+@1, segment "));
  const auto json = Where({"--frame", frame, "--json"});
  EXPECT_THAT(json.output, AllOf(HasSubstr("\"name\": \"hall\""), HasSubstr("\"routes_unseen\"")));

  // Upside down it is another world.
  image::GrayImage elsewhere = WalkFrame(60);
  std::reverse(elsewhere.pixels.begin(), elsewhere.pixels.end());
  ASSERT_TRUE(image::WritePng(elsewhere, folder_ / "elsewhere.png"));
  const auto none = Where({"--frame", Path("elsewhere.png")});
  EXPECT_EQ(none.status, 0) << none.output;
  EXPECT_THAT(none.output, HasSubstr("segments looks like this"));
}

TEST_F(WhereTest, WhatIsNoPictureOrShowsNothingIsSaid) {
  std::ofstream(folder_ / "notes.txt") << "not a picture";
  const auto notes = Where({"--frame", Path("notes.txt")});
  EXPECT_EQ(notes.status, 1);
  EXPECT_THAT(notes.output, HasSubstr("notes.txt"));
  const image::GrayImage blank{160, 120, std::vector<std::uint8_t>(std::size_t{160} * 120, 90)};
  ASSERT_TRUE(image::WritePng(blank, folder_ / "blank.png"));
  const auto nothing = Where({"--frame", Path("blank.png")});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_THAT(nothing.output, HasSubstr("shows too little to be recognised: 0 features"));
}

TEST_F(WhereTest, ADonkeyCarOnItsSecondLapIsFoundOnTheFirst) {
  if (Absent("donkey_track")) GTEST_SKIP() << "no recorded runs at " << Data("donkey_track");
  const auto server = Server();
  const auto scout =
      RunAgent(With(TeachWords(Data("donkey_track") / "teach", "scout.db"), {"--server"}));
  ASSERT_EQ(scout.status, 0) << scout.output;
  const auto frames = Frames(Data("donkey_track") / "replay");
  int found = 0;
  constexpr int kAsked = 8;
  for (int i = 0; i < kAsked; ++i) {
    const auto& frame = frames[frames.size() * static_cast<std::size_t>(i) / kAsked];
    const auto answer = Where({"--frame", frame});
    EXPECT_EQ(answer.status, 0) << answer.output;
    found += answer.output.find("route hall ") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(found, kAsked - 2);
}

}  // namespace
}  // namespace trailcast::test
