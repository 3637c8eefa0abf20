#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "agent/session/src/place/localiser.h"
#include "services/refresh/visit.h"
#include "services/route/route.h"
#include "services/view/view_table.h"

namespace trailcast::agent {

// This watches which key views of the route a robot recognises that is sure of its place. It notes
// recognised and missed ones, and how a place looks that resembles none of them, in the scout's
// pixels. It changes nothing of how the robot is driven. No clock.
class ViewTaker {
 public:
  // Takes the size of the scout's frames.
  ViewTaker(int scout_width_px, int scout_height_px)
      : width_px_(scout_width_px), height_px_(scout_height_px) {}

  // Takes segments in order from the route's first on, as `Localiser::Learn` does.
  void Learn(const route::Segment& segment);
  // Takes each look that `place` has taken while the robot was sure of it.
  void See(const Localiser& place);

  // Adds the results to `visit`, whose segments rise, at the run's end.
  void Take(refresh::Visit& visit) const;

 private:
  // This is a key view of the scout's, with those that followers added there.
  struct Place {
    SegmentIndex segment;
    std::size_t position = 0;  // of the scout's view, in its segment
    bool metric = false;
    std::vector<std::size_t> features;  // for each view
    int looks = 0;
    std::vector<int> agreed;  // for each view, the most in any look
    view::Comparison told;    // of the look in which it was recognised best
    view::ViewTable seen;     // features of that look; empty if it is recognised well
    [[nodiscard]] bool recognised_well() const;
  };

  void Note(const view::ViewTable& seen, Place& at, std::size_t variant,
            const view::Comparison& comparison);
  void NoteWhatStays(const view::ViewTable& seen, const Localiser& place);
  [[nodiscard]] route::View AsTaught(const Place& at) const;
  [[nodiscard]] refresh::Sought Judge(const Place& at, std::size_t variant) const;
  [[nodiscard]] route::View OfferOf(const Place& at) const;

  int width_px_;
  int height_px_;
  std::vector<Place> places_;
  // For each of the route's key views this has its place's position among `places_`, and its own
  // among that one's views.
  std::vector<std::pair<std::size_t, std::size_t>> views_;
  // These features stay at one place of the picture wherever the robot is, as dirt on its lens
  // does, by looks from several places.
  view::ViewTable stays_;
  std::deque<view::ViewTable> last_seen_;  // each from another place
  std::optional<double> last_along_;
};

}  // namespace trailcast::agent
