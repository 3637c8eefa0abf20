#pragma once

namespace trailcast::dds {

// From now on this process tells nobody the host's name. Cyclone DDS writes it into what it
// announces in the clear, also with DDS Security, and has no setting for that.
void HideHostName();

}  // namespace trailcast::dds
