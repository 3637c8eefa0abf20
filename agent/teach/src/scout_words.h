#pragma once

#include <string>

#include "agent/link/scout_link.h"

namespace trailcast::agent {

// Tells a scout's user, after teaching, what is odd about the route, and which revision robots
// follow from now on.
void TellTaught(const ScoutLink::Outcome& outcome, bool has_odometry, bool sent);

// Tells which part of the drive's end is not in the route: a turn on the spot of `turned_rad`.
void TellNotTaught(double turned_rad);

// Tells the same of earlier runs' routes that this one delivered.
void TellEarlier(const ScoutLink::Outcome& outcome);

// Returns one line for operators: what was taught, and where it is.
[[nodiscard]] std::string TaughtText(const ScoutLink::Outcome& outcome, bool interrupted);

// Returns what is wrong with the teaching, if anything, what is kept where, and what to do. `sent`
// means that a server has it.
[[nodiscard]] Result<void> Judge(const Result<void>& driven, const ScoutLink::Outcome& outcome,
                                 bool sent, const std::string& store_file);

// Returns the error that servers have not acknowledged everything.
[[nodiscard]] Error NotReceipted(const ScoutLink::Outcome& outcome, const std::string& store_file);

}  // namespace trailcast::agent
