#pragma once

#include "services/route/route.h"
#include "services/route/src/bit_coder.h"

namespace trailcast::route {

// A patch's samples, 0 to 15, row by row, each expected to be about where its neighbours lead.
void CodePatch(BitCoder& coder, Patch& patch);

}  // namespace trailcast::route
