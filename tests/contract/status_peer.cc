// A process of its own on the test's network: says "I am here" and takes segments until it is told
// to end, or killed.
// status_peer <discovery tag> <agent> <instance>
#include <csignal>
#include <cstdio>
#include <string>

#include "services/dds/dds_exchange.h"

namespace {
volatile std::sig_atomic_t g_end = 0;
}

int main(int argc, char** argv) {
  using trailcast::AgentId;
  using trailcast::exchange::Topic;
  if (argc != 4) return 2;
  std::signal(SIGTERM, [](int) { g_end = 1; });
  trailcast::dds::DdsOptions options;
  options.discovery_tag = argv[1];
  options.network_interface = "lo";
  options.self = AgentId(argv[2]);
  auto exchange = trailcast::dds::OpenDdsExchange(
      options, {.write = {Topic::kAgents}, .read = {Topic::kSegments}});
  if (!exchange) {
    std::fprintf(stderr, "%s\n", exchange.error().message.c_str());
    return 1;
  }
  while (g_end == 0) {
    const trailcast::exchange::AgentStatus status{.agent = options.self,
                                                  .instance = std::stoull(argv[3])};
    if (!(*exchange)->Publish(status)) return 1;
    (void)(*exchange)->Take(std::chrono::milliseconds(100));
  }
  return 0;
}
