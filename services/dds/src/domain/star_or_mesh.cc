#include "services/dds/src/domain/star_or_mesh.h"

#include <algorithm>

namespace trailcast::dds {

void StarOrMesh::Begin(Time now) {
  began_ = now;
  met_ = false;
  servers_.Clear();
  return_at_.reset();
  call_after_ = kCallsFrom;
  call_at_ = now + call_after_;
}

StarOrMesh::Step StarOrMesh::Look(const Seen& seen, Time now) {
  const bool served = !servers_.empty() || (seen.server && !met_);
  if (star_) {
    if (served) {
      met_ = true;
      call_after_ = kCallsFrom;
      call_at_ = now + call_after_;
      return Step::kNone;
    }
    const auto looks = seen.anybody ? kLooksLonger : kLooks;
    if (wanted_ == Discovery::kAuto && !met_ && now - began_ >= looks) {
      star_ = false;
      return Step::kJoinAnew;
    }
    if (now < call_at_) return Step::kNone;
    call_after_ = std::min<Clock::duration>(2 * call_after_, kCallsUntil);
    call_at_ = now + call_after_;
    return Step::kCall;
  }
  if (wanted_ == Discovery::kMesh) return Step::kNone;
  if (!served) {
    return_at_.reset();
  } else if (!return_at_) {
    const auto spread = (kReturnsUntil - kReturnsFrom) * share_;
    return_at_ = now + kReturnsFrom + std::chrono::duration_cast<Clock::duration>(spread);
  } else if (now >= *return_at_) {
    star_ = true;
    return Step::kJoinAnew;
  }
  return Step::kNone;
}

}  // namespace trailcast::dds
