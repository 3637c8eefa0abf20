#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::network {

// Metres along a route, by whatever its caller tells routes apart.
struct Place {
  std::string route{};
  double along_m = 0.0;
  bool operator==(const Place&) const = default;
};

// A place that people call by a name: "loading-bay".
struct NamedPlace {
  std::string name{};
  Place place{};
  bool operator==(const NamedPlace&) const = default;
};

// How the route that a joint leads to lies there, seen from the one that it leaves: in that one's
// direction, to the left of it, and counter-clockwise. Who changes over to a route that is turned
// by more than kTurnsFrom_rad turns on the spot: to one that was taught the opposite way.
struct Lie {
  double ahead_m = 0.0;
  double left_m = 0.0;
  double turn_rad = 0.0;
  bool operator==(const Lie&) const = default;
};

inline constexpr double kTurnsFrom_rad = 1.0;

// Where a robot may change over from one route to another, or to another part of the same: the end
// of a ring to its beginning.
struct Joint {
  Place from{};
  Place to{};
  bool both = false;         // and back
  std::optional<Lie> lie{};  // where it is known
  bool operator==(const Joint&) const = default;
};

// What holds on a part of a route, whose ends are no part of it: one may arrive where a closed
// stretch begins, and set out where it ends.
struct Condition {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;  // beyond the route's end: up to it
  bool closed = false;
  bool backed = false;  // robots may also drive it backwards, in reverse gear
  double speed = 1.0;   // at most so many times the taught speed; above 0
  double cost = 1.0;    // a metre counts as so many; above 0
  bool operator==(const Condition&) const = default;
};

struct Route {
  std::string id{};    // as places have it
  std::string name{};  // for people
  double length_m = 0.0;
};

// A part of a route, driven as it was taught, or backwards.
struct Stretch {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;      // below from_m: it is driven backwards
  double speed = 1.0;     // times the taught speed
  double turn_rad = 0.0;  // to the left, on the spot, before it is driven
  bool operator==(const Stretch&) const = default;

  [[nodiscard]] bool backwards() const { return to_m < from_m; }
  [[nodiscard]] double length_m() const { return backwards() ? from_m - to_m : to_m - from_m; }
  // How much of it is driven by who is there on its route: below 0 before its beginning.
  [[nodiscard]] double DrivenAt(double along_m) const {
    return backwards() ? from_m - along_m : along_m - from_m;
  }
  // Where on its route one is after so much of it.
  [[nodiscard]] double AlongAfter(double driven_m) const {
    return backwards() ? from_m - driven_m : from_m + driven_m;
  }
  // Without what is driven of it by who is there.
  void BeginAt(double along_m);
};

// Within so many metres two places on a route are one.
inline constexpr double kSame_m = 0.05;

// The second begins where the first ends, and is driven the same way.
[[nodiscard]] bool GoesOn(const Stretch& before, const Stretch& next);
[[nodiscard]] double LengthOf(std::span<const Stretch> stretches);

struct Way {
  std::vector<Stretch> stretches{};  // none: it is there already
  double length_m = 0.0;
};

// Routes, which are driven in the direction in which they were taught, and backwards where that is
// so conditioned, and how they are joined. Who drives backwards looks where it looked before: it
// may go on ahead from anywhere. What is asked does not change it.
class Network {
 public:
  // Changing over counts as so many metres: of ways of about one length that with fewer joints.
  static constexpr double kChangeCosts_m = 1.0;
  static constexpr double kTurnCosts_m = 3.0;  // besides, who turns on the spot
  // In reverse gear robots drive at half the speed.
  static constexpr double kBackwardsCosts = 2.0;

  // Conditions on routes that are not there count for nothing. kInvalidArgument: a joint at a place
  // that is not there, or two routes with one id.
  [[nodiscard]] static Result<Network> Build(std::vector<Route> routes,
                                             const std::vector<Joint>& joints,
                                             std::span<const Condition> conditions);

  // The one that costs least: metres, times their cost, divided by what is left of their speed.
  // kNotFound in words for people: no such route or place, no way, or one that is closed, and
  // where.
  [[nodiscard]] Result<Way> ShortestWay(const Place& from, const Place& to) const;

  // The same for a robot that is under way there: from within a part that is closed it drives on
  // out of that, or to its goal in it. Who has come no further into it than kBarelyIn_m does not.
  [[nodiscard]] Result<Way> WayOn(const Place& from, const Place& to) const;
  static constexpr double kBarelyIn_m = 0.5;
  // What such a robot at the beginning of this meets first of what is closed, up to its end.
  [[nodiscard]] std::optional<Condition> FirstClosed(const Stretch& stretch) const;
  // The closed part that such a robot is on, if it is on one.
  [[nodiscard]] std::optional<Condition> ClosedAround(const Place& place) const;

  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

 private:
  using Index = std::uint32_t;
  // Where a joint or condition begins or ends, and the route besides.
  struct Node {
    Index route = 0;
    double along_m = 0.0;
    // Up to the next node, if that is of the same route: all of it is alike.
    bool closed = false;
    bool backed = false;
    double speed = 1.0;
    double cost = 1.0;  // of a metre
    auto operator<=>(const Node& other) const = default;
  };
  // Of the node of that number; apart from it, since a search looks at all of these.
  struct Exits {
    double ahead = 0.0;    // what it costs to the route's next node; infinite at its last
    Index first_leap = 0;  // of leaps_: where joints lead from here, up to the next node's first
    bool back = false;     // one may drive backwards to the route's node before it
  };
  struct Leap {  // from node to node
    Index from = 0;
    Index to = 0;
    float turn_rad = 0.0F;  // on the spot
    auto operator<=>(const Leap& other) const = default;
  };
  struct Spot {
    Index route = 0;
    double along_m = 0.0;
  };
  // From where to where one drives before each change, and in the end.
  struct Drive {
    Index route = 0;
    double from_m = 0.0;
    double to_m = 0.0;      // below from_m: backwards
    double turn_rad = 0.0;  // before it
  };
  // Driven last to first, as a search finds them.
  class Drives;
  // Nodes, which count as open to who is there: from there on ahead, and backwards up to there.
  struct Open {
    Index first = 0;
    Index end = 0;
  };

  [[nodiscard]] Result<Spot> Find(const Place& place) const;
  void PlaceNodes(const std::vector<Joint>& joints, std::span<const Condition> conditions);
  void Weigh(std::span<const Condition> conditions);
  void Link(const std::vector<Joint>& joints);
  [[nodiscard]] Index NodeAt(const Spot& spot) const;  // the last at or before it
  // Of a part of what is ahead of a node.
  [[nodiscard]] double Costs(Index node, double from_m, double to_m,
                             bool though_closed = false) const;
  struct Found {
    double cost = 0.0;  // infinite: there is no way
    std::vector<Drive> drives{};
  };
  [[nodiscard]] Found Search(const Spot& from, const Spot& to, const Open& open) const;
  [[nodiscard]] Result<Way> WayFound(const Spot& from, const Spot& to, const Found& found) const;
  // Of a robot within a closed part, the nodes where that begins and ends, and of one that has
  // barely come in the place where it begins.
  struct WayOut {
    Open open{};
    Spot from{};
  };
  [[nodiscard]] WayOut OutOf(const Spot& spot) const;
  // Of a closed node, those about it up to the next that is open.
  [[nodiscard]] Open ClosedAbout(Index node) const;
  [[nodiscard]] Condition ClosedBetween(const Open& part) const;
  [[nodiscard]] Way WayOf(const std::vector<Drive>& drives) const;
  [[nodiscard]] std::string ClosedOn(const std::vector<Drive>& drives) const;
  [[nodiscard]] std::string Text(const Spot& spot) const;

  std::vector<Route> routes_;
  std::map<std::string, Index, std::less<>> by_id_;
  std::vector<Node> nodes_;   // by route, then along it; a route's first and last are its ends
  std::vector<Exits> exits_;  // and one beyond the last
  std::vector<Leap> leaps_;
};

}  // namespace trailcast::network
