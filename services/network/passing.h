#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/network/network.h"

namespace trailcast::network {

// A route that passes at a place of another, or at one of its own again, as a joint says.
struct Passing {
  Place at{};  // on it
  Joint joint{};
  std::optional<double> confidence{};  // of a joint that is only proposed
  bool operator==(const Passing&) const = default;
};

struct Passings {
  Place place{};  // that was asked about
  std::vector<Passing> routes{};
  bool operator==(const Passings&) const = default;
};

// The question which routes pass there: "passing GOAL" (words.h).
[[nodiscard]] std::string WhatPasses(std::string_view goal);
// The goal, whatever it is; nothing for another question.
[[nodiscard]] std::optional<std::string> ParseWhatPasses(std::string_view words);

// Its answer: "at PLACE", and a line for each, "passes PLACE join ..", or "passes PLACE proposed
// join .. confidence F".
[[nodiscard]] std::string AtPlace(const Place& place);
[[nodiscard]] std::string ToText(const Passing& passing);
// Lines that a later version may have are passed over.
[[nodiscard]] Passings ParsePassings(const std::vector<std::string>& lines);

}  // namespace trailcast::network
