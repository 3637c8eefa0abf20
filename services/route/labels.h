#pragma once

#include <string>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// "staged", "active", "retired", "deleted".
[[nodiscard]] const char* NameOf(Standing standing);

// What a revision is at present, for people: "teaching"; "cut off" or "to be reviewed" while that
// keeps it from being followed; or its standing.
[[nodiscard]] const char* StateText(const RouteInfo& info);

// "teaching 1f of route 0123..", for messages where no more is known.
[[nodiscard]] std::string Describe(const RouteKey& key);
// "route 'hall' revision 2", for people.
[[nodiscard]] std::string Describe(const RouteInfo& info);
// Its number, or "-" while it has none.
[[nodiscard]] std::string RevisionText(const RouteInfo& info);

// The labels of `info` become those of `from`: name, revision, tags, description, standing, whether
// it is to be reviewed, and edition.
void TakeLabels(RouteInfo& info, const RouteInfo& from);

// Whether those of `info` count: that it is deleted, or else the later edition; of one edition, to
// which servers that did not hear of each other may each have come, the greater number, standing
// and so on, so that all who hear of both agree.
[[nodiscard]] bool HasLaterLabels(const RouteInfo& info, const RouteInfo& than);

// Whether two infos are of the same teaching: equal but for their labels.
[[nodiscard]] bool SameTeaching(const RouteInfo& a, const RouteInfo& b);

// What is known of a revision once `news` of it arrived; announcements overtake each other. Of what
// was taught the longer counts, of the labels the later ones; what is deleted stays deleted.
// kConflict when a complete revision would change. Both have the same key.
[[nodiscard]] Result<RouteInfo> AfterNews(const RouteInfo& known, const RouteInfo& news);

}  // namespace trailcast::route
