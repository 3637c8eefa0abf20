#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/route/route.h"
#include "services/view/view_table.h"

namespace trailcast::view {

// Why followers may not recognise where they are.
enum class Weakness {
  kBland,      // too little to hold on to: dark, blank, out of focus
  kUnrelated,  // views in a row that have next to nothing in common: too fast for the frame rate
  kBare,       // too few features to steer by
};

[[nodiscard]] const char* NameOf(Weakness why);  // "bland"

// A stretch of a route, in metres from its beginning, or, where it was taught without odometry, in
// seconds of teaching in motion.
struct WeakPlace {
  double begin = 0.0;
  double end = 0.0;
  Weakness why = Weakness::kBland;
  int features = 0;  // that there are, or that views have in common: the fewest of the stretch

  bool operator==(const WeakPlace&) const = default;
};

// Finds where a taught route is weak, segment by segment from the first on.
class WeakPlaceFinder {
 public:
  // `width_px`: of the scout's pictures.
  explicit WeakPlaceFinder(int width_px) : width_px_(width_px) {}

  void Add(const route::Segment& segment);
  // In the route's order; those that touch each other and are weak for the same reason are one.
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
