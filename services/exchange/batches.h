#pragma once

#include <cstddef>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::exchange {

// Measurements show that batches of this size recover fastest from packet loss. None is far larger
// than a UDP datagram.
inline constexpr std::size_t kBatchBytes = 48U << 10U;

// Returns what a piece costs on the wire with its bytes, its digest and its route.
[[nodiscard]] std::size_t WireSize(const route::SegmentPiece& piece);

// Returns the same pieces in the same order, in batches of one route and at most kBatchBytes each.
// A larger piece has a batch of its own.
[[nodiscard]] std::vector<SegmentBatch> SplitBatch(SegmentBatch batch);

}  // namespace trailcast::exchange
