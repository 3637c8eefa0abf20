#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// The treatment, before a route is taught, of an earlier teaching of it that was cut off.
enum class Unfinished : std::uint8_t {
  kAsk = 0,      // on a terminal; without one it is kept
  kKeep = 1,     // no robot follows it unless an operator activates it
  kGoOn = 2,     // the teaching continues where it ended
  kDiscard = 3,  // it is never offered again
};

// Convert to and from "ask", "keep", "go-on", "discard".
[[nodiscard]] std::vector<std::string> UnfinishedNames();
[[nodiscard]] Unfinished UnfinishedOf(const std::string& name);

// Returns "an earlier teaching of route 'hall' was cut off: a3f9c21@1, 5 segments, 12.3 m, ..".
[[nodiscard]] std::string DescribeUnfinished(const route::RouteInfo& cut_off);

// Asks the person at the terminal until the answer is understood. It keeps the teaching if there is
// no terminal, nobody answers any more, or `stop` returns true.
[[nodiscard]] Unfinished AskOnTerminal(const route::RouteInfo& cut_off,
                                       const std::function<bool()>& stop);

}  // namespace trailcast::agent
