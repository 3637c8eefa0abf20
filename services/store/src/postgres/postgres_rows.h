#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <pqxx/pqxx>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {

// The values of a statement's parameters, in their order; the statement gives them their meaning.
class PostgresValues {
 public:
  void Add(const std::string& text);
  void Add(std::int64_t number) { values_.emplace_back(fmt::format("{}", number)); }
  // reads back the same
  void Add(double number) { values_.emplace_back(fmt::format("{}", number)); }
  void AddBytes(const std::uint8_t* bytes, std::size_t size);
  void Add(const route::Digest& digest) { AddBytes(digest.data(), digest.size()); }
  void Add(std::monostate) { values_.emplace_back(std::nullopt); }
  void Add(const route::RouteKey& key);  // two
  void Add(const std::vector<SqlValue>& values);
  // Adds them in the order of kRouteColumns.
  void AddRoute(const route::RouteInfo& info);
  void AddSegment(const route::SegmentPiece& piece);  // route, teaching, number, digest, seal

  [[nodiscard]] bool empty() const { return values_.empty(); }
  // Returns "($1,$2),($3,$4)" for rows of two.
  [[nodiscard]] std::string Rows(std::size_t columns) const;
  // Executes `sql` with its question marks numbered.
  [[nodiscard]] pqxx::result Execute(pqxx::transaction_base& transaction,
                                     const std::string& sql) const;

 private:
  std::vector<std::optional<std::string>> values_;
};

// Calls `work` with the ends of successive parts of `items`, none larger than one statement takes
// (PostgreSQL counts parameters with 16 bits).
template <typename Items, typename Work>
void ForSome(const Items& items, const Work& work) {
  constexpr std::ptrdiff_t kMost = 500;
  for (auto begin = std::begin(items); begin != std::end(items);) {
    auto end = begin;
    for (std::ptrdiff_t n = 0; n < kMost && end != std::end(items); ++n) ++end;
    work(begin, end);
    begin = end;
  }
}

[[nodiscard]] route::RouteKey ReadKey(const pqxx::row& row);  // its first two columns
// Reads a row of kRouteColumns; kCorrupt means that it is damaged.
[[nodiscard]] Result<route::RouteInfo> ReadRoute(const pqxx::row& row);
// Reads the columns digest, seal, bytes of a row that was requested with this key and index.
// kCorrupt means that its bytes do not match their digest, or that damage made the row match
// another's key.
[[nodiscard]] Result<route::SegmentPiece> ReadSegmentRow(const pqxx::row& row,
                                                         const route::RouteKey& key,
                                                         SegmentIndex index);
// Reads its columns `digest` and `seal` alone.
[[nodiscard]] Result<route::Digest> ReadSegmentDigest(const pqxx::row& row,
                                                      const route::RouteKey& key,
                                                      SegmentIndex index);
[[nodiscard]] double ReadDouble(const pqxx::field& field);
// Returns no bytes if the column is NULL, as of a content that is gone.
[[nodiscard]] route::Bytes ReadBytes(const pqxx::field& field);

}  // namespace trailcast::store
