#include "services/fleet/photo_wish.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <optional>
#include <utility>

#include "services/exchange/bounds.h"
#include "services/network/words.h"

namespace trailcast::fleet {
namespace {

// Returns all named places, as orders have them: "dock=hall@12".
std::map<std::string, std::string> NamedPlaces(const std::vector<std::string>& lines) {
  std::map<std::string, std::string> places;
  for (const std::string& line : lines) {
    const network::Listed listed = network::ParseListed(line);
    if (!listed.edit || listed.edit->kind != network::Edit::Kind::kName) continue;
    const network::NamedPlace& named = listed.edit->named;
    places[named.name] = fmt::format("{}={}", named.name, ToText(named.place));
  }
  return places;
}

}  // namespace

Result<mission::PhotoWish> PhotoWishFor(
    double every_m, const std::vector<std::string>& places,
    const std::function<Result<std::vector<std::string>>()>& network) {
  mission::PhotoWish wish{.every_m = every_m};
  std::optional<std::map<std::string, std::string>> named;
  for (const std::string& place : places) {
    std::string word = place;
    if (place.find('@') == std::string::npos) {
      if (!named) {
        const auto lines = network();
        if (!lines) return tl::unexpected(lines.error());
        named = NamedPlaces(*lines);
      }
      const auto found = named->find(place);
      if (found == named->end()) {
        std::vector<std::string> names;
        for (const auto& [name, is] : *named) names.push_back(name);
        return Fail(
            ErrorCode::kNotFound,
            "no place is called '{}': {}, and 'trailcast network name' names one; "
            "ROUTE@METRES, as hall@12.5, needs no name",
            place,
            names.empty() ? "there are none" : fmt::format("there are {}", fmt::join(names, ", ")));
      }
      word = found->second;
    }
    auto parsed = mission::ParsePhotoPlace(word);
    if (!parsed) return tl::unexpected(parsed.error());
    wish.at.push_back(*std::move(parsed));
  }
  return wish;
}

Result<std::string> OrdersWithPhotos(const std::string& orders, const mission::PhotoWish& wish) {
  if (!wish.any()) return orders;
  const auto tasks = mission::ParseOrders(orders);
  if (!tasks) return tl::unexpected(tasks.error());
  auto going = mission::GoingIn(orders);
  if (going) going->photos = wish;
  // Words that ask for no photos yet stay as they were typed.
  const bool asked = mission::PhotosIn(orders).any();
  std::string with =
      going ? ToText(*going, *tasks)
            : fmt::format("{} {}", ToText(wish), asked ? mission::ToText(*tasks) : orders);
  if (const auto understood = mission::ParseOrders(with); !understood) {
    return tl::unexpected(understood.error());
  }
  if (with.size() <= exchange::kMaxLineBytes) return with;
  return Fail(ErrorCode::kInvalidArgument,
              "the orders are too long by {} bytes: ask for photos at fewer places, or use shorter "
              "names",
              with.size() - exchange::kMaxLineBytes);
}

Result<schedule::Schedule> ScheduleWithPhotos(schedule::Schedule schedule,
                                              const mission::PhotoWish& wish) {
  if (!wish.any()) return schedule;
  auto orders = OrdersWithPhotos(MissionOrders(schedule), wish);
  if (!orders) return tl::unexpected(orders.error());
  schedule.orders = schedule::ScheduleOrders(*std::move(orders));
  return schedule;
}

}  // namespace trailcast::fleet
