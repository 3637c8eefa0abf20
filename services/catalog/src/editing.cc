#include "services/catalog/editing.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "services/exchange/bounds.h"
#include "services/exchange/route_finder.h"
#include "services/route/labels.h"

namespace trailcast::catalog {
namespace {

using route::EditAction;
using route::RouteEdit;
using route::RouteInfo;
using route::Standing;
using Revisions = std::vector<RouteInfo>;

std::set<std::string> IdsOf(const Revisions& revisions) {
  std::set<std::string> ids;
  for (const RouteInfo& info : revisions) ids.insert(info.key.route.value());
  return ids;
}

// Returns all revisions of the route that is meant, rising.
Result<Revisions> FindMeant(const std::string& name_or_id, store::RouteStore& store) {
  const auto meant = store.FindMeant(name_or_id);
  if (!meant) return tl::unexpected(meant.error());
  std::map<RouteId, RouteInfo> newest;
  for (const RouteInfo& info : *meant) {
    const auto [at, is_first] = newest.try_emplace(info.key.route, info);
    if (at->second.revision < info.revision) at->second = info;
  }
  if (newest.empty()) {
    return Fail(ErrorCode::kNotFound, "there is no route '{}'", name_or_id);
  }
  if (newest.size() == 1) return store.FindRevisions(newest.begin()->first);
  Revisions rivals;
  for (const auto& [id, info] : newest) rivals.push_back(info);
  return exchange::Ambiguous(name_or_id, rivals);
}

// Returns the revisions that the edit addresses: one, or all.
Result<std::vector<RouteInfo*>> Addressed(const RouteEdit& edit, Revisions& revisions) {
  std::vector<RouteInfo*> addressed;
  std::vector<std::uint32_t> there;
  for (RouteInfo& info : revisions) {
    there.push_back(info.revision.value());
    if (edit.revision == 0 || info.revision.value() == edit.revision) {
      addressed.push_back(&info);
    }
  }
  if (!addressed.empty()) return addressed;
  return Fail(ErrorCode::kNotFound, "route '{}' has no revision {}: there is {}", edit.route,
              edit.revision, fmt::join(there, ", "));
}

bool IsActive(const RouteInfo& info) { return info.standing == Standing::kActive; }

// Returns the newest revision below `end` that can be followed to its end. Retired revisions and
// those that are held back are chosen only by number.
RouteInfo* NewestComplete(Revisions& revisions, std::uint32_t end) {
  RouteInfo* newest = nullptr;
  for (RouteInfo& info : revisions) {
    const bool usable = info.state == route::RouteState::kComplete && !info.held_back() &&
                        info.standing != Standing::kRetired;
    if (usable && info.revision.value() < end) newest = &info;
  }
  return newest;
}

void MakeActive(RouteInfo& chosen, Revisions& revisions) {
  if (IsActive(chosen) && !chosen.to_review) return;
  for (RouteInfo& info : revisions) {
    if (IsActive(info)) info.standing = Standing::kStaged;
  }
  chosen.standing = Standing::kActive;
  chosen.to_review = false;
  // The edition exceeds all that is known. If servers without contact have each activated a
  // revision, the one that was activated last counts (exchange::Disagreements).
  for (const RouteInfo& info : revisions) chosen.edition = std::max(chosen.edition, info.edition);
}

Result<void> Activate(const RouteEdit& edit, Revisions& revisions) {
  RouteInfo* chosen = NewestComplete(revisions, std::numeric_limits<std::uint32_t>::max());
  if (edit.revision != 0) {
    const auto addressed = Addressed(edit, revisions);
    if (!addressed) return tl::unexpected(addressed.error());
    chosen = addressed->front();
  }
  const bool by_number =
      chosen == nullptr && std::any_of(revisions.begin(), revisions.end(), [](const auto& info) {
        return info.standing == Standing::kRetired || info.held_back();
      });
  if (by_number) {
    return Fail(ErrorCode::kConflict,
                "route '{}' has only revisions that are retired, were cut off or are to be "
                "reviewed: say which to take with its number",
                edit.route);
  }
  if (chosen == nullptr || chosen->state != route::RouteState::kComplete) {
    return Fail(ErrorCode::kConflict,
                "route '{}' has no complete revision{}: it can be activated when all of it is here",
                edit.route, edit.revision == 0 ? "" : fmt::format(" {}", edit.revision));
  }
  MakeActive(*chosen, revisions);
  return {};
}

Result<void> RollBack(const RouteEdit& edit, Revisions& revisions) {
  const auto active = std::find_if(revisions.begin(), revisions.end(), IsActive);
  if (active == revisions.end()) {
    return Fail(ErrorCode::kConflict, "route '{}' has no active revision: activate one",
                edit.route);
  }
  RouteInfo* earlier = NewestComplete(revisions, active->revision.value());
  if (earlier == nullptr) {
    return Fail(ErrorCode::kConflict,
                "route '{}' has no complete revision before {}, the active one", edit.route,
                active->revision.value());
  }
  MakeActive(*earlier, revisions);
  return {};
}

Result<void> Rename(const RouteEdit& edit, Revisions& revisions, store::RouteStore& store) {
  const auto named = store.FindRoutesByName(edit.text);
  if (!named) return tl::unexpected(named.error());
  const std::set<std::string> ids = IdsOf(*named);
  if (!ids.empty() && ids != IdsOf(revisions)) {
    return Fail(ErrorCode::kConflict, "there is another route '{}' already", edit.text);
  }
  for (RouteInfo& info : revisions) info.name = edit.text;
  return {};
}

Result<void> ChangeTags(const RouteEdit& edit, RouteInfo& info) {
  std::set<std::string> tags(info.tags.begin(), info.tags.end());
  for (const std::string& tag : edit.tags) {
    edit.action == EditAction::kTag ? static_cast<void>(tags.insert(tag))
                                    : static_cast<void>(tags.erase(tag));
  }
  if (tags.size() > route::kMaxTags) {
    return Fail(ErrorCode::kInvalidArgument, "revision {} would have {} tags, at most {} are kept",
                info.revision.value(), tags.size(), route::kMaxTags);
  }
  info.tags.assign(tags.begin(), tags.end());
  return {};
}

Result<void> Delete(const RouteEdit& edit, RouteInfo& info) {
  if (edit.revision != 0 && IsActive(info)) {
    return Fail(ErrorCode::kConflict,
                "revision {} of route '{}' is the active one: activate another or retire it first",
                edit.revision, edit.route);
  }
  info.standing = Standing::kDeleted;
  return {};
}

Result<void> ChangeOne(const RouteEdit& edit, RouteInfo& info) {
  switch (edit.action) {
    case EditAction::kTag:
    case EditAction::kUntag:
      return ChangeTags(edit, info);
    case EditAction::kDescribe:
      info.description = edit.text;
      return {};
    case EditAction::kRetire:
      info.standing = Standing::kRetired;
      return {};
    default:
      return Delete(edit, info);
  }
}

Result<void> Change(const RouteEdit& edit, Revisions& revisions, store::RouteStore& store) {
  if (edit.action == EditAction::kActivate) return Activate(edit, revisions);
  if (edit.action == EditAction::kRollBack) return RollBack(edit, revisions);
  if (edit.action == EditAction::kRename) return Rename(edit, revisions, store);
  const auto addressed = Addressed(edit, revisions);
  if (!addressed) return tl::unexpected(addressed.error());
  for (RouteInfo* info : *addressed) {
    if (auto changed = ChangeOne(edit, *info); !changed) return changed;
  }
  return {};
}

}  // namespace

Result<std::vector<RouteInfo>> PlanEdit(const RouteEdit& edit, store::RouteStore& store) {
  if (auto possible = exchange::CheckEdit(edit); !possible) {
    return tl::unexpected(possible.error());
  }
  const auto before = FindMeant(edit.route, store);
  if (!before) return before;
  Revisions after = *before;
  if (auto changed = Change(edit, after, store); !changed) return tl::unexpected(changed.error());
  Revisions changes;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] == (*before)[i]) continue;
    ++after[i].edition;
    changes.push_back(std::move(after[i]));
  }
  return changes;
}

}  // namespace trailcast::catalog
