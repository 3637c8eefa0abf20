#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "services/store/route_store.h"
#include "tests/support/places.h"
#include "tests/support/postgres_server.h"
#include "tests/unit/store/golden_route.h"

namespace trailcast::store {
namespace {

const std::filesystem::path kFile =
    std::filesystem::path(SourceDir()) / "tests/golden/routes-postgres-v4.sql";

// Without the comments and the words to psql that pg_dump puts around the SQL.
void WriteGolden(const std::string& url) {
  FillWithGolden(*OpenPostgresStore(url).value());
  const std::string dump = "pg_dump --inserts --no-owner '" + url +
                           R"(' | grep -v -e '^--' -e '^$' -e '^\\' > ')" + kFile.string() + "'";
  // NOLINTNEXTLINE(concurrency-mt-unsafe,cert-env33-c): no other thread runs here.
  ASSERT_EQ(std::system(dump.c_str()), 0) << dump;
}

TEST(PostgresGolden, WhatTheDumpHoldsIsRead) {
  const std::string url = test::PostgresServer::Shared().CreateDatabase();
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread runs here.
  if (std::getenv("TRAILCAST_WRITE_GOLDEN") != nullptr) {
    WriteGolden(url);
    GTEST_SKIP() << "wrote " << kFile << "; see tests/golden/README.md before committing it";
  }
  std::ifstream in(kFile);
  test::PostgresServer::Execute(
      url, {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
  const auto store = OpenPostgresStore(url);
  ASSERT_TRUE(store) << store.error().message;
  ExpectGolden(**store);
}

}  // namespace
}  // namespace trailcast::store
