#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "services/mission/mission.h"

namespace trailcast::server {

// The parts of MissionRegistry share these.

// A robot that has not answered is told again after the first pause, and later after ever longer
// ones up to the second.
inline constexpr std::chrono::milliseconds kSoon{1000};
inline constexpr std::chrono::milliseconds kLate{30'000};
// The id of the mission of a robot that is sent home begins with this.
inline constexpr const char* kHomePrefix = "home-";
// The id of the mission of a robot that is sent to a dock to charge begins with this.
inline constexpr const char* kChargePrefix = "charge-";
// Such a mission has this destination until a dock is chosen, shortly before the robot sets out.
inline constexpr const char* kChargeWord = "charge";

// Returns a mission in words, for the log.
[[nodiscard]] std::string Describe(const mission::Mission& mission);

// Returns the orders of a mission whose path is only found once its robot is about to begin.
[[nodiscard]] std::string OrdersWithoutWay(std::string_view goal);

[[nodiscard]] bool SendsHome(const mission::Record& record);
[[nodiscard]] bool SendsToCharge(const mission::Record& record);

// Says whether a mission that a server ends in this state, before its robot has it, counts as the
// last one that the robot has ended.
[[nodiscard]] bool EndsHere(const mission::Record& record, mission::State state);

// Returns why a robot is not sent on after a mission that did not arrive.
[[nodiscard]] std::string NotArrived(const mission::Report& end);

// Returns the states in which a mission has ended, a bit each.
[[nodiscard]] std::uint32_t EndedStates();

// Makes a report by the server itself.
[[nodiscard]] mission::Report OwnReport(const mission::Mission& mission, mission::State state,
                                        const std::string& why);

}  // namespace trailcast::server
