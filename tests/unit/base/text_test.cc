#include "services/base/text.h"

#include <gtest/gtest.h>

namespace trailcast {
namespace {

TEST(IsPlainText, AcceptsWordsOfAnyLanguageUpToTheLimit) {
  EXPECT_TRUE(IsPlainText("", 0));
  EXPECT_TRUE(IsPlainText("webcam 320x240", 14));
  EXPECT_TRUE(IsPlainText("F\xC3\xA4hre \xE6\xBC\xA2 \xF0\x9F\x9A\xA2", 64));
  EXPECT_FALSE(IsPlainText("webcam 320x240", 13));
}

TEST(IsPlainText, RefusesWhatATerminalWouldObey) {
  EXPECT_FALSE(IsPlainText("\x1B[2J", 64));
  EXPECT_FALSE(IsPlainText("two\nlines", 64));
  EXPECT_FALSE(IsPlainText("\x7F", 64));
  EXPECT_FALSE(IsPlainText("\xC2\x9B 2J", 64));  // C1 control sequence introducer
}

TEST(IsPlainText, RefusesMalformedUtf8) {
  for (const char* bad : {"\x80", "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80",
                          "\xF0\x80\x80\xAF", "\xF4\x90\x80\x80", "\xFF", "a\xE6\xBC"}) {
    EXPECT_FALSE(IsPlainText(bad, 64)) << bad;
  }
}

TEST(PlainText, MakesAnythingPassAndKeepsWhatPassed) {
  EXPECT_EQ(PlainText("as it was", 64), "as it was");
  EXPECT_EQ(PlainText("two\nlines\xFF", 64), "two lines ");
  EXPECT_EQ(PlainText("ab\xC3\xA4", 3), "ab");  // no half characters
}

TEST(WordsIn, SplitsAtAnyNumberOfSpaces) {
  EXPECT_EQ(WordsIn("  follow hall   3..10 "),
            (std::vector<std::string>{"follow", "hall", "3..10"}));
  EXPECT_TRUE(WordsIn("   ").empty());
  EXPECT_TRUE(WordsIn("").empty());
}

}  // namespace
}  // namespace trailcast
