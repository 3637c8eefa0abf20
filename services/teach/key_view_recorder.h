#pragma once

#include <cstddef>

#include "services/route/key_view.h"
#include "services/view/view_table.h"

namespace trailcast::teach {

struct KeyViewRecorderOptions {
  // So many features of a view are kept.
  std::size_t features = 40;
  // Of which fewer than this is no view: too dark, too bland.
  std::size_t fewest = 8;
  // The next view is kept when a smaller share of the last one's features is recognised.
  double recognised_share = 0.5;
  // So many of a view's features are from the middle of the picture, half as wide and high, which
  // is all that a camera with a narrow view has of it.
  std::size_t middle_features = 0;

  // For routes with odometry, whose followers know about where they are: half of the bytes.
  [[nodiscard]] static KeyViewRecorderOptions WithOdometry() { return {32, 8, 0.4, 13}; }
};

// Why followers may not recognise where they are by what is seen now.
enum class ViewWeakness {
  kNone,
  kBland,      // too little to hold on to: dark, blank, out of focus
  kUnrelated,  // next to nothing of the last picture is recognised: too fast for the frame rate
};

// Chooses, while a robot is taught, the views by which followers will recognise where they are: as
// many as it takes for each frame in between to be recognised by one of its neighbours.
class KeyViewRecorder {
 public:
  // `width_px`: of the scout's frames.
  explicit KeyViewRecorder(int width_px, const KeyViewRecorderOptions& options = {})
      : options_(options), width_px_(width_px) {}

  // What is seen now, the strongest features first. True: the frame's is to be a key view, which
  // `kept` returns.
  [[nodiscard]] bool Add(const route::View& view);
  // The same, whatever is recognised, unless nothing can be: at the route's end.
  [[nodiscard]] bool Keep(const route::View& view);
  [[nodiscard]] const route::View& kept() const { return kept_; }

  // Of the last key view's features, the share recognised in the last frame added; 0 where there
  // is nothing to hold on to.
  [[nodiscard]] double recognised() const { return recognised_; }
  [[nodiscard]] ViewWeakness weakness() const { return weakness_; }

 private:
  [[nodiscard]] route::View Choose(const route::View& view) const;

  KeyViewRecorderOptions options_;
  int width_px_;
  route::View kept_;
  view::ViewTable table_;  // of `kept_`
  double recognised_ = 0.0;
  int since_kept_ = 0;  // frames
  ViewWeakness weakness_ = ViewWeakness::kNone;
};

}  // namespace trailcast::teach
