#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>

#include "services/mission/orders.h"

namespace trailcast::agent {

// On which routes a robot looks for itself that is going to a place and has lost its path: all
// along its own, then on those that its way leads over from there, then on those before.
class Elsewhere {
 public:
  // From one place on its way to the next one that it reaches.
  static constexpr int kMostTimes = 3;

  // `task`: of `way`, which it followed; `lost`: why no longer. False: it has looked so often
  // already.
  [[nodiscard]] bool Begin(std::span<const mission::Task> way, std::uint32_t task,
                           std::string lost);
  [[nodiscard]] bool looks() const { return !routes_.empty(); }
  // Where it looks now: may be anywhere along it, and stands. Only while it looks.
  [[nodiscard]] const mission::Task& route() const { return routes_.front(); }
  // It is not there: true if that was the last one.
  [[nodiscard]] bool NotThere();
  // It stands there; or need not look any more.
  void End() { routes_.clear(); }
  // It has got further: it may look anew.
  void Reset();

  // For people: "LOST: ...; and it does not find itself on hall or office".
  [[nodiscard]] std::string Lost() const;

 private:
  std::deque<mission::Task> routes_;
  std::string lost_;
  std::string not_on_;
  int times_ = 0;
};

}  // namespace trailcast::agent
