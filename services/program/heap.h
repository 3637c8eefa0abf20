#pragma once

namespace trailcast::program {

// Pictures and their pyramids are buffers of some 100 kB to 32 MB, made anew for each frame. The C
// library would give each back to the system and take it anew, whose empty pages cost several times
// what is computed in them. From now on it keeps up to as much as was in use at a time. For
// programs that look at pictures, once, before they start threads; a server, whose buffers come and
// go with its clients, does better without.
void KeepFreedMemory();

}  // namespace trailcast::program
