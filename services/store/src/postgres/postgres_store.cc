// This file has PostgresRouteStore as a whole; postgres_routes.cc and postgres_segments.cc have its
// contents.
#include "services/store/src/postgres/postgres_store.h"

#include "services/store/src/postgres/postgres_rows.h"
#include "services/store/src/verify.h"

namespace trailcast::store {

using route::RouteKey;

Result<void> PostgresRouteStore::CheckReachable() {
  return session_->Run(Kind::kRead, "seeing whether it is there",
                       [](Transaction& transaction) -> Result<void> {
                         transaction.exec("SELECT");
                         return {};
                       });
}

Result<void> PostgresRouteStore::Exclusively(const std::function<Result<void>()>& work) {
  return session_->Run(Kind::kWrite, "changing what servers share",
                       [&](Transaction& transaction) -> Result<void> {
                         transaction.exec("SELECT FROM store FOR UPDATE");
                         return work();
                       });
}

Result<std::optional<std::string>> PostgresRouteStore::FindAnswer(const std::string& request) {
  return session_->Run(Kind::kRead, "looking up an answered request",
                       [&](Transaction& transaction) -> Result<std::optional<std::string>> {
                         PostgresValues values;
                         values.Add(request);
                         const pqxx::result rows = values.Execute(
                             transaction, "SELECT answer FROM answer WHERE request = ?");
                         if (rows.empty()) return std::nullopt;
                         return rows[0][0].as<std::string>();
                       });
}

Result<void> PostgresRouteStore::RememberAnswer(const std::string& request,
                                                const std::string& answer) {
  return session_->Run(
      Kind::kWrite, "noting an answered request", [&](Transaction& transaction) -> Result<void> {
        transaction.exec("DELETE FROM answer WHERE answered_at < now() - interval '1 hour'");
        PostgresValues values;
        values.Add(request);
        values.Add(answer);
        (void)values.Execute(transaction,
                             "INSERT INTO answer (request, answer) VALUES (?, ?) "
                             "ON CONFLICT (request) DO NOTHING");
        return {};
      });
}

Result<std::vector<std::string>> PostgresRouteStore::Verify() {
  const auto keys = session_->Run(
      Kind::kRead, "listing what it holds",
      [](Transaction& transaction) -> Result<std::vector<RouteKey>> {
        std::vector<RouteKey> listed;
        for (const pqxx::row& row : transaction.exec(
                 "SELECT route, teaching FROM route UNION SELECT route, teaching FROM tombstone "
                 "UNION SELECT route, teaching FROM segment ORDER BY 1, 2")) {
          listed.push_back(ReadKey(row));
        }
        return listed;
      });
  if (!keys) return tl::unexpected(keys.error());
  std::vector<std::string> damage;
  for (const RouteKey& key : *keys) {
    const Result<void> verified = VerifyRevision(*this, session_->name(), key, damage);
    if (verified) continue;
    if (verified.error().code != ErrorCode::kCorrupt) return tl::unexpected(verified.error());
    damage.push_back(verified.error().message);
  }
  return damage;
}

Result<std::unique_ptr<RouteStore>> OpenPostgresStore(const std::string& url,
                                                      const PostgresOptions& options) {
  const auto access =
      options.read_only ? PostgresSession::Access::kReadOnly : PostgresSession::Access::kReadWrite;
  auto session = PostgresSession::Open(url, access, options.patience);
  if (!session) return tl::unexpected(session.error());
  return std::make_unique<PostgresRouteStore>(std::move(*session));
}

}  // namespace trailcast::store
