#include "services/console/src/api/photos_asked.h"

#include <utility>

#include "services/console/network_watch.h"
#include "services/fleet/photo_wish.h"

namespace trailcast::console {

Result<mission::PhotoWish> PhotosAsked(Desk& desk, const PhotosBody& photos) {
  return fleet::PhotoWishFor(photos.every_m, photos.at,
                             [&desk]() -> Result<std::vector<std::string>> {
                               auto answer = AskForNetwork(desk, "");
                               if (!answer) return tl::unexpected(answer.error());
                               return std::move(answer->lines);
                             });
}

}  // namespace trailcast::console
