#include "services/base/work_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

namespace trailcast {
namespace {

TEST(WorkFolder, GoesWithAllThatIsInItUnlessItIsToBeKept) {
  std::filesystem::path gone;
  std::filesystem::path kept;
  {
    auto first = WorkFolder::Make();
    auto second = WorkFolder::Make();
    ASSERT_TRUE(first.has_value() && second.has_value());
    gone = first->path();
    kept = second->path();
    EXPECT_NE(gone, kept);
    std::filesystem::create_directories(*first / "deep/er");
    const WorkFolder moved = std::move(*first);
    second->Keep();
    EXPECT_TRUE(std::filesystem::exists(gone));
  }
  EXPECT_FALSE(std::filesystem::exists(gone));
  EXPECT_TRUE(std::filesystem::exists(kept));
  std::filesystem::remove_all(kept);
}

}  // namespace
}  // namespace trailcast
