#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// What becomes of an earlier teaching of the route that was cut off, before it is taught (again).
enum class Unfinished : std::uint8_t {
  kAsk = 0,      // on a terminal; without one it is kept
  kKeep = 1,     // as it is: no robot follows it unless an operator activates it
  kGoOn = 2,     // it is taught on from where it ended
  kDiscard = 3,  // nobody is offered it again
};

// "ask", "keep", "go-on", "discard".
[[nodiscard]] std::vector<std::string> UnfinishedNames();
[[nodiscard]] Unfinished UnfinishedOf(const std::string& name);

// "an earlier teaching of route 'hall' was cut off: a3f9c21@1, 5 segments, 12.3 m, .."
[[nodiscard]] std::string DescribeUnfinished(const route::RouteInfo& cut_off);

// Asks whoever sits at the terminal until the answer is understood; keeps where there is no
// terminal, nobody answers any more, or `stop` says so.
[[nodiscard]] Unfinished AskOnTerminal(const route::RouteInfo& cut_off,
                                       const std::function<bool()>& stop);

}  // namespace trailcast::agent
