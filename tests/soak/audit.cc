#include "tests/soak/audit.h"

#include "services/route/digest.h"

namespace trailcast::soak {

Audit::Audit(route::RouteKey key, const std::vector<route::SegmentPiece>& taught,
             Clock::time_point now)
    : taught_(taught),
      fetcher_(AgentId("auditor"), std::move(key), {},
               exchange::Integrity{route::CheckDigest, route::ManifestDigest}, now) {}

void Audit::Handle(const exchange::Message& message, Clock::time_point now) {
  fetcher_.Handle(message, now);
}

std::vector<exchange::Message> Audit::Tick(Clock::time_point now) {
  for (const route::SegmentPiece& piece : fetcher_.TakeArrived()) {
    const std::size_t index = piece.index.value();
    if (index >= taught_.size() || piece != taught_[index]) ++wrong_;
  }
  return fetcher_.Tick(now);
}

}  // namespace trailcast::soak
