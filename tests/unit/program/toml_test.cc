#include "services/program/toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Toml, AFileInUtf16IsRefusedByName) {
  const std::string wide(
      "\xFF\xFEn\0=\0"
      "1\0",
      8);
  try {
    (void)ItemsOf(wide);
    FAIL() << "it was read";
  } catch (const CLI::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("UTF-16"));
  }
}

}  // namespace
}  // namespace trailcast::program
