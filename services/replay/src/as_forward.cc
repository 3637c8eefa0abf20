#include "services/replay/src/as_forward.h"

#include "services/route/backwards.h"

namespace trailcast::replay {

route::Segment AsForward(const route::Segment& segment) {
  route::Segment forward = segment.reverse ? route::FromOtherEnd(segment) : segment;
  forward.key_views.clear();
  return forward;
}

}  // namespace trailcast::replay
