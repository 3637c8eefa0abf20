#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trailcast::route {

enum class EditAction : std::uint8_t {
  kActivate = 0,  // followers take this revision from now on; revision 0 is the newest complete one
  kRollBack = 1,  // activates the newest complete revision before the active one
  kRename = 2,    // renames all revisions
  kTag = 3,
  kUntag = 4,
  kDescribe = 5,
  kRetire = 6,  // is undone by kActivate
  kDelete = 7,  // refuses the active one, unless all are deleted
};

// This is a change of a route's labels that an operator asks for.
struct RouteEdit {
  EditAction action = EditAction::kActivate;
  std::string route{};         // its name, or its id if several routes have that name
  std::uint32_t revision = 0;  // 0 is all of them, unless the action says otherwise
  std::string text{};          // the new name, or the description
  std::vector<std::string> tags{};

  bool operator==(const RouteEdit&) const = default;
};

}  // namespace trailcast::route
