#include "services/tool/commands/photo_options.h"

#include "services/base/time.h"
#include "services/fleet/network_client.h"
#include "services/fleet/photo_wish.h"

namespace trailcast::tool {

void AddPhotoOptions(CLI::App& app, PhotoOptions& options) {
  app.add_option("--photo-every", options.every_m,
                 "Photos at every so many metres along each route, from its beginning, so that "
                 "all visits have theirs at the same places")
      ->check(CLI::Range(0.2, 1e4));
  app.add_option("--photo-at", options.at,
                 "A photo at this place, ROUTE@METRES or a name; may be given several times")
      ->take_all()
      ->allow_extra_args(false);
}

Result<mission::PhotoWish> WishOf(const PhotoOptions& options, fleet::OperatorPeer& peer,
                                  double timeout_s) {
  return fleet::PhotoWishFor(options.every_m, options.at, [&] {
    return fleet::AskForNetwork(*peer.exchange, peer.self, ToMilliseconds(timeout_s));
  });
}

}  // namespace trailcast::tool
