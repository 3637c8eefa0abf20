#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trailcast::route {

enum class EditAction : std::uint8_t {
  kActivate = 0,  // followers take this revision from now on; 0: the newest complete one
  kRollBack = 1,  // activates the newest complete revision before the active one
  kRename = 2,    // all revisions
  kTag = 3,
  kUntag = 4,
  kDescribe = 5,
  kRetire = 6,  // activate it to take it back
  kDelete = 7,  // not the active one, unless all are
};

// What an operator wants changed of a route's labels.
struct RouteEdit {
  EditAction action = EditAction::kActivate;
  std::string route{};         // its name, or its id where several have the name
  std::uint32_t revision = 0;  // 0: all of them, where the action does not say otherwise
  std::string text{};          // the new name, or the description
  std::vector<std::string> tags{};

  bool operator==(const RouteEdit&) const = default;
};

}  // namespace trailcast::route
