#pragma once

#include <span>

#include "services/route/key_view.h"

namespace trailcast::view {

// Returns what a view's features span, which is assumed to be the width of a picture whose width is
// not given.
[[nodiscard]] double SpannedWidth_px(std::span<const route::ViewFeature> view);

}  // namespace trailcast::view
