// Logs of replays, and what is told of them.
#include <algorithm>
#include <sstream>

#include "agent/diagnosis/run_log_format.h"
#include "agent/diagnosis/run_log_reader.h"
#include "services/explain/story.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
namespace agent = trailcast::agent;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  const auto log = agent::ReadRunLog(stream);
  if (!log) return 0;
  Require(log->damage.size() <= log->damaged_lines, "damage is counted");
  for (const agent::FrameRow& row : log->frames) {
    std::string text = agent::RowText(row);
    text.pop_back();  // the line's end
    std::string columns = agent::HeaderText({});
    columns = columns.substr(columns.find("columns ") + 8);
    columns.pop_back();
    const auto again = agent::ParseRow(text, *agent::ParseColumns(columns));
    Require(again && again->frame == row.frame && again->phase == row.phase,
            "a row that was read can be written and read");
  }
  for (const bool all : {false, true}) {
    Require(!trailcast::explain::TellStory(*log, all).empty(), "every log has a story");
  }
  constexpr std::size_t kFrames = 50;
  for (std::size_t row = 0; row < std::min(kFrames, log->frames.size()); ++row) {
    Require(!trailcast::explain::TellFrame(*log, row).empty(), "every frame has its words");
  }
  return 0;
}
