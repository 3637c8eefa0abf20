#include "services/photos/photo.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "services/base/hex.h"
#include "services/base/number.h"
#include "services/base/text.h"
#include "services/route/bounds.h"
#include "services/route/digest.h"
#include "services/route/route_ref.h"

namespace trailcast::photos {
namespace {

constexpr std::size_t kIdDigits = 16;
constexpr std::size_t kFields = 15;
constexpr std::size_t kMostShown = 64;
constexpr std::string_view kNone = "*";  // no name has this character
constexpr std::string_view kSure = "sure";
constexpr std::string_view kUnsure = "unsure";
constexpr std::string_view kAhead = "ahead";
constexpr std::string_view kBackwards = "backwards";

std::optional<route::Digest> ReadDigest(const std::string& hex) {
  route::Digest digest{};
  if (hex.size() != 2 * digest.size() || !IsHex(hex)) return std::nullopt;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    constexpr int kHexBase = 16;
    digest[i] = static_cast<std::uint8_t>(std::stoi(hex.substr(2 * i, 2), nullptr, kHexBase));
  }
  return digest;
}

tl::unexpected<Error> NoPhoto(std::string_view words) {
  return Fail(ErrorCode::kInvalidArgument,
              "'{}' describes no photo: expected its id, robot, mission, route, revision, place, "
              "time, size and digest",
              PlainText(words, kMostShown));
}

}  // namespace

bool IsPhotoId(std::string_view text) { return text.size() == kIdDigits && IsHex(text); }

std::string ToText(const Photo& photo) {
  return fmt::format("{} {} {} {} {} {:.2f} {:.2f} {} {} {} {} {} {} {} {}", photo.id,
                     photo.robot.value(), photo.mission, photo.route, photo.revision, photo.along_m,
                     photo.spot_m, photo.place.empty() ? kNone : std::string_view(photo.place),
                     photo.sure ? kSure : kUnsure, photo.backwards ? kBackwards : kAhead,
                     photo.taken_unix_ms, photo.width_px, photo.height_px, photo.bytes,
                     ToHex(photo.digest));
}

Result<Photo> ParsePhoto(std::string_view words) {
  const auto fields = WordsIn(words);
  if (fields.size() < kFields) return NoPhoto(words);
  Photo photo{.id = fields[0],
              .robot = AgentId(fields[1]),
              .mission = fields[2],
              .route = fields[3],
              .place = fields[7] == kNone ? std::string() : fields[7],
              .sure = fields[8] == kSure,
              .backwards = fields[9] == kBackwards};
  const auto along_m = ParseNumberWithin(fields[5], 0.0, route::kMaxLength_m);
  const auto spot_m = ParseNumberWithin(fields[6], 0.0, route::kMaxLength_m);
  const auto digest = ReadDigest(fields[14]);
  const bool names = IsPhotoId(photo.id) && IsValidName(fields[1]) && IsValidName(photo.mission) &&
                     IsValidName(photo.route) && (photo.place.empty() || IsValidName(photo.place));
  const bool numbers =
      along_m && spot_m && digest && ReadNumber(fields[4], photo.revision) &&
      ReadNumber(fields[10], photo.taken_unix_ms) && ReadNumber(fields[11], photo.width_px) &&
      ReadNumber(fields[12], photo.height_px) && ReadNumber(fields[13], photo.bytes);
  const auto is_side = [](int px) { return px > 0 && px <= route::kMaxImageSide_px; };
  if (!names || !numbers || !is_side(photo.width_px) || !is_side(photo.height_px) ||
      photo.bytes == 0) {
    return NoPhoto(words);
  }
  photo.along_m = *along_m;
  photo.spot_m = *spot_m;
  photo.digest = *digest;
  return photo;
}

std::string SpotText(const Photo& photo) {
  return photo.place.empty() ? fmt::format("{}@{:g}", photo.route, photo.spot_m) : photo.place;
}

bool AreOfOneSpot(const Photo& a, const Photo& b) {
  if (!a.place.empty() && a.place == b.place) return true;
  return a.route == b.route && std::abs(a.spot_m - b.spot_m) <= kSameSpot_m;
}

bool Matches(const PhotoQuery& query, const Photo& photo) {
  const auto fits = [](const std::string& asked, const std::string& has) {
    return asked.empty() || asked == has;
  };
  return fits(query.id, photo.id) && fits(query.robot, photo.robot.value()) &&
         fits(query.mission, photo.mission) && fits(query.route, photo.route) &&
         fits(query.place, photo.place) && photo.taken_unix_ms >= query.from_unix_ms &&
         (!query.spot_m || std::abs(*query.spot_m - photo.spot_m) <= kSameSpot_m);
}

bool AsksForPhotos(std::string_view words) {
  return words == kPhotosWord || words.starts_with(fmt::format("{} ", kPhotosWord));
}

std::string ToText(const PhotoQuery& query) {
  std::string text(kPhotosWord);
  const auto add = [&](const char* what, const std::string& is) {
    if (!is.empty()) text += fmt::format(" {} {}", what, is);
  };
  add("id", query.id);
  add("robot", query.robot);
  add("mission", query.mission);
  add("route", query.route);
  add("place", query.place);
  if (query.spot_m) text += fmt::format(" spot {:g}", *query.spot_m);
  if (query.from_unix_ms != 0) text += fmt::format(" from {}", query.from_unix_ms);
  return text;
}

Result<PhotoQuery> ParsePhotoQuery(std::string_view words) {
  const auto all = WordsIn(words);
  const auto wrong = [](const std::string& word, const char* expected) {
    return Fail(ErrorCode::kInvalidArgument, "photos: '{}' was not understood: expected {}",
                PlainText(word, kMostShown), expected);
  };
  PhotoQuery query;
  for (std::size_t i = 1; i < all.size(); i += 2) {
    const std::string& what = all[i];
    const std::string is = i + 1 < all.size() ? all[i + 1] : std::string();
    if (what == "from") {
      if (!ReadNumber(is, query.from_unix_ms)) return wrong(is, "milliseconds since 1970");
      continue;
    }
    if (what == "spot") {
      query.spot_m = ParseNumberWithin(is, 0.0, route::kMaxLength_m);
      if (!query.spot_m) return wrong(is, "metres along the route");
      continue;
    }
    std::string* const name = what == "id"        ? &query.id
                              : what == "robot"   ? &query.robot
                              : what == "mission" ? &query.mission
                              : what == "route"   ? &query.route
                              : what == "place"   ? &query.place
                                                  : nullptr;
    if (name == nullptr) return wrong(what, "id, robot, mission, route, place, spot or from");
    if (!IsValidName(is)) return wrong(is, "a name of letters, digits, '_', '.' and '-'");
    *name = is;
  }
  return query;
}

Result<PhotoQuery> AtPlace(PhotoQuery query, const std::string& place) {
  const std::size_t at = place.rfind('@');
  if (at == std::string::npos) {
    if (!IsValidName(place)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "'{}' is no place: expected its name, or ROUTE@METRES as hall@12.5",
                  PlainText(place, kMostShown));
    }
    query.place = place;
    return query;
  }
  const auto route = route::ParseRouteRef(place.substr(0, at));
  query.spot_m = ParseNumberWithin(place.substr(at + 1), 0.0, route::kMaxLength_m);
  if (!route || !query.spot_m) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' is no place: expected its name, or ROUTE@METRES as hall@12.5",
                PlainText(place, kMostShown));
  }
  query.route = route->route;
  return query;
}

}  // namespace trailcast::photos
