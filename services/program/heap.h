#pragma once

namespace trailcast::program {

// Makes the C library keep up to as much freed memory as was in use at a time. Pictures and their
// pyramids are buffers of some 100 kB to 32 MB, made anew for each frame. The library would return
// each to the system and request it again, and the empty pages cost several times what is computed
// in them. Programs that look at pictures call it once, before they start threads. A server, whose
// buffers come and go with its clients, does better without.
void KeepFreedMemory();

}  // namespace trailcast::program
