#pragma once

#include <functional>
#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::exchange {

// How bytes are told from damaged ones: route::CheckDigest and route::ManifestDigest, given by the
// owner so that the protocol can be tested without hashing.
struct Integrity {
  std::function<Result<void>(const route::SegmentPiece&)> check_piece;
  std::function<route::Digest(std::span<const route::Digest>)> manifest;
};

}  // namespace trailcast::exchange
