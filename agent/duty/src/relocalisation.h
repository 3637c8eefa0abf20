#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "services/mission/orders.h"

namespace trailcast::agent {

// The routes on which a robot that was going to a place and has lost its path looks for itself: all
// along its own, on those that resemble its view, and then on the others of its path, beginning
// with those after its own.
class Relocalisation {
 public:
  // Between one place on its path and the next that it reaches, it looks so often.
  static constexpr int kMostTimes = 3;

  [[nodiscard]] bool MayBegin() const { return times_ < kMostTimes; }
  // `task` is the one of `way` that it followed, `lost` the reason for which it was lost, and
  // `seen` has the routes that resemble its view.
  void Begin(std::span<const mission::Task> way, std::uint32_t task, std::string lost,
             const std::vector<std::string>& seen);
  [[nodiscard]] bool looks() const { return !routes_.empty(); }
  // Returns the route on which it looks now, at any place. Only while it looks.
  [[nodiscard]] const mission::Task& route() const { return routes_.front(); }
  // Notes that it is not there; returns true if that was the last route.
  [[nodiscard]] bool NotThere();
  // Ends the search, because it was found or need not be.
  void End() { routes_.clear(); }
  // Allows a new search, because it has got further.
  void Reset();

  // Returns "LOST: ...; and it does not find itself on hall or office", for people.
  [[nodiscard]] std::string Lost() const;

 private:
  std::deque<mission::Task> routes_;
  std::string lost_;
  std::vector<std::string> not_on_;
  int times_ = 0;
};

}  // namespace trailcast::agent
