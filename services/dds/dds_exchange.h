#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/exchange/route_exchange.h"
#include "services/security/member_keys.h"

namespace trailcast::dds {

struct DdsOptions {
  std::uint32_t domain_id = 0;  // 0..230, decides the UDP ports
  // Participants with different tags do not see each other: two swarms, or two tests, on one
  // network.
  std::string discovery_tag;
  // "" lets Cyclone choose; "lo" works where there is nothing else.
  std::string network_interface;
  // Shown by DDS tools as the participant's user data; not with keys: it is not encrypted.
  AgentId self;
  std::string extra_config_xml;  // Cyclone's XML, has the last word (peers)

  // With DDS Security, as the member whose keys these are; without: open to everybody. When the
  // folder's files change (renewed keys, a new list of revoked ones), the exchange joins anew with
  // them within seconds; what it published lately may then have to be published again.
  std::optional<security::MemberKeys> keys;
  // Told of each who was kept out, and why: once, and again after ten minutes; and of new keys.
  // Called by Take.
  std::function<void(const std::string& line)> tell_of_stranger{};

  // How long closing waits for the last messages to arrive. Publish waits for nobody.
  std::chrono::milliseconds close_timeout{1000};
};

// The bus over Cyclone DDS. One participant with the topics of `use`; QoS in qos_table.cc.
// Destroying it says good-bye for the statuses it published (AgentGone at the others) after
// waiting, at most close_timeout, for its last messages to arrive.
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenDdsExchange(
    const DdsOptions& options, const exchange::TopicUse& use);

}  // namespace trailcast::dds
