#include "services/dds/src/domain/domain_config.h"

#include "services/base/ids.h"
#include "services/dds/src/domain/cyclone_uri.h"
#include "services/security/folder_layout.h"

namespace trailcast::dds {
namespace {

// docs/reference/figures/networks.md has the measurements ("Routes over bad networks"). At 5 %
// packet loss, a route takes a third to a half of the time with these settings: packets that fit an
// Ethernet frame (larger ones are lost with any of their fragments, but cost a tenth less if
// nothing is lost), heartbeats after 20 ms instead of 100 (they tell that the last packet was
// lost), and a NACK after 10 ms instead of 100. Samples above 2 MB cannot be ours and are not
// reassembled. Watermarks: a writer waits if more than 30 kB are unacknowledged, so that a full
// batch of segments (48 kB) goes out when the one before has arrived. Links then take segments as
// fast as they can and no faster. With 4 MB, the queue of a link of 1 Mbit/s overflows, and it does
// not deliver 1 MB within a minute. The price is that a killed receiver of segments delays all
// others until its lease ends. The watermark is not adaptive, because that falls with every loss.
constexpr const char* kDefaults =
    "<CycloneDDS><Domain><Internal>"
    "<HeartbeatInterval min=\"5ms\" minsched=\"10ms\" max=\"1s\">20ms</HeartbeatInterval>"
    "<NackDelay>10ms</NackDelay>"
    "<MaxSampleSize>2MB</MaxSampleSize>"
    "<WriteBatch>true</WriteBatch>"  // Writer::Write sends at once nevertheless
    "<Watermarks><WhcAdaptive>false</WhcAdaptive><WhcHigh>30kB</WhcHigh>"
    "<WhcHighInit>30kB</WhcHighInit></Watermarks>"
    "</Internal></Domain></CycloneDDS>";
// These are for a star and its centre (docs/reference/figures/networks.md, "Many agents at once").
// While one agent has not confirmed what a server wrote, its heartbeats go to all agents, and each
// answers them; so both are rarer. They are still rarer for processes that send little, because a
// server that a thousand of them join is some seconds behind and would be asked again and again. A
// fetch that waits is reminded sooner (reminders.h).
constexpr const char* kStar =
    "<CycloneDDS><Domain><Internal>"
    "<HeartbeatInterval min=\"5ms\" minsched=\"20ms\" max=\"8s\">100ms</HeartbeatInterval>"
    "<AckDelay>200ms</AckDelay>"
    "</Internal></Domain></CycloneDDS>";
constexpr const char* kSendsLittle =
    "<CycloneDDS><Domain><Internal>"
    "<HeartbeatInterval min=\"5ms\" minsched=\"100ms\" max=\"8s\">500ms</HeartbeatInterval>"
    "</Internal></Domain></CycloneDDS>";
// One thread waits for all sockets. Cyclone ends threads that wait for one socket each by a packet
// to its own address, so once that address is gone, closing a domain would never end.
constexpr const char* kEndsWithoutNetwork =
    "<CycloneDDS><Domain><Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></"
    "Internal>"
    "</Domain></CycloneDDS>";
// This applies to a chosen interface; on others Cyclone decides for itself. The environment may
// forbid multicast.
constexpr const char* kMulticast =
    "<CycloneDDS><Domain><General><AllowMulticast>true</AllowMulticast></General></Domain>"
    "</CycloneDDS>";
// The loopback interface has frames of 64 kB and loses nothing, so larger packets take a quarter of
// the time there.
constexpr const char* kFrameSized =
    "<CycloneDDS><Domain><General><MaxMessageSize>1400B</MaxMessageSize></General></Domain>"
    "</CycloneDDS>";

// The plug-ins come with Cyclone, which finds them by these names.
constexpr const char* kSecurity =
    "<CycloneDDS><Domain><Security>"
    "<Authentication>"
    "<Library path=\"dds_security_auth\" initFunction=\"init_authentication\" "
    "finalizeFunction=\"finalize_authentication\"/>"
    "<IdentityCA>file:{folder}/{authority}</IdentityCA>"
    "<CRL>data:,{revoked}</CRL>"
    "<IdentityCertificate>file:{folder}/{identity}</IdentityCertificate>"
    "<PrivateKey>file:{folder}/{key}</PrivateKey>"
    "</Authentication>"
    "<Cryptographic><Library path=\"dds_security_crypto\" initFunction=\"init_crypto\" "
    "finalizeFunction=\"finalize_crypto\"/></Cryptographic>"
    "<AccessControl>"
    "<Library path=\"dds_security_ac\" initFunction=\"init_access_control\" "
    "finalizeFunction=\"finalize_access_control\"/>"
    "<PermissionsCA>file:{folder}/{authority}</PermissionsCA>"
    "<Governance>file:{folder}/{governance}</Governance>"
    "<Permissions>file:{folder}/{permissions}</Permissions>"
    "</AccessControl>"
    "</Security></Domain></CycloneDDS>";

Result<std::string> SecurityConfig(const security::MemberKeys& keys) {
  const std::string folder = keys.folder.string();
  if (folder.find_first_of("<>&$,") != std::string::npos) {
    return Fail(ErrorCode::kInvalidArgument,
                "the keys' folder {} has one of < > & $ , in its name, which DDS does not take: "
                "give it another",
                folder);
  }
  return fmt::format(
      kSecurity, fmt::arg("folder", folder), fmt::arg("authority", security::kAuthorityFile),
      fmt::arg("revoked", keys.revoked.text), fmt::arg("identity", security::kIdentityFile),
      fmt::arg("key", security::kIdentityKeyFile),
      fmt::arg("governance", security::kGovernanceFile),
      fmt::arg("permissions", security::kPermissionsFile));
}

}  // namespace

Result<std::string> DomainConfig(const DdsOptions& options, const Meeting& meeting,
                                 const std::string& cyclonedds_uri) {
  constexpr std::uint32_t kMaxDomainId = 230;  // port numbers run out beyond
  if (options.domain_id > kMaxDomainId) {
    return Fail(ErrorCode::kInvalidArgument, "DDS domain id {} is above {}", options.domain_id,
                kMaxDomainId);
  }
  std::string discovery = fmt::format("<ExternalDomainId>{}</ExternalDomainId>", options.domain_id);
  if (!options.discovery_tag.empty()) {
    if (!IsValidName(options.discovery_tag)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "DDS discovery tag is not 1 to 64 of letters, digits, '_', '.', '-'");
    }
    discovery += fmt::format("<Tag>{}</Tag>", options.discovery_tag);
  }
  std::string general;
  if (!options.network_interface.empty()) {
    if (!IsValidName(options.network_interface)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "\"{}\" is not the name of a network interface; `ip link` lists them",
                  options.network_interface);
    }
  }
  // Cyclone refuses an interface that is named in both places.
  if (!options.network_interface.empty() &&
      !ChoosesInterface(UriXml(cyclonedds_uri), options.network_interface)) {
    // The loopback interface supports multicast although it does not say so, so it is forced.
    general = fmt::format(
        "<General><Interfaces>"
        "<NetworkInterface name=\"{}\" multicast=\"true\"/></Interfaces></General>",
        options.network_interface);
  }
  if (options.network_interface.empty() && !meeting.address.empty() &&
      !ChoosesInterfaces(UriXml(cyclonedds_uri))) {
    general = fmt::format(
        "<General><Interfaces><NetworkInterface address=\"{}\"/></Interfaces></General>",
        meeting.address);
  }
  std::string config = kDefaults;
  if (meeting.star || options.serves) config += std::string(",") + kStar;
  if (meeting.star && !meeting.sends_much) config += std::string(",") + kSendsLittle;
  if (options.network_interface != "lo") config += std::string(",") + kFrameSized;
  if (!options.network_interface.empty()) config += std::string(",") + kMulticast;
  if (!cyclonedds_uri.empty()) config += "," + cyclonedds_uri;
  config += fmt::format(",<CycloneDDS><Domain>{}<Discovery>{}</Discovery></Domain></CycloneDDS>",
                        general, discovery);
  config += std::string(",") + kEndsWithoutNetwork;
  config += "," + DiscoveryConfig(options, meeting);
  if (options.keys) {
    const auto secured = SecurityConfig(*options.keys);
    if (!secured) return secured;
    config += "," + *secured;
  }
  if (!options.extra_config_xml.empty()) config += "," + options.extra_config_xml;
  return config;
}

}  // namespace trailcast::dds
