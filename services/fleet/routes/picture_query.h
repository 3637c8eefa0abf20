#pragma once

#include <string>

#include "services/base/result.h"
#include "services/image/image.h"
#include "services/route/route_query.h"

namespace trailcast::fleet {

// Returns a query for where on which route a picture of a robot's camera, or of a similar one, was
// taken. Fails with kInvalidArgument if the picture shows too little to be recognised. `name` is
// the picture's.
[[nodiscard]] Result<route::RouteQuery> QueryByPicture(const image::GrayImage& picture,
                                                       const std::string& name);

}  // namespace trailcast::fleet
