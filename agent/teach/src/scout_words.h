#pragma once

#include <string>

#include "agent/link/scout_link.h"

namespace trailcast::agent {

// What a scout says when it has taught: what is odd about the route, and which revision robots
// follow from now on.
void TellTaught(const ScoutLink::Outcome& outcome, bool has_odometry, bool sent);

// And what of its end is not in the route: `turned_rad`, it turned on the spot.
void TellNotTaught(double turned_rad);

// The same of what earlier runs taught and this one delivered.
void TellEarlier(const ScoutLink::Outcome& outcome);

// One line of what operators are told: what was taught, and where it is.
[[nodiscard]] std::string TaughtText(const ScoutLink::Outcome& outcome, bool interrupted);

// What is wrong with what was taught, if anything; what is kept where, and what to do. `sent`: with
// a server.
[[nodiscard]] Result<void> Judge(const Result<void>& driven, const ScoutLink::Outcome& outcome,
                                 bool sent, const std::string& store_file);

// Servers have not confirmed all.
[[nodiscard]] Error NotReceipted(const ScoutLink::Outcome& outcome, const std::string& store_file);

}  // namespace trailcast::agent
