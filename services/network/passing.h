#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/network/network.h"

namespace trailcast::network {

// This is a route that passes at a place of another, or again at a place of its own, by a junction.
struct Passing {
  Place at{};  // place on the passing route
  Junction junction{};
  std::optional<double> confidence{};  // set if the junction is only proposed
  bool operator==(const Passing&) const = default;
};

struct Passings {
  Place place{};  // the place of the question
  std::vector<Passing> routes{};
  bool operator==(const Passings&) const = default;
};

// Returns the question which routes pass there: "passing GOAL" (words.h).
[[nodiscard]] std::string WhatPasses(std::string_view goal);
// Returns the goal without checking it, or nothing for another question.
[[nodiscard]] std::optional<std::string> ParseWhatPasses(std::string_view words);

// Returns a line of the answer: "at PLACE", and for each route "passes PLACE join .." or "passes
// PLACE proposed join .. confidence F".
[[nodiscard]] std::string AtPlace(const Place& place);
[[nodiscard]] std::string ToText(const Passing& passing);
// Ignores lines that a later version may have.
[[nodiscard]] Passings ParsePassings(const std::vector<std::string>& lines);

}  // namespace trailcast::network
