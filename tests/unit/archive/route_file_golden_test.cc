#include <gtest/gtest.h>

#include <cstdlib>

#include "services/archive/route_file_writer.h"
#include "services/base/hex.h"
#include "tests/support/places.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/archive/made_file.h"

namespace trailcast::archive {
namespace {

const std::filesystem::path kFile =
    std::filesystem::path(SourceDir()) / "tests/golden/route-v2.trailcast";

void Write(const std::filesystem::path& file) {
  const test::TaughtRoute taught = test::TeachSamples(2);
  auto writer = RouteFileWriter::Create(file, taught.info, RouteFileWriter::Existing::kReplace);
  ASSERT_TRUE(writer) << writer.error().message;
  for (const auto& piece : taught.pieces) ASSERT_TRUE(writer->Add(piece));
  ASSERT_TRUE(writer->Finish());
}

class RouteFileGolden : public testing::Test {
 protected:
  void SetUp() override {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread runs here.
    if (std::getenv("TRAILCAST_WRITE_GOLDEN") == nullptr) return;
    Write(kFile);
    GTEST_SKIP() << "wrote " << kFile << "; see tests/golden/README.md before committing it";
  }
};

TEST_F(RouteFileGolden, KnownRouteIsWrittenAsTheFileByteForByte) {
  const test::TempDir folder;
  Write(folder / "route.trailcast");
  EXPECT_EQ(ReadFile(folder / "route.trailcast"), ReadFile(kFile));
}

TEST_F(RouteFileGolden, FileIsReadAsTheKnownRoute) {
  const auto file = RouteFile::Open(kFile);
  ASSERT_TRUE(file) << file.error().message;
  const test::TaughtRoute taught = test::TeachSamples(2);
  EXPECT_EQ(file->info(), taught.info);
  for (const auto& piece : taught.pieces) EXPECT_EQ(file->ReadSegment(piece.index).value(), piece);
}

// Written out here so that regenerating the file by mistake does not go unseen.
TEST_F(RouteFileGolden, DigestIsTheOneOfVersion2) {
  EXPECT_EQ(ToHex(route::Sha256(ReadFile(kFile))),
            "b65af15af3b0de01805c0fb586a0a1bfe12f193b80ae9ee68d84c011e349ea3b");
}

}  // namespace
}  // namespace trailcast::archive
