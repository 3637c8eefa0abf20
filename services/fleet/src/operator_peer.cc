#include "services/fleet/operator_peer.h"

#include <unistd.h>

#include "services/base/process_name.h"
#include "services/program/open_exchange.h"

namespace trailcast::fleet {

Result<OperatorPeer> JoinAsOperator(const program::CommonOptions& common,
                                    const exchange::TopicUse& use, int number) {
  program::CommonOptions network = common;
  // Keys are for the name without the number behind it.
  network.name = ProcessName(common.name, getpid() * 100L + number);
  auto exchange = program::OpenExchange(network, use);
  if (!exchange) return tl::unexpected(exchange.error());
  return OperatorPeer{AgentId(network.name), std::move(*exchange)};
}

}  // namespace trailcast::fleet
