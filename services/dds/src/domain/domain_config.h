#pragma once

#include <string>

#include "services/dds/dds_exchange.h"
#include "services/dds/src/domain/discovery_config.h"

namespace trailcast::dds {

// Returns Cyclone's configuration, in which later parts take precedence: our defaults, the
// environment's CYCLONEDDS_URI, the options (with keys, DDS Security with their files),
// extra_config_xml. Errors: kInvalidArgument for text that cannot be put in XML or a domain id out
// of range; kUnavailable for a server that has no address at present.
[[nodiscard]] Result<std::string> DomainConfig(const DdsOptions& options, const Meeting& meeting,
                                               const std::string& cyclonedds_uri);

}  // namespace trailcast::dds
