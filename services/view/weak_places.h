#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/route/route.h"
#include "services/view/view_table.h"

namespace trailcast::view {

// This is why followers may not recognise where they are.
enum class Weakness {
  kBland,      // too few features in a view: dark, blank, out of focus
  kUnrelated,  // successive views with next to nothing in common: too fast for the frame rate
  kBare,       // too few features to steer by
};

[[nodiscard]] const char* NameOf(Weakness why);  // "bland"

// This is a section of a route, in metres from its beginning or, if it was taught without odometry,
// in seconds of teaching in motion.
struct WeakPlace {
  double begin = 0.0;
  double end = 0.0;
  Weakness why = Weakness::kBland;
  int features = 0;  // fewest features in the section, or fewest in common to two views

  bool operator==(const WeakPlace&) const = default;
};

// This finds where a taught route is weak, segment by segment from the first on.
class WeakPlaceFinder {
 public:
  // `width_px` is the width of the scout's pictures.
  explicit WeakPlaceFinder(int width_px) : width_px_(width_px) {}

  void Add(const route::Segment& segment);
  // Returns the places in the route's order. Places that touch and are weak for the same reason are
  // merged.
  [[nodiscard]] std::vector<WeakPlace> Places() const;

 private:
  struct View {
    double at = 0.0;
    ViewTable table;
  };
  void AddView(double at, const route::KeyView& view, int fewest_in_common);

  int width_px_;
  double length_ = 0.0;
  std::optional<View> last_;
  double bland_from_ = 0.0;  // halfway between the last two views
  std::vector<WeakPlace> places_;
};

}  // namespace trailcast::view
