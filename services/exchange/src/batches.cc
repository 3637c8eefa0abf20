#include "services/exchange/batches.h"

#include <utility>

namespace trailcast::exchange {

std::size_t WireSize(const route::SegmentPiece& piece) {
  constexpr std::size_t kFixed = 64;  // digest, index, teaching, lengths, alignment
  return kFixed + piece.key.route.value().size() + piece.bytes.size();
}

std::vector<SegmentBatch> SplitBatch(SegmentBatch batch) {
  std::vector<SegmentBatch> batches;
  std::size_t size = 0;
  for (route::SegmentPiece& piece : batch.pieces) {
    const std::size_t piece_size = WireSize(piece);
    if (batches.empty() || size + piece_size > kBatchBytes ||
        batches.back().pieces.front().key != piece.key) {
      batches.push_back({.sender = batch.sender, .pieces = {}});
      size = 0;
    }
    size += piece_size;
    batches.back().pieces.push_back(std::move(piece));
  }
  return batches;
}

}  // namespace trailcast::exchange
