#pragma once

#include <span>

#include "services/route/key_view.h"

namespace trailcast::view {

// The width that a view's picture is taken to have, where nobody says: what its features span.
[[nodiscard]] double SpannedWidth_px(std::span<const route::ViewFeature> view);

}  // namespace trailcast::view
