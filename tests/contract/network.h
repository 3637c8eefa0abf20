#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/dds/dds_exchange.h"
#include "services/exchange/route_exchange.h"
#include "tests/support/unique_tag.h"

namespace trailcast::test {

// What the contract is tested on: a bus in process, or DDS on the loopback interface, shut off from
// other tests by a discovery tag of its own.
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

// Reads and writes everything.
[[nodiscard]] exchange::TopicUse EveryTopic();

// Takes from `exchange`, giving each message to `use`, until `done`; false if that takes too long.
[[nodiscard]] bool TakeUntil(exchange::RouteExchange& exchange,
                             const std::function<void(const exchange::Message&)>& use,
                             const std::function<bool()>& done);

// Endpoints find each other in the background: publishes probes on the topic until each of
// `readers` has got one, then takes what is left of them. False if that takes too long. Who listens
// by route has to listen to the probes' one.
[[nodiscard]] bool Connect(exchange::RouteExchange& writer, exchange::Topic topic,
                           const std::vector<exchange::RouteExchange*>& readers);
[[nodiscard]] route::RouteKey ProbeRoute();
[[nodiscard]] bool IsProbe(const exchange::Message& message);

}  // namespace trailcast::test
