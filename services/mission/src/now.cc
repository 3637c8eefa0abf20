#include "services/mission/now.h"

namespace trailcast::mission {

const char* ToString(NowOrder order) {
  switch (order) {
    case NowOrder::kPause:
      return "pause";
    case NowOrder::kResume:
      return "resume";
    case NowOrder::kCancel:
      return "cancel";
    case NowOrder::kStop:
      return "stop";
    case NowOrder::kEnd:
      return "end";
    case NowOrder::kHome:
      return "home";
    case NowOrder::kRelease:
      return "release";
  }
  return "unknown order";
}

}  // namespace trailcast::mission
