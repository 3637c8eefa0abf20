#include "services/route/no_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "services/base/similar_names.h"

namespace trailcast::route {

std::string NoRouteText(const std::string& holder, const std::string& name,
                        const std::vector<std::string>& there) {
  constexpr std::size_t kShown = 10;
  std::string instead = DidYouMean(name, there);
  if (instead.empty()) {
    for (const std::string& each : std::span(there).first(std::min(kShown, there.size()))) {
      instead += (instead.empty() ? "; there is " : ", ") + each;
    }
  }
  return fmt::format("{} has no route '{}'{}", holder, name, instead);
}

}  // namespace trailcast::route
