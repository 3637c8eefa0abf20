// Tables of trials, and the pages made of them.
#include "services/lab/trial/trial_csv.h"

#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
namespace trial = trailcast::trial;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A table begins with a header of 300 bytes that mutation would never get past.
  std::string table = trial::TrialCsvHeader() + '\n';
  table.append(reinterpret_cast<const char*>(data), size);
  const auto* begin = reinterpret_cast<const std::uint8_t*>(table.data());
  const auto rows = trial::ReadTrialCsv(trailcast::fuzz::AsFile({begin, table.size()}, "rows.csv"));
  if (!rows) return 0;
  Require(trial::Summarize(*rows).trials == static_cast<int>(rows->size()), "trials are counted");
  Require(rows->empty() || !trial::TrialTable(*rows).empty(), "rows make a table");
  Require(rows->empty() || !trial::TrialMarkdown(*rows).empty(), "rows make a page");
  return 0;
}
