#pragma once

#include <string>

// Where this checkout and what was built of it lie. Functions, so that a test's own objects are the
// same in every checkout, and a compiler cache has them for all of them.
namespace trailcast {

[[nodiscard]] std::string SourceDir();
[[nodiscard]] std::string ProgramsDir();

}  // namespace trailcast
