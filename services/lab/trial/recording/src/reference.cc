#include "services/lab/trial/recording/reference.h"

#include <cmath>
#include <fstream>
#include <limits>

#include "services/base/number_table.h"

namespace trailcast::trial {
namespace {

bool IsFrame(double value) {
  return value >= 0.0 && value <= std::numeric_limits<int>::max() && value == std::floor(value);
}

}  // namespace

Result<Reference> ReadReference(const std::filesystem::path& file) {
  const auto rows =
      ReadNumbers(file, {"replay_frame", "teach_frame", "inliers", "median_du_px", "good"});
  if (!rows) return tl::unexpected(rows.error());
  Reference reference;
  for (const auto& [line, row] : *rows) {
    if (!IsFrame(row[0]) || !IsFrame(row[1]) || !IsFrame(row[2])) {
      return Fail(ErrorCode::kInvalidArgument,
                  "{}, line {}: frames and inliers are whole numbers from 0, not {}, {}, {}",
                  file.string(), line, row[0], row[1], row[2]);
    }
    if (!reference.empty() && row[0] <= reference.back().replay_frame) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: frame {} does not come after frame {}",
                  file.string(), line, row[0], reference.back().replay_frame);
    }
    reference.push_back({static_cast<int>(row[0]), static_cast<int>(row[1]),
                         static_cast<int>(row[2]), row[3], row[4] != 0.0});
  }
  return reference;
}

Result<void> WriteReference(const Reference& reference, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::trunc);
  stream << "replay_frame,teach_frame,inliers,median_du_px,good\n";
  for (const Alignment& row : reference) {
    stream << fmt::format("{},{},{},{:.2f},{}\n", row.replay_frame, row.teach_frame, row.inliers,
                          row.median_du_px, row.good ? 1 : 0);
  }
  stream.close();
  if (!stream) {
    return Fail(ErrorCode::kUnavailable,
                "cannot write {}: check that its folder exists and is writable", file.string());
  }
  return {};
}

Reference IdentityReference(int frames) {
  Reference reference;
  reference.reserve(static_cast<std::size_t>(frames));
  for (int frame = 0; frame < frames; ++frame) reference.push_back({frame, frame, 0, 0.0, true});
  return reference;
}

Result<Steering> ReadSteering(const std::filesystem::path& file) {
  const auto rows = ReadNumbers(file, {"frame", "steering"});
  if (!rows) return tl::unexpected(rows.error());
  Steering steering;
  for (const auto& [line, row] : *rows) {
    if (!IsFrame(row[0])) {
      return Fail(ErrorCode::kInvalidArgument,
                  "{}, line {}: frames are whole numbers from 0, not {}", file.string(), line,
                  row[0]);
    }
    steering[static_cast<int>(row[0])] = row[1];
  }
  return steering;
}

}  // namespace trailcast::trial
