#pragma once

#include "services/route/route.h"
#include "services/route/src/bit_coder.h"

namespace trailcast::route {

// Codes a patch's samples, 0 to 15, row by row. Each is predicted from its neighbours.
void CodePatch(BitCoder& coder, Patch& patch);

}  // namespace trailcast::route
