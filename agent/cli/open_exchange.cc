#include "agent/cli/open_exchange.h"

#include "services/dds/dds_exchange.h"

namespace trailcast::cli {

Result<std::unique_ptr<exchange::RouteExchange>> OpenExchange(const CommonOptions& options,
                                                              const exchange::TopicUse& use) {
  dds::DdsOptions dds;
  dds.domain_id = static_cast<std::uint32_t>(options.domain);
  dds.discovery_tag = options.dds_tag;
  dds.network_interface = options.network_interface;
  dds.self = AgentId(options.name);
  auto opened = dds::OpenDdsExchange(dds, use);
  if (!opened) return Wrap(opened.error(), "joining the network");
  return opened;
}

}  // namespace trailcast::cli
