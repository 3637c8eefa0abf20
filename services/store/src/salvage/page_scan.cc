#include "services/store/src/salvage/page_scan.h"

#include <algorithm>
#include <set>

#include "services/store/src/salvage/big_endian.h"

namespace trailcast::store {
namespace {

// https://www.sqlite.org/fileformat.html, "B-tree Pages".
constexpr std::size_t kFileHeaderBytes = 100;  // before the first page's own
constexpr std::size_t kTreeHeaderBytes = 8;
constexpr std::size_t kInnerTreeHeaderBytes = 12;
constexpr std::size_t kCellCountAt = 3;
constexpr std::size_t kPointerBytes = 2;
constexpr std::uint8_t kTableLeaf = 0x0D;
constexpr std::uint8_t kInnerTable = 0x05;
constexpr std::uint8_t kIndexLeaf = 0x0A;
constexpr std::uint8_t kInnerIndex = 0x02;
constexpr std::size_t kNextPageBytes = 4;
constexpr std::size_t kChildBytes = 4;  // before an inner page's cell
// A segment's bytes and the rest of its row; no other row is as large.
constexpr std::uint64_t kMostRowBytes = (1U << 20U) + (1U << 12U);

struct TreePage {
  std::uint8_t kind = 0;
  std::span<const std::uint8_t> page;
  std::span<const std::uint8_t> pointers;  // to its cells
};

// Returns nothing for a page that cannot belong to a tree.
std::optional<TreePage> ReadTreePage(std::span<const std::uint8_t> page, PageNumber number) {
  const std::size_t begin = number == 1 ? kFileHeaderBytes : 0;
  const std::uint8_t kind = page[begin];
  const bool inner = kind == kInnerTable || kind == kInnerIndex;
  if (!inner && kind != kTableLeaf && kind != kIndexLeaf) return std::nullopt;
  const std::size_t pointers = begin + (inner ? kInnerTreeHeaderBytes : kTreeHeaderBytes);
  const std::size_t bytes = BigEndian(page, begin + kCellCountAt, 2) * kPointerBytes;
  if (pointers + bytes > page.size()) return std::nullopt;
  return TreePage{kind, page, page.subspan(pointers, bytes)};
}

// "Cell Payload Overflow Pages": returns how many of a row's bytes are in its leaf.
std::uint64_t LocalBytes(std::uint64_t row_bytes, std::uint64_t usable) {
  const std::uint64_t most = usable - 35;
  if (row_bytes <= most) return row_bytes;
  const std::uint64_t least = (usable - 12) * 32 / 255 - 23;
  const std::uint64_t fitting = least + (row_bytes - least) % (usable - kNextPageBytes);
  return fitting <= most ? fitting : least;
}

}  // namespace

Result<void> PageScan::Run(const Take& take) {
  accounted_.assign(std::size_t{pages_.pages()} + 1, false);
  unread_rows_ = 0;
  AccountFree();
  Account(pages_.lock_page());
  // The file's own pages come first, because they are together and are most of it.
  for (PageNumber page = 1; page <= pages_.pages(); ++page) {
    if (auto scanned = ScanPage(page, 0, take); !scanned) return scanned;
  }
  for (Moment moment = 1; moment <= pages_.latest(); ++moment) {
    if (auto scanned = ScanPage(pages_.PageAt(moment), moment, take); !scanned) return scanned;
  }
  return {};
}

std::size_t PageScan::unread_pages() const {
  return static_cast<std::size_t>(std::count(accounted_.begin() + 1, accounted_.end(), false));
}

void PageScan::Account(PageNumber page) {
  if (page < accounted_.size()) accounted_[page] = true;
}

// "The Freelist": trunks name each other and the leaves.
void PageScan::AccountFree() {
  std::set<PageNumber> seen;
  for (PageNumber trunk = pages_.first_free(); trunk != 0 && seen.insert(trunk).second;) {
    const auto page = pages_.Read(trunk, pages_.latest());
    if (!page) return;
    Account(trunk);
    const std::uint64_t most = page->size() / kNextPageBytes - 2;
    const std::uint64_t leaves = std::min(BigEndian(*page, kNextPageBytes, 4), most);
    for (std::uint64_t i = 0; i < leaves; ++i) {
      Account(static_cast<PageNumber>(BigEndian(*page, (i + 2) * kNextPageBytes, 4)));
    }
    trunk = static_cast<PageNumber>(BigEndian(*page, 0, 4));
  }
}

Result<void> PageScan::ScanPage(PageNumber number, Moment moment, const Take& take) {
  const auto bytes = pages_.Read(number, moment);
  if (!bytes) return {};
  const auto page = ReadTreePage(*bytes, number);
  if (!page) return {};
  Account(number);
  const bool is_index = page->kind == kIndexLeaf || page->kind == kInnerIndex;
  if (is_index && take_entries_ && pages_.LastChangeOf(number) == moment) {
    ScanIndex(page->page, page->pointers, page->kind == kInnerIndex ? kChildBytes : 0);
  }
  if (page->kind != kTableLeaf) return {};
  const Age age = pages_.LastChangeOf(number) == moment ? Age::kCurrent : Age::kPast;
  // Rows do not overlap. Without this, a leaf with equal pointers would be read for ever.
  std::size_t room = page->page.size();
  for (std::size_t i = 0; i < page->pointers.size(); i += kPointerBytes) {
    const std::size_t at = BigEndian(page->pointers, i, kPointerBytes);
    if (at >= page->page.size()) {
      NoteUnread(age);
    } else if (auto scanned = ScanRow({page->page.subspan(at), moment, age, room}, take);
               !scanned) {
      return scanned;
    }
  }
  return {};
}

// Entries that continue on further pages are none of ours.
void PageScan::ScanIndex(std::span<const std::uint8_t> page, std::span<const std::uint8_t> pointers,
                         std::size_t before_entry) const {
  std::vector<Record> entries;
  for (std::size_t i = 0; i < pointers.size(); i += kPointerBytes) {
    const std::size_t at = BigEndian(pointers, i, kPointerBytes) + before_entry;
    const auto size = at < page.size() ? ReadVarint(page.subspan(at)) : std::nullopt;
    const auto header = size ? ReadRecordHeader(size->rest, entry_columns_) : std::nullopt;
    if (header && header->types.size() == entry_columns_ &&
        header->record_bytes <= size->rest.size()) {
      entries.push_back(ReadRecord(*header, size->rest));
    }
  }
  take_entries_(entries);
}

Result<void> PageScan::ScanRow(const Cell& cell, const Take& take) {
  const auto size = ReadVarint(cell.bytes);
  const auto rowid = size ? ReadVarint(size->rest) : std::nullopt;
  if (!rowid) return {};
  const std::span<const std::uint8_t> here = rowid->rest;
  const auto header = ReadRecordHeader(here, *std::max_element(columns_.begin(), columns_.end()));
  if (!header || std::count(columns_.begin(), columns_.end(), header->types.size()) == 0) return {};
  // The columns' types tell the size, because the number before them may be damaged.
  const std::uint64_t bytes = header->record_bytes;
  const std::uint64_t local = LocalBytes(bytes, pages_.usable_bytes());
  const bool goes_on = local < bytes;
  if (bytes > kMostRowBytes || local > cell.room ||
      local + (goes_on ? kNextPageBytes : 0) > here.size()) {
    NoteUnread(cell.age);
    return {};
  }
  cell.room -= local;
  if (!goes_on) {
    const auto taken = take(ReadRecord(*header, here), cell.age);
    return taken ? Result<void>() : tl::unexpected(taken.error());
  }
  const auto next = static_cast<PageNumber>(BigEndian(here, local, kNextPageBytes));
  for (const Moment moment : std::set{cell.moment, pages_.latest(), Moment{0}}) {
    const auto whole = Follow(here.first(local), next, bytes, moment);
    if (!whole) continue;
    const auto taken = take(ReadRecord(*header, *whole), cell.age);
    if (!taken) return tl::unexpected(taken.error());
    if (*taken) return {};
  }
  return {};
}

std::optional<route::Bytes> PageScan::Follow(std::span<const std::uint8_t> local, PageNumber next,
                                             std::uint64_t size, Moment moment) {
  route::Bytes row(local.begin(), local.end());
  row.reserve(size);
  while (row.size() < size) {
    const auto page = pages_.Read(next, moment);
    if (!page) return std::nullopt;
    Account(next);
    next = static_cast<PageNumber>(BigEndian(*page, 0, kNextPageBytes));
    const std::size_t here = std::min(page->size() - kNextPageBytes, size - row.size());
    row.insert(row.end(), page->begin() + kNextPageBytes,
               page->begin() + static_cast<std::ptrdiff_t>(kNextPageBytes + here));
  }
  return row;
}

}  // namespace trailcast::store
