#pragma once

#include <string>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// Returns "staged", "active", "retired" or "deleted".
[[nodiscard]] const char* NameOf(Standing standing);

// Returns the present state of a revision for people: "teaching"; "cut off" or "to be reviewed"
// while that keeps robots from following it; otherwise its standing.
[[nodiscard]] const char* StateText(const RouteInfo& info);

// Returns "teaching 1f of route 0123..", for messages in which no more is known.
[[nodiscard]] std::string Describe(const RouteKey& key);
// Returns "route 'hall' revision 2", for people.
[[nodiscard]] std::string Describe(const RouteInfo& info);
// Returns its number, or "-" while it has none.
[[nodiscard]] std::string RevisionText(const RouteInfo& info);

// Copies the labels of `from` to `info`: name, revision, tags, description, standing, whether it is
// to be reviewed, and edition.
void TakeLabels(RouteInfo& info, const RouteInfo& from);

// Returns whether the labels of `info` replace those of `than`. Deletion comes first, then the
// later edition. Servers that did not hear of each other may reach the same edition; then the
// greater number, standing and so on decide, so that all who hear of both agree.
[[nodiscard]] bool HasLaterLabels(const RouteInfo& info, const RouteInfo& than);

// Returns whether two infos are of the same teaching, that is, equal except for their labels.
[[nodiscard]] bool SameTeaching(const RouteInfo& a, const RouteInfo& b);

// Returns what is known of a revision after `news` of it, because announcements overtake each
// other. The longer teaching and the later labels are kept, and a deleted revision stays deleted.
// Fails with kConflict if a complete revision would change. Both infos have the same key.
[[nodiscard]] Result<RouteInfo> AfterNews(const RouteInfo& known, const RouteInfo& news);

}  // namespace trailcast::route
