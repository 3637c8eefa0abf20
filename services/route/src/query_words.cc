#include "services/route/query_words.h"

#include "services/base/number.h"
#include "services/route/bounds.h"

namespace trailcast::route {

const std::map<std::string, RouteOrder>& OrderWords() {
  static const std::map<std::string, RouteOrder> kWords{{"newest", RouteOrder::kNewest},
                                                        {"oldest", RouteOrder::kOldest},
                                                        {"name", RouteOrder::kName},
                                                        {"longest", RouteOrder::kLongest},
                                                        {"shortest", RouteOrder::kShortest}};
  return kWords;
}

const std::map<std::string, StateWord>& StateWords() {
  static const std::map<std::string, StateWord> kWords{
      {"teaching", {RouteState::kTeaching}},
      {"complete", {RouteState::kComplete}},
      {"staged", {RouteState::kComplete, Standing::kStaged}},
      {"active", {RouteState::kComplete, Standing::kActive}},
      {"retired", {RouteState::kComplete, Standing::kRetired}}};
  return kWords;
}

Result<Place> ReadPlace(Place::Frame frame, const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto first = ParseNumber<double>(text.substr(0, comma));
  const auto second =
      comma == std::string::npos ? std::nullopt : ParseNumber<double>(text.substr(comma + 1));
  if (!first || !second) {
    return Fail(ErrorCode::kInvalidArgument, "'{}' is not two numbers with a comma between", text);
  }
  // On the globe people say latitude first; x is east.
  const bool on_globe = frame == Place::Frame::kWgs84;
  const Place place{frame, on_globe ? *second : *first, on_globe ? *first : *second};
  if (auto possible = CheckPlace(place); !possible) return tl::unexpected(possible.error());
  return place;
}

}  // namespace trailcast::route
