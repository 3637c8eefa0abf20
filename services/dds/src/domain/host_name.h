#pragma once

namespace trailcast::dds {

// Hides the host's name for the rest of this process. Cyclone DDS announces it unencrypted, even
// with DDS Security, and has no setting against that.
void HideHostName();

}  // namespace trailcast::dds
