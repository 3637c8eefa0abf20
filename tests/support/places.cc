#include "tests/support/places.h"

namespace trailcast {

std::string SourceDir() { return TRAILCAST_SOURCE_DIR; }
std::string ProgramsDir() { return TRAILCAST_BINARY_DIR; }

}  // namespace trailcast
