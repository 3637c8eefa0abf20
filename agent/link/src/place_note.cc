#include "agent/link/place_note.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>

#include "services/base/text_file.h"

namespace trailcast::agent {
namespace {

constexpr const char* kPlaceFirstLine = "trailcast-place 1";
constexpr std::size_t kMaxBytes = 512;
constexpr double kLongest_m = 1e7;
constexpr double kMostMagnification = 100.0;

bool IsGood(const NotedPlace& place) {
  return place.key.route.value().size() == 32 && place.key.teaching.value() > 0 &&
         place.along_m >= 0.0 && place.along_m <= kLongest_m &&
         place.magnification > 1.0 / kMostMagnification && place.magnification < kMostMagnification;
}

// Parses the lines that Write makes.
std::optional<NotedPlace> Parse(const std::string& text) {
  std::istringstream lines(text);
  std::string first;
  std::string route;
  std::uint64_t teaching = 0;
  NotedPlace place;
  std::getline(lines, first);
  const auto named = [&](const char* name, auto& value) {
    std::string word;
    return static_cast<bool>(lines >> word >> value) && word == name;
  };
  const bool whole = first == kPlaceFirstLine && named("route", route) &&
                     named("teaching", teaching) && named("along_m", place.along_m) &&
                     named("magnification", place.magnification) && named("unix_ms", place.unix_ms);
  if (!whole) return std::nullopt;
  place.key = {RouteId(route), TeachingId(teaching)};
  return IsGood(place) ? std::optional(place) : std::nullopt;
}

}  // namespace

Result<std::optional<NotedPlace>> PlaceNote::Read() const {
  std::ifstream stream(file_);
  if (!stream) return std::nullopt;
  std::string text(kMaxBytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  auto place = Parse(text);
  if (place) return place;
  return Fail(ErrorCode::kCorrupt, "{} is not a note of where a robot was: remove it",
              file_.string());
}

Result<void> PlaceNote::Write(const NotedPlace& place) const {
  const std::string text =
      fmt::format("{}\nroute {}\nteaching {}\nalong_m {:.3f}\nmagnification {:.5f}\nunix_ms {}\n",
                  kPlaceFirstLine, place.key.route.value(), place.key.teaching.value(),
                  place.along_m, place.magnification, place.unix_ms);
  std::filesystem::path fresh = file_;
  fresh += ".new";
  if (auto written = WriteTextFile(fresh, text); !written) return written;
  std::error_code failed;
  std::filesystem::rename(fresh, file_, failed);
  if (!failed) return {};
  return Fail(ErrorCode::kUnavailable, "cannot replace {}: {}", file_.string(), failed.message());
}

Result<void> PlaceNote::Remove() const {
  std::error_code failed;
  std::filesystem::remove(file_, failed);
  if (!failed) return {};
  return Fail(ErrorCode::kUnavailable, "cannot remove {}: {}", file_.string(), failed.message());
}

}  // namespace trailcast::agent
