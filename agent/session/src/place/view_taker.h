#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "agent/session/src/place/place_keeper.h"
#include "services/refresh/visit.h"
#include "services/route/route.h"
#include "services/view/view_table.h"

namespace trailcast::agent {

// Watches what a robot that is sure of its place recognises of the route's key views, and notes
// which it did, which it did not, and how a place looks to it that looks unlike all of them, told
// in the scout's pixels. Changes nothing of how the robot is driven. No clock.
class ViewTaker {
 public:
  // Of the scout's frames.
  ViewTaker(int scout_width_px, int scout_height_px)
      : width_px_(scout_width_px), height_px_(scout_height_px) {}

  // In order from the route's first on, as `PlaceKeeper::Learn`.
  void Learn(const route::Segment& segment);
  // Each look that `place` has taken while the robot was sure of it.
  void See(const PlaceKeeper& place);

  // At the run's end: what was met with is added to `visit`, whose segments rise.
  void Take(refresh::Visit& visit) const;

 private:
  // A key view of the scout's, and those that followers added there.
  struct Place {
    SegmentIndex segment;
    std::size_t position = 0;  // of the scout's, in its segment
    bool metric = false;
    std::vector<std::size_t> features;  // of each view
    int looks = 0;
    std::vector<int> agreed;  // of each view, the most in any look
    view::Comparison told;    // with what was seen in the look by which it was told best
    view::ViewTable seen;     // what was; none: it is recognised well
    [[nodiscard]] bool recognised_well() const;
  };

  void Note(const view::ViewTable& seen, Place& at, std::size_t variant,
            const view::Comparison& comparison);
  void NoteWhatStays(const view::ViewTable& seen, const PlaceKeeper& place);
  [[nodiscard]] route::View AsTaught(const Place& at) const;
  [[nodiscard]] refresh::Sought Judge(const Place& at, std::size_t variant) const;
  [[nodiscard]] route::View OfferOf(const Place& at) const;

  int width_px_;
  int height_px_;
  std::vector<Place> places_;
  // Of each of the route's key views: its place's position among `places_`, and its own among that
  // one's views.
  std::vector<std::pair<std::size_t, std::size_t>> views_;
  // What lies at one place of the picture wherever the robot is, as dirt on its lens does, by the
  // looks of one place and another.
  view::ViewTable stays_;
  std::deque<view::ViewTable> last_seen_;  // from elsewhere, each
  std::optional<double> last_along_;
};

}  // namespace trailcast::agent
