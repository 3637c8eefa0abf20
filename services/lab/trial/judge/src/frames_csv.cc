#include "services/lab/trial/judge/frames_csv.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "services/base/text_file.h"

namespace trailcast::trial {
namespace {

std::string TextOf(const RecordingOutcome& outcome) {
  std::string text = "shown,frame,cut,state,teach_frame,turn_rad,true_teach_frame,true_du_px\n";
  const Replayed& replayed = outcome.replayed;
  for (std::size_t i = 0; i < replayed.shown.size(); ++i) {
    text += fmt::format("{},{},{},", i, replayed.shown[i].frame, replayed.shown[i].cut ? 1 : 0);
    if (i < replayed.said.size()) {
      text += fmt::format("{},{:.2f},{:.5f},", outcome.states[i], replayed.said[i].teach_frame,
                          replayed.said[i].turn_rad);
    } else {
      text += ",,,";
    }
    const auto& truth = outcome.truth[i];
    text += truth ? fmt::format("{},{:.2f}\n", truth->teach_frame, truth->median_du_px) : ",\n";
  }
  return text;
}

}  // namespace

Result<void> WriteFramesCsv(const std::vector<RecordingOutcome>& outcomes,
                            const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  for (const RecordingOutcome& outcome : outcomes) {
    const auto file = folder / (FileStem(outcome.row) + ".csv");
    if (auto written = WriteTextFile(file, TextOf(outcome)); !written) return written;
  }
  return {};
}

}  // namespace trailcast::trial
