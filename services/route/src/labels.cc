#include "services/route/labels.h"

#include <tuple>

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

const char* StateText(const RouteInfo& info) {
  const bool settled = info.standing == Standing::kRetired || info.standing == Standing::kDeleted;
  if (!settled && info.state == RouteState::kTeaching) return "teaching";
  if (info.standing == Standing::kStaged && info.held_back()) {
    if (!info.to_review) return "cut off";
    return info.cut_off ? "cut off, to be reviewed" : "to be reviewed";
  }
  return NameOf(info.standing);
}

std::string Describe(const RouteKey& key) {
  return fmt::format("teaching {:x} of route {}", key.teaching.value(), key.route.value());
}

std::string Describe(const RouteInfo& info) {
  return fmt::format("route '{}' revision {}", info.name, RevisionText(info));
}

std::string RevisionText(const RouteInfo& info) {
  return info.revision.value() == 0 ? "-" : std::to_string(info.revision.value());
}

void TakeLabels(RouteInfo& info, const RouteInfo& from) {
  info.name = from.name;
  info.revision = from.revision;
  info.tags = from.tags;
  info.description = from.description;
  info.standing = from.standing;
  info.to_review = from.to_review;
  info.edition = from.edition;
}

bool HasLaterLabels(const RouteInfo& info, const RouteInfo& than) {
  const auto is_deleted = [](const RouteInfo& each) { return each.standing == Standing::kDeleted; };
  if (is_deleted(info) != is_deleted(than)) return is_deleted(info);
  const auto rank = [](const RouteInfo& each) {
    return std::tuple(each.edition, each.revision, each.standing, !each.to_review,
                      std::tie(each.name, each.tags, each.description));
  };
  return rank(than) < rank(info);
}

bool SameTeaching(const RouteInfo& a, const RouteInfo& b) {
  RouteInfo relabelled = a;
  TakeLabels(relabelled, b);
  return relabelled == b;
}

Result<RouteInfo> AfterNews(const RouteInfo& known, const RouteInfo& news) {
  if (known.standing == Standing::kDeleted) return known;
  RouteInfo labelled = known;
  if (HasLaterLabels(news, known)) TakeLabels(labelled, news);
  if (labelled.standing == Standing::kDeleted || IsOldNews(news, known)) return labelled;
  if (known.state == RouteState::kComplete) {
    if (SameTeaching(news, known)) return labelled;
    return Fail(ErrorCode::kConflict,
                "{} is complete with {} segments and cannot change; teach it again",
                Describe(known), known.segment_count);
  }
  RouteInfo after = news;
  if (HasLaterLabels(known, news)) TakeLabels(after, known);
  return after;
}

}  // namespace trailcast::route
