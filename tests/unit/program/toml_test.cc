#include "services/program/toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace trailcast::program {
namespace {

using testing::HasSubstr;

std::vector<CLI::ConfigItem> ItemsOf(const std::string& text) {
  std::istringstream stream(text);
  return Toml().from_config(stream);
}

TEST(Toml, FilesOfOtherSystemsAreRead) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const std::string& text :
       {std::string("name = 'a'\nrate = 5 # Hz\n"), mark + "name = 'a'\r\nrate = 5 # Hz\r\n",
        std::string("name = 'a'\rrate = 5 # Hz\r")}) {
    const auto items = ItemsOf(text);
    ASSERT_EQ(items.size(), 2U) << text;
    EXPECT_EQ(items[0].name, "name");
    EXPECT_EQ(items[0].inputs, std::vector<std::string>{"a"});
    EXPECT_EQ(items[1].name, "rate");
    EXPECT_EQ(items[1].inputs, std::vector<std::string>{"5"});
  }
}

std::string ErrorOf(const std::string& text) {
  try {
    (void)ItemsOf(text);
  } catch (const CLI::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Toml, AKeyThatASectionHasTwiceIsNamed) {
  EXPECT_THAT(ErrorOf("name = 'a'\nrate = 5\nname = 'b'\n"), HasSubstr("'name' twice: keep one"));
  EXPECT_THAT(ErrorOf("[teach]\nrate = 5\nup = 1\n  rate=6 # Hz\n"),
              HasSubstr("'rate' twice in [teach]"));
  EXPECT_THAT(ErrorOf("[teach]\nrate = 5\n[replay]\nup = 1\n[teach]\nrate = 5\n"),
              HasSubstr("'rate' twice in [teach]"));
  EXPECT_EQ(ErrorOf("rate = 5\n[teach]\nrate = 5\n[replay]\nrate = 5\n#rate = 6\n"), "no error");
}

TEST(Toml, AFileInUtf16IsRefusedByName) {
  const std::string wide(
      "\xFF\xFEn\0=\0"
      "1\0",
      8);
  EXPECT_THAT(ErrorOf(wide), HasSubstr("UTF-16"));
  EXPECT_THAT(ErrorOf(std::string("\xFF\xFE\0\0n\0\0\0", 8)), HasSubstr("UTF-32"));
}

TEST(Toml, AFileWithoutEndIsNotReadToIt) {
  std::ifstream endless("/dev/zero");
  EXPECT_THROW((void)Toml().from_config(endless), CLI::ConfigError);
}

}  // namespace
}  // namespace trailcast::program
