#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "services/mission/orders.h"

namespace trailcast::agent {

// On which routes a robot looks for itself that is going to a place and has lost its path: all
// along its own, on those that look like what it sees, then on the others that its way leads over,
// first from there on.
class Elsewhere {
 public:
  // From one place on its way to the next one that it reaches.
  static constexpr int kMostTimes = 3;

  [[nodiscard]] bool MayBegin() const { return times_ < kMostTimes; }
  // `task`: of `way`, which it followed; `lost`: why no longer; `seen`: names of routes that look
  // like what it sees.
  void Begin(std::span<const mission::Task> way, std::uint32_t task, std::string lost,
             const std::vector<std::string>& seen);
  [[nodiscard]] bool looks() const { return !routes_.empty(); }
  // Where it looks now, anywhere along it; only while it looks.
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
  std::vector<std::string> not_on_;
  int times_ = 0;
};

}  // namespace trailcast::agent
