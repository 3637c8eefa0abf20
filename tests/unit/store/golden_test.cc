#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "services/store/route_store.h"
#include "tests/support/places.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/golden_route.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

const fs::path kFile = fs::path(SourceDir()) / "tests/golden/routes-v7.db";

class StoreGolden : public testing::Test {
 protected:
  void SetUp() override {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread runs here.
    if (std::getenv("TRAILCAST_WRITE_GOLDEN") != nullptr) {
      fs::remove(kFile);
      FillWithGolden(*OpenSqliteStore(kFile).value());
      GTEST_SKIP() << "wrote " << kFile << "; see tests/golden/README.md before committing it";
    }
    fs::copy_file(kFile, file_);
    fs::permissions(file_, fs::perms::owner_all);
  }

  test::TempDir folder_;
  const fs::path file_ = folder_ / "routes.db";
};

TEST_F(StoreGolden, WhatTheFileHoldsIsRead) {
  const auto store = OpenSqliteStore(file_);
  ASSERT_TRUE(store) << store.error().message;
  ExpectGolden(**store);
}

}  // namespace
}  // namespace trailcast::store
