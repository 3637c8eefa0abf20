#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/dds/dds_exchange.h"
#include "services/exchange/route_exchange.h"
#include "tests/support/unique_tag.h"

namespace trailcast::test {

// The contract is tested on a bus in process, and on DDS on the loopback interface, which a
// discovery tag separates from other tests.
class Network {
 public:
  virtual ~Network() = default;
  [[nodiscard]] virtual std::unique_ptr<exchange::RouteExchange> Open(
      const exchange::TopicUse& use) = 0;
};

enum class NetworkKind { kInProcess, kDds };
[[nodiscard]] std::unique_ptr<Network> MakeNetwork(NetworkKind kind);
[[nodiscard]] std::string NameOf(NetworkKind kind);

[[nodiscard]] dds::DdsOptions LoopbackOptions(const std::string& tag);

// This reads and writes everything.
[[nodiscard]] exchange::TopicUse EveryTopic();

// Takes from `exchange` and gives each message to `use`, until `done`. Returns false if that takes
// too long.
[[nodiscard]] bool TakeUntil(exchange::RouteExchange& exchange,
                             const std::function<void(const exchange::Message&)>& use,
                             const std::function<bool()>& done);

// Endpoints find each other in the background, so this publishes probes on the topic until each of
// `readers` has got one, and then takes what is left of them. Returns false if that takes too long.
// A reader that listens by route must listen to the probes' route.
[[nodiscard]] bool Connect(exchange::RouteExchange& writer, exchange::Topic topic,
                           const std::vector<exchange::RouteExchange*>& readers);
[[nodiscard]] route::RouteKey ProbeRoute();
[[nodiscard]] bool IsProbe(const exchange::Message& message);

}  // namespace trailcast::test
