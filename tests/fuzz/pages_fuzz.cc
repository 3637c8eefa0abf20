// Any bytes as a store's file and its log, read without SQLite: what a row says is taken only with
// its seal, and reading ends.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <vector>

#include "services/store/src/salvage/found_rows.h"
#include "services/store/src/salvage/page_scan.h"
#include "tests/fuzz/fuzz.h"

namespace trailcast::fuzz {
namespace {

using store::PageScan;

// Small pages, so that a small input has several.
std::vector<std::uint8_t> WithHeader(std::vector<std::uint8_t> file, bool wanted) {
  constexpr std::uint8_t kHeader[] = "SQLite format 3\0\x02\x00\x02\x02";
  if (wanted) file.insert(file.begin(), std::begin(kHeader), std::end(kHeader) - 1);
  return file;
}

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast;
  FuzzedDataProvider input(data, size);
  const bool with_header = input.ConsumeBool();
  const auto log = input.ConsumeBytes<std::uint8_t>(
      input.ConsumeIntegralInRange<std::size_t>(0, input.remaining_bytes()));
  const auto file = fuzz::WithHeader(input.ConsumeRemainingBytes<std::uint8_t>(), with_header);
  const auto path = fuzz::AsFile(file, "pages.db");
  fuzz::AsFile(log, "pages.db-wal");
  store::SqlitePages pages(path);
  std::size_t rows = 0;
  fuzz::PageScan scan(pages, store::ColumnsOfInterest());
  scan.AlsoEntries(store::kReceiptColumns, [&](const std::vector<store::Record>& entries) {
    fuzz::Require(store::ReadFoundReceipts(entries).size() <= entries.size(),
                  "no receipt is made up");
  });
  const auto scanned =
      scan.Run([&](const store::Record& record, fuzz::PageScan::Age) -> Result<bool> {
        ++rows;
        const auto segment = store::ReadFoundSegment(record);
        const auto route = store::ReadFoundRoute(record);
        fuzz::Require(segment.has_value() != route.has_value(), "a row is of one table");
        return segment && segment->sealed;
      });
  fuzz::Require(scanned.has_value(), "a scan goes through");
  fuzz::Require(rows <= file.size() + log.size(), "a byte begins one row at most");
  fuzz::Require(scan.unread_pages() <= pages.pages(), "no page is counted twice");
  return 0;
}
