#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// People name a route by its name, which is no identity, as two scouts may have given it, or by its
// id or the beginning of that. "@2" behind it is its revision 2.
struct RouteRef {
  std::string route;           // name or id
  std::uint32_t revision = 0;  // 0 if none was given
};

// Fails with kInvalidArgument, which says what was expected.
[[nodiscard]] Result<RouteRef> ParseRouteRef(const std::string& text);

// A text of at least so many digits counts as an id, and a shorter one is a name.
inline constexpr std::size_t kLeastIdDigits = 7;
// No id has this digit. As text, a beginning with it behind sorts after all ids with that
// beginning.
inline constexpr char kAfterAnyIdDigit = 'g';
[[nodiscard]] bool LooksLikeId(std::string_view name_or_id);

// Returns whether the route has this name or an id that begins so.
[[nodiscard]] bool IsMeantBy(const RouteInfo& info, const std::string& name_or_id);
// Returns the `routes` that are meant. A whole id means its own route alone, even if another route
// has it as a name.
[[nodiscard]] std::vector<RouteInfo> OnlyMeant(std::vector<RouteInfo> routes,
                                               const std::string& name_or_id);

// This shortens ids for people to as many digits as tell these routes apart, kLeastIdDigits at
// least.
class ShortIds {
 public:
  ShortIds() = default;  // for a single route
  explicit ShortIds(std::span<const RouteInfo> routes);

  // Returns "a3f9c21".
  [[nodiscard]] std::string Of(const RouteId& id) const { return id.value().substr(0, digits_); }
  // Returns "a3f9c21@2", or "a3f9c21" while the revision has no number.
  [[nodiscard]] std::string Of(const RouteInfo& info) const;

 private:
  std::size_t digits_ = kLeastIdDigits;
};

}  // namespace trailcast::route
