#pragma once

#include <string>

namespace trailcast::dds {

// What the environment says; empty: nothing.
[[nodiscard]] std::string CycloneUri();

// The XML that a CYCLONEDDS_URI stands for, as far as it can be read: it names files, or is XML.
[[nodiscard]] std::string UriXml(const std::string& uri);

// Whether that XML chooses network interfaces; and whether one of this name is among them.
[[nodiscard]] bool ChoosesInterfaces(const std::string& xml);
[[nodiscard]] bool ChoosesInterface(const std::string& xml, const std::string& name);

}  // namespace trailcast::dds
