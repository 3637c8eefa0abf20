#pragma once

#include <string>

namespace trailcast::dds {

// Returns the environment's CYCLONEDDS_URI, which may be empty.
[[nodiscard]] std::string CycloneUri();

// Returns the XML of a CYCLONEDDS_URI, which is XML or names files, as far as it can be read.
[[nodiscard]] std::string UriXml(const std::string& uri);

// Say whether the XML chooses network interfaces, and whether it chooses the one of this name.
[[nodiscard]] bool ChoosesInterfaces(const std::string& xml);
[[nodiscard]] bool ChoosesInterface(const std::string& xml, const std::string& name);

}  // namespace trailcast::dds
