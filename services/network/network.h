#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::network {

// This is a place in metres along a route; its caller chooses how routes are told apart.
struct Place {
  std::string route{};
  double along_m = 0.0;
  bool operator==(const Place&) const = default;
};

// This is a place that people call by a name: "loading-bay".
struct NamedPlace {
  std::string name{};
  Place place{};
  bool home = false;  // one of the places to which "home" leads
  bool dock = false;  // robots charge there, one at a time
  bool operator==(const NamedPlace&) const = default;
};

// This is the pose of the target route at the junction, in the source route's frame: ahead, to the
// left, and counter-clockwise. A robot that changes over to a route turned by more than
// kTurnsFrom_rad, as one that was taught the opposite way, turns on the spot.
struct Lie {
  double ahead_m = 0.0;
  double left_m = 0.0;
  double turn_rad = 0.0;
  bool operator==(const Lie&) const = default;
};

inline constexpr double kTurnsFrom_rad = 1.0;

// This is a junction, where a robot may change over from one route to another, or to another part
// of the same one, as from the end of a ring to its beginning.
struct Junction {
  Place from{};
  Place to{};
  bool both = false;         // also from `to` to `from`
  std::optional<Lie> lie{};  // if it is known
  bool operator==(const Junction&) const = default;
};

// This holds on a part of a route without its ends: a robot may arrive where a closed section
// begins, and set out where it ends.
struct Condition {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;  // if beyond the route's end, it reaches up to that
  bool closed = false;
  bool backed = false;  // robots may also drive it in reverse gear
  double speed = 1.0;   // bound in multiples of the taught speed; above 0
  double cost = 1.0;    // cost of a metre in metres; above 0
  bool operator==(const Condition&) const = default;
};

struct Route {
  std::string id{};    // as in places
  std::string name{};  // for people
  double length_m = 0.0;
};

// This is a section of a route, driven as it was taught or backwards.
struct Section {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;      // below from_m if it is driven backwards
  double speed = 1.0;     // in multiples of the taught speed
  double turn_rad = 0.0;  // to the left, on the spot, before it is driven
  bool operator==(const Section&) const = default;

  [[nodiscard]] bool backwards() const { return to_m < from_m; }
  [[nodiscard]] double length_m() const { return backwards() ? from_m - to_m : to_m - from_m; }
  // Returns how much of it a robot there has driven: below 0 before its beginning.
  [[nodiscard]] double DrivenAt(double along_m) const {
    return backwards() ? from_m - along_m : along_m - from_m;
  }
  // Returns the place along its route after this much of it.
  [[nodiscard]] double AlongAfter(double driven_m) const {
    return backwards() ? from_m - driven_m : from_m + driven_m;
  }
  // Removes the part that a robot there has driven.
  void BeginAt(double along_m);
};

// Two places on a route within this distance are one.
inline constexpr double kSame_m = 0.05;

// Tells that the second begins where the first ends, and is driven in the same direction.
[[nodiscard]] bool GoesOn(const Section& before, const Section& next);
[[nodiscard]] double LengthOf(std::span<const Section> sections);

struct Way {
  std::vector<Section> sections{};  // empty if the robot is there already
  double length_m = 0.0;
};

// This has routes, which are driven in the direction in which they were taught and, where a
// condition allows it, backwards, and how they are joined. A robot that drives backwards looks in
// the same direction as before, so it may go forwards again from anywhere. Questions do not change
// the network.
class Network {
 public:
  // A junction costs as much as these metres, so that of paths of similar length the one with fewer
  // junctions is taken.
  static constexpr double kChangeCosts_m = 1.0;
  static constexpr double kTurnCosts_m = 3.0;  // more, if the robot turns on the spot
  // Robots drive at half the speed in reverse gear.
  static constexpr double kBackwardsCosts = 2.0;

  // Conditions on routes that are not there are ignored. Returns kInvalidArgument for a junction at
  // a place that is not there, or for two routes with one id.
  [[nodiscard]] static Result<Network> Build(std::vector<Route> routes,
                                             const std::vector<Junction>& junctions,
                                             std::span<const Condition> conditions);

  // Returns the path of least cost: metres, times their cost, divided by the share of the speed
  // that is allowed. kNotFound tells people that there is no such route or place, or no path, or
  // that it is closed, and where.
  [[nodiscard]] Result<Way> ShortestWay(const Place& from, const Place& to) const;

  // Does the same for a robot that is on its way: from within a closed part it drives on out of it,
  // or to its goal in it. One that is no further inside than kBarelyIn_m does not.
  [[nodiscard]] Result<Way> WayOn(const Place& from, const Place& to) const;
  static constexpr double kBarelyIn_m = 0.5;
  // Returns the first closed part that such a robot meets from the beginning of this section to its
  // end.
  [[nodiscard]] std::optional<Condition> FirstClosed(const Section& section) const;
  // Returns the closed part that such a robot is on, if there is one.
  [[nodiscard]] std::optional<Condition> ClosedAround(const Place& place) const;

  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

 private:
  using Index = std::uint32_t;
  // This is the begin or end of a junction, condition or route.
  struct Node {
    Index route = 0;
    double along_m = 0.0;
    // The rest holds up to the next node of the same route: all of that section is alike.
    bool closed = false;
    bool backed = false;
    double speed = 1.0;
    double cost = 1.0;  // for each metre
    auto operator<=>(const Node& other) const = default;
  };
  // These belong to the node of the same number. They are apart, since a search reads all of them.
  struct Exits {
    double ahead = 0.0;  // cost to the route's next node; infinite at its last
    // This is the index into leaps_ of the first junction that leads from here. The next node's
    // index ends them.
    Index first_leap = 0;
    bool back = false;  // the section before it may be driven backwards
  };
  struct Leap {  // from one node to another
    Index from = 0;
    Index to = 0;
    float turn_rad = 0.0F;  // on the spot
    auto operator<=>(const Leap& other) const = default;
  };
  struct Spot {
    Index route = 0;
    double along_m = 0.0;
  };
  // This is a drive along one route, up to a change of routes or the goal.
  struct Drive {
    Index route = 0;
    double from_m = 0.0;
    double to_m = 0.0;      // below from_m if backwards
    double turn_rad = 0.0;  // on the spot, before it
  };
  // This collects drives from the last to the first, as a search finds them.
  class Drives;
  // These nodes count as open to a robot that is there: forwards from the first, and backwards to
  // the second.
  struct Open {
    Index first = 0;
    Index end = 0;
  };

  [[nodiscard]] Result<Spot> Find(const Place& place) const;
  void PlaceNodes(const std::vector<Junction>& junctions, std::span<const Condition> conditions);
  void Weigh(std::span<const Condition> conditions);
  void Link(const std::vector<Junction>& junctions);
  [[nodiscard]] Index NodeAt(const Spot& spot) const;  // the last node at or before it
  // Returns the cost of a part of what is ahead of a node.
  [[nodiscard]] double Costs(Index node, double from_m, double to_m,
                             bool though_closed = false) const;
  struct Found {
    double cost = 0.0;  // infinite if there is no path
    std::vector<Drive> drives{};
  };
  [[nodiscard]] Found Search(const Spot& from, const Spot& to, const Open& open) const;
  [[nodiscard]] Result<Way> WayFound(const Spot& from, const Spot& to, const Found& found) const;
  // For a robot within a closed part these are the nodes where that begins and ends; for one that
  // has barely entered it, the place where it begins.
  struct WayOut {
    Open open{};
    Spot from{};
  };
  [[nodiscard]] WayOut OutOf(const Spot& spot) const;
  // Returns the nodes around a closed one, up to the next open ones.
  [[nodiscard]] Open ClosedAbout(Index node) const;
  [[nodiscard]] Condition ClosedBetween(const Open& part) const;
  [[nodiscard]] Way WayOf(const std::vector<Drive>& drives) const;
  [[nodiscard]] std::string ClosedOn(const std::vector<Drive>& drives) const;
  [[nodiscard]] std::string Text(const Spot& spot) const;

  std::vector<Route> routes_;
  std::map<std::string, Index, std::less<>> by_id_;
  std::vector<Node> nodes_;   // by route, then along it; a route's first and last are its ends
  std::vector<Exits> exits_;  // with one beyond the last
  std::vector<Leap> leaps_;
};

}  // namespace trailcast::network
