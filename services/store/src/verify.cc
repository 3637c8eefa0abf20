#include "services/store/src/verify.h"

#include "services/route/digest.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {

Result<void> VerifyRevision(RouteStore& store, const std::string& name, const route::RouteKey& key,
                            std::vector<std::string>& damage) {
  const Result<std::vector<SegmentIndex>> held = store.HeldSegments(key);
  if (!held) return tl::unexpected(held.error());
  std::vector<std::string> damaged;
  std::vector<route::Digest> digests;
  for (const SegmentIndex index : *held) {
    const Result<route::SegmentPiece> piece = store.ReadSegment(key, index);
    if (piece) {
      if (index.value() == digests.size()) digests.push_back(piece->digest);
    } else if (piece.error().code == ErrorCode::kUnavailable) {
      return tl::unexpected(piece.error());
    } else {
      damaged.push_back(piece.error().message);
    }
  }
  const Result<std::optional<route::RouteInfo>> info = store.FindRoute(key);
  const bool deleted = info && *info && (*info)->standing == route::Standing::kDeleted;
  if (!deleted) damage.insert(damage.end(), damaged.begin(), damaged.end());
  if (!info) return tl::unexpected(info.error());
  if (deleted || !*info) return {};
  if ((*info)->state == route::RouteState::kComplete && digests.size() == (*info)->segment_count &&
      route::ManifestDigest(digests) != (*info)->manifest_digest) {
    damage.push_back(
        fmt::format("route store {}: {} (named '{}'): its {} segments are each whole but not those "
                    "its scout announced",
                    name, Describe(key), (*info)->name, digests.size()));
  }
  return {};
}

}  // namespace trailcast::store
