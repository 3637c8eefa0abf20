#include "tests/support/temp_dir.h"
#include "tests/unit/store/query_contract.h"
#include "tests/unit/store/route_store_contract.h"

namespace trailcast::store {
namespace {

class SqliteHome final : public StoreHome {
 public:
  Result<std::unique_ptr<RouteStore>> Open() override {
    return OpenSqliteStore(dir_ / "routes.db");
  }

 private:
  test::TempDir dir_;
};

std::unique_ptr<StoreHome> MakeSqliteHome() { return std::make_unique<SqliteHome>(); }

INSTANTIATE_TEST_SUITE_P(Sqlite, RouteStoreContract, testing::Values(&MakeSqliteHome));
INSTANTIATE_TEST_SUITE_P(Sqlite, RouteQueryContract, testing::Values(&MakeSqliteHome));

}  // namespace
}  // namespace trailcast::store
