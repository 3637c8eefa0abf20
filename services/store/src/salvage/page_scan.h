#pragma once

#include <functional>
#include <span>
#include <vector>

#include "services/base/result.h"
#include "services/store/src/salvage/sqlite_pages.h"
#include "services/store/src/salvage/sqlite_record.h"

namespace trailcast::store {

// Every row that some leaf of a table has, of whichever table: no root is asked for its leaves, and
// no index for its rows. Also the rows of pages that are free, and those that the log has of pages
// that changed since: they say what once was so. Where a scout's own bytes go on over further
// pages, nothing is taken for a row: they could be made to look like one.
class PageScan {
 public:
  enum class Age : std::uint8_t {
    kCurrent,  // the page is so now
    kPast,     // the log has, or had, a later one
  };
  // Whether it could use the row. False: what goes on over further pages may be read as it was at
  // another moment.
  using Take = std::function<Result<bool>(const Record&, Age)>;

  // The entries of one page of an index.
  using TakeEntries = std::function<void(const std::vector<Record>&)>;

  // Rows with another number of columns are passed over.
  PageScan(SqlitePages& pages, std::vector<std::size_t> columns)
      : pages_(pages), columns_(std::move(columns)) {}

  // Those of current pages, with so many columns.
  void AlsoEntries(std::size_t columns, TakeEntries take) {
    entry_columns_ = columns;
    take_entries_ = std::move(take);
  }
  // The error is that of `take`.
  [[nodiscard]] Result<void> Run(const Take& take);
  // After Run: pages that are part of nothing that was found.
  [[nodiscard]] std::size_t unread_pages() const;
  // After Run: current rows of which a leaf has the place, and that cannot be rows.
  [[nodiscard]] std::size_t unread_rows() const { return unread_rows_; }

 private:
  using Moment = SqlitePages::Moment;

  void ScanIndex(std::span<const std::uint8_t> page, std::span<const std::uint8_t> pointers,
                 std::size_t before_entry) const;
  Result<void> ScanPage(PageNumber page, Moment moment, const Take& take);
  // A row's place in its leaf, as that was at the moment.
  struct Cell {
    std::span<const std::uint8_t> bytes;
    Moment moment;
    Age age;
    std::size_t& room;  // in the leaf, for this row and those after it
  };
  Result<void> ScanRow(const Cell& cell, const Take& take);
  void NoteUnread(Age age) { unread_rows_ += age == Age::kCurrent ? 1 : 0; }
  // The row's bytes, if they go on over pages from `next` on.
  [[nodiscard]] std::optional<route::Bytes> Follow(std::span<const std::uint8_t> local,
                                                   PageNumber next, std::uint64_t size,
                                                   Moment moment);
  void Account(PageNumber page);
  void AccountFree();

  SqlitePages& pages_;
  std::vector<std::size_t> columns_;
  std::size_t entry_columns_ = 0;
  TakeEntries take_entries_;     // none: nobody wants them
  std::vector<bool> accounted_;  // by number
  std::size_t unread_rows_ = 0;
};

}  // namespace trailcast::store
