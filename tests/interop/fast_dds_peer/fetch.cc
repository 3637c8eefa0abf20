#include <map>

#include "commands.h"
#include "digest.h"
#include "trailcastPubSubTypes.h"

namespace peer {
namespace {

namespace wire = trailcast::wire;

wire::CatalogRoute FindComplete(Bus& bus, const std::string& name) {
  constexpr std::uint8_t kComplete = 1;
  for (const wire::CatalogRoute& route : List(bus, name)) {
    if (route.info().state() == kComplete) return route;
  }
  throw std::runtime_error("no complete route '" + name + "'");
}

bool IsWhole(const wire::SegmentPiece& piece) { return Sha256(piece.bytes()) == piece.digest(); }

}  // namespace

Fetched Fetch(Bus& bus, const std::string& name) {
  constexpr std::size_t kIndicesPerRequest = 1024;
  Inlet<wire::SegmentBatchPubSubType> segments(bus, "trailcast/segments", kStreamed);
  Outlet<wire::SegmentRequestPubSubType> requests(bus, "trailcast/segment_requests", kAsked);
  Fetched fetched{.route = FindComplete(bus, name), .pieces = {}};
  const wire::RouteInfo& info = fetched.route.info();
  std::map<std::uint32_t, wire::SegmentPiece> held;
  const auto ask = [&] {
    wire::SegmentRequest request;
    request.requester(kName);
    request.key(fetched.route.key());
    for (std::uint32_t i = 0; i < info.segment_count(); ++i) {
      if (!held.contains(i) && request.lacking().size() < kIndicesPerRequest) {
        request.lacking().push_back(i);
      }
    }
    requests.Put(request);
  };
  Until(bus, "all segments of '" + name + "'", ask, [&] {
    for (const wire::SegmentBatch& batch : segments.Take()) {
      for (const wire::SegmentPiece& piece : batch.pieces()) {
        if (piece.key() == fetched.route.key() && IsWhole(piece)) held[piece.index()] = piece;
      }
    }
    return held.size() == info.segment_count();
  });
  std::vector<Digest> digests;
  for (const auto& [index, piece] : held) {
    digests.push_back(piece.digest());
    fetched.pieces.push_back(piece);
  }
  if (Manifest(digests) != info.manifest_digest()) {
    throw std::runtime_error("the segments of '" + name + "' are not those of its manifest");
  }
  return fetched;
}

}  // namespace peer
