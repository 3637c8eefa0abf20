#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::photos {

// This is what is known of a picture that a robot took on a mission. A robot and a server keep it
// in a file beside the picture, and it travels with it.
struct Photo {
  std::string id{};  // 16 hexadecimal digits, drawn by the robot
  AgentId robot{};
  std::string mission{};  // its id
  std::string route{};    // its name
  std::uint32_t revision = 0;
  double along_m = 0.0;            // where it was taken, in metres from the route's beginning
  double spot_m = 0.0;             // where it was to be taken
  std::string place{};             // what people call that spot; empty if they do not
  bool sure = true;                // the robot was sure of its place
  bool backwards = false;          // it drove in reverse gear
  std::int64_t taken_unix_ms = 0;  // by the robot's clock
  int width_px = 0;
  int height_px = 0;
  std::uint32_t bytes = 0;  // of its JPEG
  route::Digest digest{};   // SHA-256 of that
  bool operator==(const Photo&) const = default;
};

// Spots that are no further apart than this are the same.
inline constexpr double kSameSpot_m = 0.25;

// Returns one line of words. A robot with a later version may put more words behind them.
[[nodiscard]] std::string ToText(const Photo& photo);
// Fails with kInvalidArgument, which says what was expected.
[[nodiscard]] Result<Photo> ParsePhoto(std::string_view words);
[[nodiscard]] bool IsPhotoId(std::string_view text);

// Returns where it was to be taken, for people: "dock", or "hall@12.5".
[[nodiscard]] std::string SpotText(const Photo& photo);
// Returns whether both were to be taken at one place.
[[nodiscard]] bool AreOfOneSpot(const Photo& a, const Photo& b);

// This asks for photos. Empty fields do not narrow the question.
struct PhotoQuery {
  std::string id{};
  std::string robot{};
  std::string mission{};
  std::string route{};
  std::string place{};             // what people call it
  std::optional<double> spot_m{};  // along that route
  std::int64_t from_unix_ms = 0;   // taken at that time or later
  bool operator==(const PhotoQuery&) const = default;
};
[[nodiscard]] bool Matches(const PhotoQuery& query, const Photo& photo);

// A question to a server, and a question in words: "photos mission 4f2a09c1 place dock".
inline constexpr std::string_view kPhotosWord = "photos";
[[nodiscard]] bool AsksForPhotos(std::string_view words);
[[nodiscard]] std::string ToText(const PhotoQuery& query);
[[nodiscard]] Result<PhotoQuery> ParsePhotoQuery(std::string_view words);

// Returns the query for what users type as a place: "dock", or "hall@12.5".
[[nodiscard]] Result<PhotoQuery> AtPlace(PhotoQuery query, const std::string& place);

}  // namespace trailcast::photos
