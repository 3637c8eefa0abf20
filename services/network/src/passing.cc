#include "services/network/passing.h"

#include <algorithm>
#include <utility>

#include "services/network/words.h"

namespace trailcast::network {
namespace {

constexpr std::string_view kPassing = "passing ";
constexpr std::string_view kAt = "at ";
constexpr std::string_view kPasses = "passes ";

std::optional<Passing> ParsePassing(std::string_view line) {
  const std::size_t blank = std::min(line.find(' '), line.size());
  auto at = ParsePlace(line.substr(0, blank));
  const Listed listed = ParseListed(line.substr(std::min(blank + 1, line.size())));
  if (!at) return std::nullopt;
  if (listed.proposal) {
    return Passing{*std::move(at), listed.proposal->junction, listed.proposal->confidence};
  }
  if (!listed.edit || listed.edit->kind != Edit::Kind::kJoin) return std::nullopt;
  return Passing{*std::move(at), listed.edit->junction, std::nullopt};
}

}  // namespace

std::string WhatPasses(std::string_view goal) { return std::string(kPassing) + std::string(goal); }

std::optional<std::string> ParseWhatPasses(std::string_view words) {
  if (!words.starts_with(kPassing)) return std::nullopt;
  return std::string(words.substr(kPassing.size()));
}

std::string AtPlace(const Place& place) { return std::string(kAt) + ToText(place); }

std::string ToText(const Passing& passing) {
  const std::string junction = passing.confidence
                                   ? ToText(Proposal{passing.junction, *passing.confidence})
                                   : ToText(passing.junction);
  return std::string(kPasses) + ToText(passing.at) + " " + junction;
}

Passings ParsePassings(const std::vector<std::string>& lines) {
  Passings passings;
  for (const std::string& line : lines) {
    const std::string_view text = line;
    if (text.starts_with(kAt)) {
      if (auto place = ParsePlace(text.substr(kAt.size()))) passings.place = *std::move(place);
    } else if (text.starts_with(kPasses)) {
      auto passing = ParsePassing(text.substr(kPasses.size()));
      if (passing) passings.routes.push_back(*std::move(passing));
    }
  }
  return passings;
}

}  // namespace trailcast::network
