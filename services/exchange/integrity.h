#pragma once

#include <functional>
#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::exchange {

// These functions tell whether bytes are damaged. The owner passes route::CheckDigest and
// route::ManifestDigest, so that tests of the protocol need no hashing.
struct Integrity {
  std::function<Result<void>(const route::SegmentPiece&)> check_piece;
  std::function<route::Digest(std::span<const route::Digest>)> manifest;
};

}  // namespace trailcast::exchange
