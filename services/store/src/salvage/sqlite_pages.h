#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <vector>

#include "services/route/route.h"

namespace trailcast::store {

using PageNumber = std::uint32_t;  // from 1 on

// Reads the pages of an SQLite file, and those in the log beside it, to save what is left of them.
// It trusts nothing in either, and needs no SQLite. https://www.sqlite.org/fileformat.html
class SqlitePages {
 public:
  // How many of the log's frames, from the oldest on, count as done. 0 means the file alone.
  using Moment = std::size_t;

  // A file that cannot be read has no pages.
  explicit SqlitePages(const std::filesystem::path& file);

  // Says whether the header marks one of our stores, whatever the rest of it is.
  [[nodiscard]] bool is_store() const { return is_store_; }
  [[nodiscard]] std::uint32_t usable_bytes() const { return usable_bytes_; }  // of a page
  // Returns how many pages there should be: in the file, or by its header if it was cut short.
  [[nodiscard]] PageNumber pages() const { return pages_; }
  [[nodiscard]] PageNumber first_free() const { return first_free_; }  // 0 for none

  // Returns the page that SQLite leaves out in a file that is large enough to have it.
  [[nodiscard]] PageNumber lock_page() const { return (1U << 30U) / page_bytes_ + 1; }

  [[nodiscard]] Moment latest() const { return frames_.size(); }
  // Returns the page of the log's frame number `moment`.
  [[nodiscard]] PageNumber PageAt(Moment moment) const { return frames_[moment - 1].page; }
  [[nodiscard]] Moment LastChangeOf(PageNumber page) const;
  // Returns nothing for a page that is not there, or that the disk does not return.
  [[nodiscard]] std::optional<route::Bytes> Read(PageNumber page, Moment moment);

 private:
  struct Frame {
    PageNumber page;
    std::uint64_t offset;
  };
  void ReadHeader(std::uint64_t file_bytes);
  void ListFrames(std::uint64_t log_bytes);
  [[nodiscard]] std::optional<route::Bytes> ReadAt(std::ifstream& from, std::uint64_t offset) const;

  std::ifstream file_;
  std::ifstream log_;
  bool is_store_ = false;
  std::uint32_t page_bytes_ = 4096;  // SQLite's default
  std::uint32_t usable_bytes_ = 4096;
  PageNumber pages_ = 0;
  PageNumber first_free_ = 0;
  std::vector<Frame> frames_;                          // the oldest first
  std::map<PageNumber, std::vector<Moment>> page_at_;  // the moments that changed a page, rising
};

}  // namespace trailcast::store
