#include "services/route/route_ref.h"

#include <algorithm>
#include <charconv>

#include "services/base/hex.h"

namespace trailcast::route {
namespace {

constexpr std::size_t kIdDigits = 32;

std::size_t AlikeDigits(const std::string& a, const std::string& b) {
  const auto [differs, ignored] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return static_cast<std::size_t>(differs - a.begin());
}

}  // namespace

Result<RouteRef> ParseRouteRef(const std::string& text) {
  const std::size_t at = text.find('@');
  RouteRef ref{text.substr(0, at), 0};
  bool right = IsValidName(ref.route);
  if (at != std::string::npos) {
    const char* const end = text.data() + text.size();
    const auto [read_to, error] = std::from_chars(text.data() + at + 1, end, ref.revision);
    right = right && error == std::errc() && read_to == end && ref.revision > 0;
  }
  if (right) return ref;
  return Fail(ErrorCode::kInvalidArgument,
              "'{}' is no route: expected its name (1 to 64 of letters, digits, '_', '.' and '-') "
              "or {} digits or more of its id, as 'trailcast routes' lists it; '@2' behind it is "
              "its revision 2",
              text, kLeastIdDigits);
}

bool LooksLikeId(std::string_view name_or_id) {
  return name_or_id.size() >= kLeastIdDigits && name_or_id.size() <= kIdDigits && IsHex(name_or_id);
}

bool IsMeantBy(const RouteInfo& info, const std::string& name_or_id) {
  return info.name == name_or_id ||
         (LooksLikeId(name_or_id) && info.key.route.value().starts_with(name_or_id));
}

std::vector<RouteInfo> OnlyMeant(std::vector<RouteInfo> routes, const std::string& name_or_id) {
  const auto has_id = [&](const RouteInfo& info) { return info.key.route.value() == name_or_id; };
  const bool whole_id = std::any_of(routes.begin(), routes.end(), has_id);
  std::erase_if(routes, [&](const RouteInfo& info) {
    return whole_id ? !has_id(info) : !IsMeantBy(info, name_or_id);
  });
  return routes;
}

ShortIds::ShortIds(std::span<const RouteInfo> routes) {
  std::vector<std::string> ids;
  ids.reserve(routes.size());
  for (const RouteInfo& info : routes) ids.push_back(info.key.route.value());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (std::size_t i = 1; i < ids.size(); ++i) {
    digits_ = std::max(digits_, AlikeDigits(ids[i - 1], ids[i]) + 1);
  }
}

std::string ShortIds::Of(const RouteInfo& info) const {
  const std::string id = Of(info.key.route);
  return info.revision.value() == 0 ? id : fmt::format("{}@{}", id, info.revision.value());
}

}  // namespace trailcast::route
