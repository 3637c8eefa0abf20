#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// How people say which route they mean: by its name, which is no identity (two scouts may have
// given it); or by its id, or the beginning of that. "@2" behind it is its revision 2.
struct RouteRef {
  std::string route;           // name or id
  std::uint32_t revision = 0;  // 0: none was said
};

// kInvalidArgument, with what was expected.
[[nodiscard]] Result<RouteRef> ParseRouteRef(const std::string& text);

// So much of an id is enough to be taken for one; what is shorter is a name.
inline constexpr std::size_t kLeastIdDigits = 7;
// What no id may begin with, as text, and above all that begins with the same digits.
inline constexpr char kAfterAnyIdDigit = 'g';
[[nodiscard]] bool LooksLikeId(std::string_view name_or_id);

// Whether it has this name, or its id begins so.
[[nodiscard]] bool IsMeantBy(const RouteInfo& info, const std::string& name_or_id);
// Those of `routes` that are meant; of a whole id only its own route is, whatever others are
// called.
[[nodiscard]] std::vector<RouteInfo> OnlyMeant(std::vector<RouteInfo> routes,
                                               const std::string& name_or_id);

// Ids as people are shown them: as many of their digits as tell these routes apart, kLeastIdDigits
// at least.
class ShortIds {
 public:
  ShortIds() = default;  // of a route alone
  explicit ShortIds(std::span<const RouteInfo> routes);

  // "a3f9c21"
  [[nodiscard]] std::string Of(const RouteId& id) const { return id.value().substr(0, digits_); }
  // "a3f9c21@2", or "a3f9c21" while the revision has no number.
  [[nodiscard]] std::string Of(const RouteInfo& info) const;

 private:
  std::size_t digits_ = kLeastIdDigits;
};

}  // namespace trailcast::route
