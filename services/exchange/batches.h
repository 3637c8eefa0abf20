#pragma once

#include <cstddef>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::exchange {

// Measured: batches of this size recover fastest from packet loss, and none is far above what a
// UDP datagram carries.
inline constexpr std::size_t kBatchBytes = 48U << 10U;

// What a piece costs on the wire: its bytes, its digest, its route.
[[nodiscard]] std::size_t WireSize(const route::SegmentPiece& piece);

// The same pieces in the same order, in batches of one route and at most kBatchBytes each; a larger
// piece is alone.
[[nodiscard]] std::vector<SegmentBatch> SplitBatch(SegmentBatch batch);

}  // namespace trailcast::exchange
