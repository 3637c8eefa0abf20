#pragma once

#include <string>

// These tell where this checkout and what was built of it lie. They are functions, so that a test's
// own objects are the same in every checkout and a compiler cache has them for all.
namespace trailcast {

[[nodiscard]] std::string SourceDir();
[[nodiscard]] std::string ProgramsDir();

}  // namespace trailcast
