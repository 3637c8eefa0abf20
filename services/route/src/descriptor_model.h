#pragma once

#include "services/route/key_view.h"
#include "services/route/src/bit_coder.h"

namespace trailcast::route {

// Codes an upright ORB descriptor bit by bit. Each bit is predicted from those before it, by which
// half of the bits are saved. `like`, if given, is a known descriptor that is probably of the same
// thing.
void CodeDescriptor(BitCoder& coder, Descriptor& descriptor, const Descriptor* like);

}  // namespace trailcast::route
