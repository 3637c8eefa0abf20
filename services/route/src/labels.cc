#include "services/route/labels.h"

namespace trailcast::route {
namespace {

bool IsOldNews(const RouteInfo& news, const RouteInfo& known) {
  if (known.state == RouteState::kComplete) {
    return news.state == RouteState::kTeaching && news.segment_count <= known.segment_count;
  }
  return news.segment_count < known.segment_count;
}

}  // namespace

const char* NameOf(Standing standing) {
  switch (standing) {
    case Standing::kStaged:
      return "staged";
    case Standing::kActive:
      return "active";
    case Standing::kRetired:
      return "retired";
    case Standing::kDeleted:
      return "deleted";
  }
  return "unknown";
}

void TakeLabels(RouteInfo& info, const RouteInfo& from) {
  info.name = from.name;
  info.tags = from.tags;
  info.description = from.description;
  info.standing = from.standing;
  info.edition = from.edition;
}

bool SameTeaching(const RouteInfo& a, const RouteInfo& b) {
  RouteInfo relabelled = a;
  TakeLabels(relabelled, b);
  return relabelled == b;
}

Result<RouteInfo> AfterNews(const RouteInfo& known, const RouteInfo& news) {
  if (known.standing == Standing::kDeleted) return known;
  RouteInfo labelled = known;
  if (news.edition > known.edition) TakeLabels(labelled, news);
  if (labelled.standing == Standing::kDeleted || IsOldNews(news, known)) return labelled;
  if (known.state == RouteState::kComplete) {
    const bool same = news.edition == known.edition ? news == known : SameTeaching(news, known);
    if (same) return labelled;
    return Fail(ErrorCode::kConflict,
                "route {} revision {} is complete with {} segments and cannot change; teach it "
                "again as a new revision",
                known.key.route.value(), known.key.revision.value(), known.segment_count);
  }
  RouteInfo after = news;
  if (news.edition < known.edition) TakeLabels(after, known);
  return after;
}

}  // namespace trailcast::route
