#include "services/security/documents.h"

#include <fmt/chrono.h>

#include <vector>

#include "services/exchange/topics.h"

namespace trailcast::security {
namespace {

// A program chooses its domain when it starts, and the fleet is the same in all of them.
constexpr const char* kDomains =
    "<domains><id_range><min>0</min><max>230</max></id_range></domains>";
constexpr const char* kHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_{}.xsd">
)";

std::string Partition(const std::string& name) { return "<partition>" + name + "</partition>"; }

std::string Below(const Member& member) { return Partition(PartitionOf(member) + "/*"); }

std::string Topic(const std::string& name) { return "<topic>" + name + "</topic>"; }

std::string Topics(const std::vector<exchange::Topic>& topics) {
  std::string text;
  for (const exchange::Topic topic : topics) text += Topic(exchange::NameOf(topic));
  return text;
}

}  // namespace

std::string ToText(Time time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

// Metadata encryption covers a whole submessage, so that not even a sample's key shows; its data
// need no further encryption. Whole RTPS messages are not encrypted, because members that have not
// authenticated each other yet could not read them.
std::string GovernanceXml() {
  return fmt::format(kHead, "governance") + fmt::format(R"(<domain_access_rules>
  <domain_rule>
    {}
    <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
    <enable_join_access_control>true</enable_join_access_control>
    <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
    <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
    <rtps_protection_kind>NONE</rtps_protection_kind>
    <topic_access_rules>
      <topic_rule>
        <topic_expression>*</topic_expression>
        <enable_discovery_protection>true</enable_discovery_protection>
        <enable_liveliness_protection>true</enable_liveliness_protection>
        <enable_read_access_control>true</enable_read_access_control>
        <enable_write_access_control>true</enable_write_access_control>
        <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
        <data_protection_kind>NONE</data_protection_kind>
      </topic_rule>
    </topic_access_rules>
  </domain_rule>
</domain_access_rules>
</dds>
)",
                                                        kDomains);
}

std::string PermissionsXml(const Member& member, const Validity& validity) {
  const exchange::TopicUse rights = RightsOf(member.role);
  const std::string revocations = Topic(kRevocationsTopic);
  const std::string writes =
      Topics(rights.write) + (member.role == Role::kServer ? revocations : "");
  return fmt::format(kHead, "permissions") +
         fmt::format(R"(<permissions>
  <grant name="{}">
    <subject_name>{}</subject_name>
    <validity>
      <not_before>{}</not_before>
      <not_after>{}</not_after>
    </validity>
    <allow_rule>
      {}
      <publish>
        <topics>{}</topics>
        <partitions>{}</partitions>
      </publish>
      <subscribe>
        <topics>{}</topics>
        <partitions><partition>*</partition></partitions>
      </subscribe>
    </allow_rule>
    <default>DENY</default>
  </grant>
</permissions>
</dds>
)",
                     NameOf(member.role), SubjectOf(member), ToText(validity.from),
                     ToText(validity.until), kDomains, writes,
                     Partition(PartitionOf(member)) + Below(member),
                     Topics(rights.read) + revocations);
}

bool AllowsScopes(const std::string& permissions_xml, const Member& member) {
  return permissions_xml.find(Below(member)) != std::string::npos;
}

bool AllowsTopic(const std::string& permissions_xml, const std::string& topic) {
  return permissions_xml.find(Topic(topic)) != std::string::npos;
}

std::optional<std::string> ElementOf(const std::string& xml, const std::string& name) {
  const std::string open = "<" + name + ">";
  const std::string close = "</" + name + ">";
  const std::size_t begin = xml.find(open);
  if (begin == std::string::npos || xml.find(open, begin + 1) != std::string::npos) {
    return std::nullopt;
  }
  const std::size_t from = begin + open.size();
  const std::size_t end = xml.find(close, from);
  if (end == std::string::npos) return std::nullopt;
  return xml.substr(from, end - from);
}

}  // namespace trailcast::security
