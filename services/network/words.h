#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/network/lanes.h"
#include "services/network/network.h"

namespace trailcast::network {

// These are the words by which an operator changes the network:
//   join PLACE PLACE [both] [offset AHEAD,LEFT] [heading DEGREES]
//                              adds a junction from the first to the second, and back with "both";
//                              the rest says how the second lies there
//   part PLACE PLACE           removes the junction, in both directions
//   close ROUTE [FROM..TO]     robots are not sent along it
//   open ROUTE [FROM..TO]
//   back ROUTE [FROM..TO]      allows reverse driving there, one robot at a time: it is
//                              narrow there from now on
//   ahead ROUTE [FROM..TO]     forbids it again
//   limit ROUTE [FROM..TO] [speed F] [cost F]
//                              limits speed to F times the taught one; a metre costs as F; neither
//                              removes the limit
//   narrow ROUTE FROM..TO [ROUTE FROM..TO ...]
//                              robots cannot pass each other there; the parts are one zone, which
//                              several routes lead through
//   wide ROUTE [FROM..TO]      removes each narrow place that has a part there
//   vacate ROUTE [FROM..TO]    releases such a place by force from the robot that holds it
//   name NAME PLACE [home] [dock]
//                              names a place; the name moves if another place had it; with "home",
//                              it is one of the places to which the goal "home" leads; with "dock",
//                              robots charge there, one at a time
//   forget NAME
//   charge below PERCENT [until PERCENT]
//                              robots with less battery go to a dock after their mission, and go on
//                              with their queue at the second percentage, which is 90 if it is
//                              missing
//   charge never               robots are not sent to docks by themselves, which is the default
//   confirm PLACE PLACE        makes the junction that the server proposes there
//   confirm all [above F]      makes all proposed ones, or those of at least this confidence
//   refuse PLACE PLACE         drops the proposal, and does not make it again
//   refuse all [below F]
// A PLACE is ROUTE@METRES. A ROUTE is a name or id, with @REVISION behind it unless it is the
// followed one. FROM..TO is in metres along it, and either may be missing.
struct ChargeLimits {
  static constexpr int kUsualUntil_percent = 90;
  int below_percent = 0;
  int until_percent = kUsualUntil_percent;  // above the first
  bool operator==(const ChargeLimits&) const = default;
};

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
    kCharge,
    kConfirm,
    kRefuse
  };
  Kind kind = Kind::kJoin;
  Junction junction{};  // of kJoin and kPart; of kConfirm and kRefuse without `all`
  // This is of kClose, kOpen, kBack, kAhead and kLimit. It is the section of kWide and kVacate.
  Condition condition{};
  Lane lane{};                           // of kNarrow
  NamedPlace named{};                    // of kName; only the name of kForget
  std::optional<ChargeLimits> charge{};  // of kCharge; empty for never
  struct Sure {
    double least = 0.0;
    double most = 1.0;
  };
  std::optional<Sure> all{};  // of kConfirm and kRefuse: the bound, in place of one junction
};

// This is a junction that a server has found by what scouts saw, and that no operator has
// confirmed.
struct Proposal {
  Junction junction{};
  double confidence = 0.0;  // 0.5 to 1
  bool operator==(const Proposal&) const = default;
};

// This is a section where robots lost their path lately, so that paths over it cost more.
struct LostSection {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;    // above from_m
  double passed = 0.0;  // times; long ago counts in part
  double lost = 0.0;    // number of these
  double cost = 1.0;    // cost of a metre in metres
  bool operator==(const LostSection&) const = default;
};

// This tells that a robot charges, or why it does not yet.
struct Charging {
  std::string robot{};
  std::string text{};  // one line for people; it begins with kChargesAt while the robot charges
  bool operator==(const Charging&) const = default;
};
inline constexpr std::string_view kChargesAt = "charges at ";
// This question asks for the lines of those alone.
inline constexpr std::string_view kAsksCharging = "charging";

// This is the end of a condition that ends where its route does.
inline constexpr double kToTheEnd_m = 1e7;

// Returns kInvalidArgument with the word that was not understood and what was expected.
[[nodiscard]] Result<Edit> ParseEdit(std::string_view words);

// This is a line of what a server lists: a route that it names, "route ROUTE METRES"; what holds,
// as the edit that brings it about; what it proposes; where robots were lost; or which robots
// charge. It is empty for a line that a later version may have.
struct Listed {
  bool used = true;              // false if robots do not follow its revision
  std::optional<Route> route{};  // with its name and length
  std::optional<Edit> edit{};
  std::optional<Proposal> proposal{};  // "proposed join PLACE PLACE .. confidence F"
  std::optional<LostSection> lost{};   // "lost ROUTE FROM..TO N of M cost F"
  std::optional<Charging> charging{};  // "charging ROBOT WORDS"
  // These robots are in a narrow place or at a dock, or are on their way to the dock:
  // "narrow .., taken by robot1 robot2".
  std::vector<std::string> taken_by{};
};
[[nodiscard]] Listed ParseListed(std::string_view line);
// This stands before an edit that is not used.
inline constexpr std::string_view kUnused = "unused ";
inline constexpr std::string_view kTakenBy = ", taken by ";

// This is a PLACE, or a place's name: then only `name` is set.
struct Goal {
  std::string name{};
  Place place{};
  bool operator==(const Goal&) const = default;
};
// A name has 1 to 64 bytes without blanks and '@'.
[[nodiscard]] Result<Goal> ParseGoal(std::string_view word);

// "way FROM TO" asks for the path from one place to another. A robot's name in FROM stands for
// where it last reported to be, and comes before a place of that name.
struct Question {
  Goal from{};
  Goal to{};
};
[[nodiscard]] Result<Question> ParseQuestion(std::string_view words);

// Parses "hall@12" or "hall@2@12".
[[nodiscard]] Result<Place> ParsePlace(std::string_view word);
[[nodiscard]] std::string ToText(const Place& place);
[[nodiscard]] std::string ToText(const Route& route);        // "route .."
[[nodiscard]] std::string ToText(const NamedPlace& named);   // "name .."
[[nodiscard]] std::string ToText(const Junction& junction);  // "join .."
[[nodiscard]] std::string ToText(
    const Condition& condition);                             // "close ..", "back .." or "limit .."
[[nodiscard]] std::string ToText(const Proposal& proposal);  // "proposed join .."
[[nodiscard]] std::string ToText(const Lane& lane);          // "narrow .."
[[nodiscard]] std::string ToText(const LostSection& lost);   // "lost .."
[[nodiscard]] std::string ToText(const std::optional<ChargeLimits>& charge);  // "charge .."
[[nodiscard]] std::string ToText(const Charging& charging);                   // "charging .."
// Returns text for people: "lost hall 5..10 2 of 7 times lately, a metre counts as 1.9".
[[nodiscard]] std::string Describe(const LostSection& lost);

// Returns the conditions that hold after such an edit. Each place has at
// most one of each kind (closed, backwards, or limited).
[[nodiscard]] std::vector<Condition> Amended(std::vector<Condition> conditions, const Edit& edit);

}  // namespace trailcast::network
