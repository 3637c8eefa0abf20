#pragma once

#include <map>
#include <memory>
#include <pqxx/pqxx>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "services/store/route_store.h"
#include "services/store/src/postgres/postgres_session.h"

namespace trailcast::store {

class PostgresValues;

// RouteStore in a PostgreSQL database that several processes may share, made by OpenPostgresStore.
class PostgresRouteStore final : public RouteStore {
 public:
  explicit PostgresRouteStore(std::unique_ptr<PostgresSession> session)
      : session_(std::move(session)) {}

  Result<void> PutRoutes(std::span<const route::RouteInfo> infos) override;
  Result<void> AppendSegments(std::span<const route::SegmentPiece> pieces) override;
  Result<void> DropSegments(const route::RouteKey& key) override;
  Result<route::SegmentPiece> ReadSegment(const route::RouteKey& key, SegmentIndex index) override;
  Result<std::vector<SegmentIndex>> HeldSegments(const route::RouteKey& key) override;
  Result<std::vector<HeldSegment>> SegmentDigests(const route::RouteKey& key) override;
  Result<std::vector<HeldTeaching>> ListHeld(const route::RouteKey& after,
                                             std::size_t most) override;
  Result<std::optional<route::Bytes>> FindContent(const route::Digest& digest) override;
  Result<std::optional<route::RouteInfo>> FindRoute(const route::RouteKey& key) override;
  Result<std::vector<route::RouteInfo>> FindRevisions(const RouteId& route) override;
  Result<std::vector<KnownTeaching>> FindTeachings(const RouteId& route) override;
  Result<std::vector<route::RouteInfo>> FindRoutesWithin(const std::string& id_prefix) override;
  Result<std::vector<route::RouteInfo>> ListRoutes() override;
  Result<std::vector<route::RouteInfo>> FindRoutesByName(const std::string& name) override;
  Result<route::RoutePage> QueryRoutes(const route::RouteQuery& query) override;
  Result<std::vector<std::string>> NamesNear(const std::string& name, std::size_t count) override;
  Result<void> MarkReceipted(const route::RouteKey& key,
                             std::span<const SegmentIndex> indices) override;
  Result<std::vector<SegmentIndex>> UnreceiptedSegments(const route::RouteKey& key) override;
  Result<void> CheckReachable() override;
  [[nodiscard]] bool shared() const override { return true; }
  Result<void> Exclusively(const std::function<Result<void>()>& work) override;
  Result<std::optional<std::string>> FindAnswer(const std::string& request) override;
  Result<void> RememberAnswer(const std::string& request, const std::string& answer) override;
  Result<std::vector<std::string>> Verify() override;

 private:
  using Kind = PostgresSession::Kind;
  using Transaction = pqxx::transaction_base;
  using Keys = std::set<route::RouteKey>;
  using Digests = std::map<std::pair<route::RouteKey, SegmentIndex>, route::Digest>;

  // Keeps other processes from writing of these revisions until the transaction ends.
  static void Lock(Transaction& transaction, const Keys& keys);

  Result<void> Append(Transaction& transaction, std::span<const route::SegmentPiece> pieces);
  [[nodiscard]] Result<void> RefuseBuried(Transaction& transaction, const Keys& keys) const;
  // Returns the digests of those of `pieces` that are held and whole.
  static Digests FindHeld(Transaction& transaction, std::span<const route::SegmentPiece> pieces);
  [[nodiscard]] Result<void> Conflict(const route::SegmentPiece& piece,
                                      const route::Digest& held) const;

  Result<void> Put(Transaction& transaction, std::span<const route::RouteInfo> infos);
  Result<std::vector<SegmentIndex>> SelectIndices(const route::RouteKey& key, bool unreceipted);
  // Returns the rows that `sql`, which selects kRouteColumns, gives for these values.
  Result<std::vector<route::RouteInfo>> SelectRoutes(const PostgresValues& values,
                                                     const std::string& sql);
  [[nodiscard]] Result<std::vector<route::RouteInfo>> ReadRoutes(const pqxx::result& rows) const;

  std::unique_ptr<PostgresSession> session_;
};

}  // namespace trailcast::store
