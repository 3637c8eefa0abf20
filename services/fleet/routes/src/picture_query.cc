#include "services/fleet/routes/picture_query.h"

#include "services/vision/view_features.h"

namespace trailcast::fleet {

Result<route::RouteQuery> QueryByPicture(const image::GrayImage& picture, const std::string& name) {
  constexpr std::size_t kTooFew = 8;  // as in teaching
  route::RouteQuery query;
  query.view = vision::DescribeForQuery(picture);
  if (query.view.size() >= kTooFew) return query;
  return Fail(ErrorCode::kInvalidArgument,
              "{} shows too little to be recognised: {} features, expected {} or more", name,
              query.view.size(), kTooFew);
}

}  // namespace trailcast::fleet
