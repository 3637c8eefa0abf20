#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/network/lanes.h"
#include "services/network/network.h"

namespace trailcast::network {

// What an operator changes, in words:
//   join PLACE PLACE [both] [offset AHEAD,LEFT] [heading DEGREES]   one may change over from the
//                                                                   first to the second; both: and
//                                                                   back; how the second lies there
//   part PLACE PLACE                                                no more, neither way
//   close ROUTE [FROM..TO]     nobody is sent along it
//   open ROUTE [FROM..TO]
//   back ROUTE [FROM..TO]      robots may be sent backwards along it, too, one at a time: it is
//                              narrow there from now on
//   ahead ROUTE [FROM..TO]     no more
//   limit ROUTE [FROM..TO] [speed F] [cost F]   F times the taught speed at most; a metre counts as
//                                               F; neither: no limit any more
//   narrow ROUTE FROM..TO [ROUTE FROM..TO ...]   robots cannot pass each other there; the parts are
//                                                one place, which several routes lead through
//   wide ROUTE [FROM..TO]      they can: of each narrow place of which a part lies there
//   vacate ROUTE [FROM..TO]    whoever has such a place is not in it any more
//   name NAME PLACE            it is called so; whatever was called so no longer is
//   forget NAME
//   confirm PLACE PLACE        the joint that the server proposes there is made
//   confirm all [above F]      all that it proposes, or that are so sure
//   refuse PLACE PLACE         it is not made, and not proposed again
//   refuse all [below F]
// A PLACE is ROUTE@METRES, a ROUTE a name or id, with @REVISION behind it where that is not the one
// that is followed; FROM..TO metres along it, either may be missing.
struct Edit {
  enum class Kind {
    kJoin,
    kPart,
    kClose,
    kOpen,
    kBack,
    kAhead,
    kLimit,
    kNarrow,
    kWide,
    kVacate,
    kName,
    kForget,
    kConfirm,
    kRefuse
  };
  Kind kind = Kind::kJoin;
  Joint joint{};          // of kJoin and kPart; of kConfirm and kRefuse, but for `all`
  Condition condition{};  // of kClose, kOpen, kBack, kAhead and kLimit; of kWide and kVacate where
                          // that is
  Lane lane{};            // of kNarrow
  NamedPlace named{};     // of kName; of kForget its name alone
  struct Sure {
    double least = 0.0;
    double most = 1.0;
  };
  std::optional<Sure> all{};  // of kConfirm and kRefuse: whatever is so sure, not one joint
};

// A joint that a server has found by what scouts saw, and nobody has confirmed.
struct Proposal {
  Joint joint{};
  double confidence = 0.0;  // 0.5 to 1
  bool operator==(const Proposal&) const = default;
};

// A stretch where robots lost their path lately, and ways are longer for it.
struct LostStretch {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;    // above from_m
  double passed = 0.0;  // times; what is long ago counts in part
  double lost = 0.0;    // of these
  double cost = 1.0;    // a metre counts as so many
  bool operator==(const LostStretch&) const = default;
};

// Of a condition that ends where its route does.
inline constexpr double kToTheEnd_m = 1e7;

// kInvalidArgument, with the word that was not understood and what was expected.
[[nodiscard]] Result<Edit> ParseEdit(std::string_view words);

// A line of what a server lists: a route that it names, "route ROUTE METRES", what is so, as the
// edit that brings it about, what it proposes, or where robots were lost. Of a line that a later
// version may have, nothing.
struct Listed {
  bool used = true;              // false: of a revision that robots do not follow
  std::optional<Route> route{};  // its name and length
  std::optional<Edit> edit{};
  std::optional<Proposal> proposal{};   // "proposed join PLACE PLACE .. confidence F"
  std::optional<LostStretch> lost{};    // "lost ROUTE FROM..TO N of M cost F"
  std::vector<std::string> taken_by{};  // of a narrow place, "narrow .., taken by robot1 robot2"
};
[[nodiscard]] Listed ParseListed(std::string_view line);
// Before an edit that is not used.
inline constexpr std::string_view kUnused = "unused ";
inline constexpr std::string_view kTakenBy = ", taken by ";

// A PLACE, or what one is called: then `name` alone is set.
struct Goal {
  std::string name{};
  Place place{};
  bool operator==(const Goal&) const = default;
};
// A name is up to 64 bytes without blanks and '@'.
[[nodiscard]] Result<Goal> ParseGoal(std::string_view word);

// "way FROM TO": which way leads there, from a goal or, before one of that name, from where a robot
// last said that it stands.
struct Question {
  Goal from{};
  Goal to{};
};
[[nodiscard]] Result<Question> ParseQuestion(std::string_view words);

// "hall@12", "hall@2@12".
[[nodiscard]] Result<Place> ParsePlace(std::string_view word);
[[nodiscard]] std::string ToText(const Place& place);
[[nodiscard]] std::string ToText(const Route& route);       // "route .."
[[nodiscard]] std::string ToText(const NamedPlace& named);  // "name .."
[[nodiscard]] std::string ToText(const Joint& joint);       // "join .."
[[nodiscard]] std::string ToText(
    const Condition& condition);                             // "close ..", "back .." or "limit .."
[[nodiscard]] std::string ToText(const Proposal& proposal);  // "proposed join .."
[[nodiscard]] std::string ToText(const Lane& lane);          // "narrow .."
[[nodiscard]] std::string ToText(const LostStretch& lost);   // "lost .."
// Says for people: "lost hall 5..10 2 of 7 times lately, a metre counts as 1.9".
[[nodiscard]] std::string Describe(const LostStretch& lost);

// What holds after such an edit: of one kind, a closed stretch, one that is driven backwards, too,
// or a limit, one at each place.
[[nodiscard]] std::vector<Condition> Amended(std::vector<Condition> conditions, const Edit& edit);

}  // namespace trailcast::network
