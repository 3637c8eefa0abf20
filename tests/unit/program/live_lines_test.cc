#include "services/program/live_lines.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "tests/support/temp_dir.h"

namespace trailcast::program {
namespace {

TEST(ProgressBar, FillsFromTheLeftAndStaysWithinItsWidth) {
  EXPECT_EQ(ProgressBar(0.0, 4), "[    ]");
  EXPECT_EQ(ProgressBar(0.5, 4), "[=>  ]");
  EXPECT_EQ(ProgressBar(1.0, 4), "[====]");
  EXPECT_EQ(ProgressBar(7.0, 4), "[====]");
  EXPECT_EQ(ProgressBar(std::nan(""), 4), "[    ]");
}

// LiveLines writes this to a file, which is no terminal.
TEST(LiveLines, OffATerminalALineIsNotRepeatedBeforeItsTimeButForTheLast) {
  const test::TempDir folder;
  const std::filesystem::path file = folder / "out.txt";
  {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.c_str(), "w"),
                                                              &std::fclose);
    LiveLines live(out.get(), std::chrono::hours(1));
    live.Show({"first"});
    live.Show({"too soon"});
    live.Show({"last"}, true);
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "r"),
                                                           &std::fclose);
  char text[64] = {};
  const std::size_t count = std::fread(text, 1, sizeof text - 1, in.get());
  EXPECT_EQ(std::string(text, count), "first\nlast\n");
}

}  // namespace
}  // namespace trailcast::program
