#pragma once

#include <functional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/mission/orders.h"
#include "services/schedule/schedule.h"

namespace trailcast::fleet {

// Returns the photos that users ask for: one every so many metres, unless that is 0, and one at
// each of `places`, which are ROUTE@METRES or names. `network` is called if there is a name, and
// returns how routes are joined (network/words.h). Fails with kInvalidArgument for a place that is
// neither, and with kNotFound for a name that no place has.
[[nodiscard]] Result<mission::PhotoWish> PhotoWishFor(
    double every_m, const std::vector<std::string>& places,
    const std::function<Result<std::vector<std::string>>()>& network);

// Returns the orders of a mission that takes these photos, too. Fails with kInvalidArgument if a
// mission cannot hold all of it.
[[nodiscard]] Result<std::string> OrdersWithPhotos(const std::string& orders,
                                                   const mission::PhotoWish& wish);
// Returns a schedule of such missions. It fails likewise.
[[nodiscard]] Result<schedule::Schedule> ScheduleWithPhotos(schedule::Schedule schedule,
                                                            const mission::PhotoWish& wish);

}  // namespace trailcast::fleet
