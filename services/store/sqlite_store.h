#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "services/store/compiled_statements.h"
#include "services/store/route_store.h"
#include "services/store/sqlite_database.h"
#include "services/store/store_file.h"

namespace trailcast::store {

// RouteStore in one SQLite file, made by OpenSqliteStore.
class SqliteRouteStore final : public RouteStore {
 public:
  SqliteRouteStore(StoreFile file, std::unique_ptr<SQLite::Database> db,
                   SqliteOptions::Durability durability)
      : file_(std::move(file)), db_(std::move(db)), durability_(durability) {}

  Result<void> PutRoutes(std::span<const route::RouteInfo> infos) override;
  Result<void> AppendSegments(std::span<const route::SegmentPiece> pieces) override;
  Result<void> DropSegments(const route::RouteKey& key) override;
  Result<void> AppendFetched(std::span<const route::SegmentPiece> pieces) override;
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
  Result<std::vector<std::string>> Verify() override;

 private:
  // Runs `work`, which may throw SQLite's exceptions, and wraps them with `doing`, which is a text
  // or makes one, because some texts depend on the segment.
  template <typename Doing, typename Work>
  auto Guarded(const Doing& doing, const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const SQLite::Exception& exception) {
      if constexpr (std::is_invocable_v<Doing>) {
        return tl::unexpected(ToError(exception, file_.path(), doing()));
      } else {
        return tl::unexpected(ToError(exception, file_.path(), doing));
      }
    }
  }

  // Stores all in one transaction: if `store` fails for one of them, none is stored.
  template <typename Item, typename Store>
  Result<void> StoreAll(const std::string& doing, std::span<const Item> items, const Store& store);
  [[nodiscard]] std::string RareTag(const route::RouteQuery& query);
  // Stores the news of a route within the caller's transaction. The others write its description,
  // the columns by which it is found, or its tombstone.
  Result<void> PutNews(const route::RouteInfo& info);
  void Put(const route::RouteInfo& info);
  void Bury(const route::RouteInfo& info);
  // Runs within the caller's transaction. Bytes on which others rely go to them.
  void PartWith(const route::RouteKey& key);
  // Puts the row into one of the two tables and returns its id.
  std::int64_t PutRow(const std::string& table, const route::RouteInfo& info);
  void ForgetPlaceAndTags(std::int64_t id);
  [[nodiscard]] Result<void> RefuseBuried(const route::RouteKey& key);
  // Appends in one transaction, and does `then` with each piece.
  Result<void> AppendAll(std::span<const route::SegmentPiece> pieces,
                         const std::function<void(const route::SegmentPiece&)>& then);
  void NoteReceipt(const route::RouteKey& key, SegmentIndex index);
  // Stores a piece within the caller's transaction.
  Result<void> Append(const route::SegmentPiece& piece);
  // Says whether that changed something.
  bool Execute(const std::string& sql, const route::SegmentPiece& piece);
  Result<std::vector<SegmentIndex>> SelectIndices(const route::RouteKey& key, bool unreceipted);
  // Returns the rows of one of the two tables that fulfil `where`, whose parameters `bind` fills
  // in.
  Result<std::vector<route::RouteInfo>> SelectRoutes(
      const std::string& table, const std::string& where,
      const std::function<void(SQLite::Statement&)>& bind);

  // These are parts of Verify (sqlite_verify.cc); each adds a line for all damage that it finds.
  Result<void> VerifyPages(std::vector<std::string>& damage);
  Result<void> VerifyRoutes(std::vector<std::string>& damage);

  StoreFile file_;  // must outlive db_: see ~StoreFile
  std::unique_ptr<SQLite::Database> db_;
  SqliteOptions::Durability durability_;
  CompiledStatements compiled_{*db_};
};

}  // namespace trailcast::store
