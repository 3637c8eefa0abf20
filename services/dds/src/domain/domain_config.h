#pragma once

#include <string>

#include "services/dds/dds_exchange.h"
#include "services/dds/src/domain/discovery_config.h"

namespace trailcast::dds {

// Cyclone's configuration, later parts taking precedence: our defaults, the environment's
// CYCLONEDDS_URI, the options (with keys: DDS Security with their files), extra_config_xml.
// kInvalidArgument for text that cannot be put in XML or a domain id out of range; kUnavailable
// for a server address that has none at present.
[[nodiscard]] Result<std::string> DomainConfig(const DdsOptions& options, const Meeting& meeting,
                                               const std::string& cyclonedds_uri);

}  // namespace trailcast::dds
