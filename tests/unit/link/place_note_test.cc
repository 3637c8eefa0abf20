#include "agent/link/place_note.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/pieces.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

class PlaceNoteTest : public testing::Test {
 protected:
  void Overwrite(const std::string& text) { std::ofstream(file_) << text; }
  [[nodiscard]] std::string Text() const {
    std::ifstream stream(file_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void ExpectCorrupt(const std::string& text) {
    Overwrite(text);
    const auto read = note_.Read();
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
    EXPECT_THAT(read.error().message, testing::HasSubstr(file_.string()));
  }
  test::TempDir folder_;
  std::filesystem::path file_ = folder_ / "robot.db.place";
  PlaceNote note_{file_};
  NotedPlace place_{test::KeyNumber(7, 3), 12.345, 0.75, 1700000000123};
};

TEST_F(PlaceNoteTest, TellsTheNextRunWhatTheLastOneNoted) {
  ASSERT_TRUE(note_.Write({test::KeyNumber(1), 1.0, 1.0, 1}));
  ASSERT_TRUE(note_.Write(place_));
  const auto read = PlaceNote(file_).Read();
  ASSERT_TRUE(read && *read) << read.error().message;
  EXPECT_EQ((*read)->key, place_.key);
  EXPECT_DOUBLE_EQ((*read)->along_m, 12.345);
  EXPECT_DOUBLE_EQ((*read)->magnification, 0.75);
  EXPECT_EQ((*read)->unix_ms, 1700000000123);
}

TEST_F(PlaceNoteTest, IsNothingWhenNoneWasLeftOrTheRobotArrived) {
  EXPECT_EQ(note_.Read().value().has_value(), false);
  EXPECT_TRUE(note_.Remove()) << "nothing to remove is fine";
  ASSERT_TRUE(note_.Write(place_));
  ASSERT_TRUE(note_.Remove());
  EXPECT_EQ(note_.Read().value().has_value(), false);
}

TEST_F(PlaceNoteTest, RefusesWhateverItDidNotWrite) {
  ASSERT_TRUE(note_.Write(place_));
  const std::string good = Text();
  for (std::size_t length = 0; length + 14 < good.size(); ++length) {
    ExpectCorrupt(good.substr(0, length));
  }
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  ExpectCorrupt(with("12.345", "-1"));
  ExpectCorrupt(with("12.345", "nan"));
  ExpectCorrupt(with("12.345", "1e300"));
  ExpectCorrupt(with("0.75", "0"));
  ExpectCorrupt(with("place 1", "place 2"));
  ExpectCorrupt(with("teaching 3", "teaching 0"));
  ExpectCorrupt(std::string(100'000, 'x'));
}

TEST_F(PlaceNoteTest, SaysWhichFileCannotBeWritten) {
  const auto written = PlaceNote(folder_ / "nowhere" / "robot.place").Write(place_);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, testing::HasSubstr("robot.place"));
}

}  // namespace
}  // namespace trailcast::agent
