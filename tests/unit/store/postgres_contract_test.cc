#include "tests/support/postgres_server.h"
#include "tests/unit/store/query_contract.h"
#include "tests/unit/store/route_store_contract.h"

namespace trailcast::store {
namespace {

class PostgresHome final : public StoreHome {
 public:
  Result<std::unique_ptr<RouteStore>> Open() override { return OpenPostgresStore(url_); }

 private:
  std::string url_ = test::PostgresServer::Shared().CreateDatabase();
};

std::unique_ptr<StoreHome> MakePostgresHome() { return std::make_unique<PostgresHome>(); }

INSTANTIATE_TEST_SUITE_P(Postgres, RouteStoreContract, testing::Values(&MakePostgresHome));
INSTANTIATE_TEST_SUITE_P(Postgres, RouteQueryContract, testing::Values(&MakePostgresHome));

}  // namespace
}  // namespace trailcast::store
