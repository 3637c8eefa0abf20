#include "agent/tool/operator.h"

#include <unistd.h>

#include "agent/cli/open_exchange.h"

namespace trailcast::tool {

AgentId OperatorName(const cli::CommonOptions& common) {
  return AgentId(fmt::format("{}-{}", common.name, getpid()));
}

Result<std::unique_ptr<exchange::RouteExchange>> OpenAsOperator(const cli::CommonOptions& common,
                                                                const AgentId& name) {
  cli::CommonOptions network = common;
  network.name = name.value();
  return cli::OpenExchange(network, exchange::OperatorTopics());
}

std::chrono::milliseconds Milliseconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::duration<double>(seconds));
}

}  // namespace trailcast::tool
