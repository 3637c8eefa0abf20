#pragma once

#include "services/route/key_view.h"
#include "services/route/src/bit_coder.h"

namespace trailcast::route {

// An upright ORB descriptor, bit by bit, each expected by those before it: half of its bits follow
// from the others. `like`, if any: one that is known and probably of the same thing.
void CodeDescriptor(BitCoder& coder, Descriptor& descriptor, const Descriptor* like);

}  // namespace trailcast::route
