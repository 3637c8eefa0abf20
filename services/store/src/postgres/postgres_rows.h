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

// The values of a statement's parameters, in their order; what they mean is the statement's to say.
class PostgresValues {
 public:
  void Add(const std::string& text);
  void Add(std::int64_t number) { values_.emplace_back(fmt::format("{}", number)); }
  void Add(double number) { values_.emplace_back(fmt::format("{}", number)); }  // reads back same
  void AddBytes(const std::uint8_t* bytes, std::size_t size);
  void Add(const route::Digest& digest) { AddBytes(digest.data(), digest.size()); }
  void Add(std::monostate) { values_.emplace_back(std::nullopt); }
  void Add(const route::RouteKey& key);  // two
  void Add(const std::vector<SqlValue>& values);
  // In the order of kRouteColumns.
  void AddRoute(const route::RouteInfo& info);
  void AddSegment(const route::SegmentPiece& piece);  // route, teaching, number, digest, seal

  [[nodiscard]] bool empty() const { return values_.empty(); }
  // "($1,$2),($3,$4)" for rows of two.
  [[nodiscard]] std::string Rows(std::size_t columns) const;
  // `sql` with its question marks numbered.
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
// A row of kRouteColumns. kCorrupt if it is damaged.
[[nodiscard]] Result<route::RouteInfo> ReadRoute(const pqxx::row& row);
// The columns digest, seal, bytes of a row asked for under this key and index. kCorrupt if its
// bytes fail their digest, or if damage made the row answer to another's name.
[[nodiscard]] Result<route::SegmentPiece> ReadSegmentRow(const pqxx::row& row,
                                                         const route::RouteKey& key,
                                                         SegmentIndex index);
// Of its columns `digest` and `seal` alone.
[[nodiscard]] Result<route::Digest> ReadSegmentDigest(const pqxx::row& row,
                                                      const route::RouteKey& key,
                                                      SegmentIndex index);
[[nodiscard]] double ReadDouble(const pqxx::field& field);
// Empty where the column is NULL, as of a content that is gone.
[[nodiscard]] route::Bytes ReadBytes(const pqxx::field& field);

}  // namespace trailcast::store
