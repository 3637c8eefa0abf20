#include "services/lab/trial/judge/recording_pair.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <sstream>

#include "services/base/number.h"
#include "services/base/text_file.h"
#include "services/lab/trial/recording/odometry_noise.h"

namespace trailcast::trial {
namespace {

namespace fs = std::filesystem;
using Cells = std::map<std::string, std::string>;

constexpr std::array kColumns{"kind",
                              "set",
                              "teach",
                              "replay",
                              "truth",
                              "steering",
                              "disturb",
                              "teach_odometry",
                              "replay_odometry",
                              "rate",
                              "visits",
                              "disturb_visits",
                              "odometry_noise"};

std::vector<std::string> Split(std::string line, char separator = ',') {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::istringstream words(line + separator);
  for (std::string cell; std::getline(words, cell, separator);) cells.push_back(cell);
  return cells;
}

std::optional<PairKind> FindKind(const std::string& name) {
  for (const PairKind kind : {PairKind::kIdentity, PairKind::kRight, PairKind::kWrong}) {
    if (name == ToString(kind)) return kind;
  }
  return std::nullopt;
}

Result<RecordingPair> PairOf(Cells& cells, const fs::path& root) {
  const auto below = [&](const char* column) {
    return cells[column].empty() ? fs::path() : root / cells[column];
  };
  RecordingPair pair;
  pair.set = cells["set"];
  pair.teach_name = cells["teach"];
  pair.replay_name = cells["replay"];
  pair.teach = {below("teach"), below("teach_odometry"), {}};
  pair.replay = {below("replay"), below("replay_odometry"), {}};
  pair.reference = below("truth");
  pair.steering = below("steering");
  pair.disturbance = cells["disturb"];
  if (pair.teach.frames.empty() || pair.replay.frames.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "expected a recording under 'teach' and 'replay'");
  }
  const std::string kind = cells["kind"].empty() ? "right" : cells["kind"];
  const auto found = FindKind(kind);
  if (!found) {
    return Fail(ErrorCode::kInvalidArgument, "the kind is 'identity', 'right' or 'wrong', not '{}'",
                kind);
  }
  pair.kind = *found;
  pair.odometry_noise = cells["odometry_noise"];
  if (auto parsed = ParseOdometryNoise(pair.odometry_noise); !parsed) {
    return tl::unexpected(parsed.error());
  }
  pair.visits_disturbance = cells["disturb_visits"];
  for (const std::string& each : {pair.disturbance, pair.visits_disturbance}) {
    if (auto parsed = ParseDisturbance(each); !parsed) return tl::unexpected(parsed.error());
  }
  if (const std::string& rate = cells["rate"]; !rate.empty()) {
    const auto rate_hz = ParseNumber<double>(rate);
    if (!rate_hz || !(*rate_hz > 0.0)) {
      return Fail(ErrorCode::kInvalidArgument, "the rate is frames a second, not '{}'", rate);
    }
    pair.teach.rate_hz = pair.replay.rate_hz = *rate_hz;
  }
  if (!cells["visits"].empty()) {
    for (const std::string& visit : Split(cells["visits"], '+')) {
      pair.visits.push_back({root / visit, {}, pair.replay.rate_hz});
    }
  }
  return pair;
}

}  // namespace

const char* ToString(PairKind kind) {
  switch (kind) {
    case PairKind::kIdentity:
      return "identity";
    case PairKind::kRight:
      return "right";
    case PairKind::kWrong:
      break;
  }
  return "wrong";
}

Result<std::vector<RecordingPair>> ReadPairs(const fs::path& file, const fs::path& root) {
  const auto text = ReadTextFile(file);
  if (!text) return Wrap(text.error(), "pairs");
  std::istringstream stream(*text);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = Split(line);
  for (const std::string& name : names) {
    if (std::find(kColumns.begin(), kColumns.end(), name) == kColumns.end()) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line 1: there is no column '{}'; there are: {}",
                  file.string(), name, fmt::join(kColumns, ", "));
    }
  }
  std::vector<RecordingPair> pairs;
  for (int number = 2; std::getline(stream, line); ++number) {
    if (line.empty()) continue;
    const std::vector<std::string> values = Split(line);
    if (values.size() != names.size()) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: expected {} cells, not {}",
                  file.string(), number, names.size(), values.size());
    }
    Cells cells;
    for (std::size_t i = 0; i < names.size(); ++i) cells[names[i]] = values[i];
    auto pair = PairOf(cells, root);
    if (!pair) return Wrap(pair.error(), fmt::format("{}, line {}", file.string(), number));
    pairs.push_back(std::move(*pair));
  }
  if (pairs.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "{} lists no pairs", file.string());
  }
  return pairs;
}

}  // namespace trailcast::trial
