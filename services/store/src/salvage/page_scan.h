#pragma once

#include <functional>
#include <span>
#include <vector>

#include "services/base/result.h"
#include "services/store/src/salvage/sqlite_pages.h"
#include "services/store/src/salvage/sqlite_record.h"

namespace trailcast::store {

// Finds every row that some leaf of a table has, of whichever table. It asks no root for its
// leaves, and no index for its rows. It also reads rows of free pages, and those that the log has
// of pages that changed later, which tell earlier states. Pages with the continuation of a scout's
// own bytes are not searched for rows, because the bytes could be made to look like one.
class PageScan {
 public:
  enum class Age : std::uint8_t {
    kCurrent,  // the page's present state
    kPast,     // the log has, or had, a later one
  };
  // Says whether it could use the row. If not, the row's continuation on further pages may be read
  // as it was at another moment.
  using Take = std::function<Result<bool>(const Record&, Age)>;

  // Takes the entries of one page of an index.
  using TakeEntries = std::function<void(const std::vector<Record>&)>;

  // Skips rows with another number of columns.
  PageScan(SqlitePages& pages, std::vector<std::size_t> columns)
      : pages_(pages), columns_(std::move(columns)) {}

  // Also reads entries of current pages with so many columns.
  void AlsoEntries(std::size_t columns, TakeEntries take) {
    entry_columns_ = columns;
    take_entries_ = std::move(take);
  }
  // The error is that of `take`.
  [[nodiscard]] Result<void> Run(const Take& take);
  // Returns, after Run, the number of pages that belong to nothing that was found.
  [[nodiscard]] std::size_t unread_pages() const;
  // Returns, after Run, the number of current rows whose place a leaf has but that cannot be rows.
  [[nodiscard]] std::size_t unread_rows() const { return unread_rows_; }

 private:
  using Moment = SqlitePages::Moment;

  void ScanIndex(std::span<const std::uint8_t> page, std::span<const std::uint8_t> pointers,
                 std::size_t before_entry) const;
  Result<void> ScanPage(PageNumber page, Moment moment, const Take& take);
  // A row's place in its leaf at that moment.
  struct Cell {
    std::span<const std::uint8_t> bytes;
    Moment moment;
    Age age;
    std::size_t& room;  // left in the leaf, for this row and those after it
  };
  Result<void> ScanRow(const Cell& cell, const Take& take);
  void NoteUnread(Age age) { unread_rows_ += age == Age::kCurrent ? 1 : 0; }
  // Returns the row's bytes if they continue on pages from `next` on.
  [[nodiscard]] std::optional<route::Bytes> Follow(std::span<const std::uint8_t> local,
                                                   PageNumber next, std::uint64_t size,
                                                   Moment moment);
  void Account(PageNumber page);
  void AccountFree();

  SqlitePages& pages_;
  std::vector<std::size_t> columns_;
  std::size_t entry_columns_ = 0;
  TakeEntries take_entries_;     // null if nobody wants them
  std::vector<bool> accounted_;  // by number
  std::size_t unread_rows_ = 0;
};

}  // namespace trailcast::store
