// Orders and instant actions of a fleet manager that speaks VDA 5050, as anybody may send them to
// the broker.
#include <nlohmann/json.hpp>
#include <string>

#include "services/base/text.h"
#include "services/vda5050/order.h"
#include "tests/fuzz/fuzz.h"

namespace vda5050 = trailcast::vda5050;
using trailcast::fuzz::Require;

namespace {

void CheckRefusal(const vda5050::Fault& fault, vda5050::Version version) {
  Require(!fault.type.empty() && !fault.description.empty(), "a refusal says why");
  // Texts of strangers are made plain, or this throws.
  Require(!vda5050::FaultJson(fault, version).dump().empty(), "a refusal can be told");
}

void CheckOrder(const vda5050::Order& order) {
  Require(!order.id.empty() && order.id.size() <= vda5050::kMostIdBytes, "an order has an id");
  Require(!order.nodes.empty() && order.nodes.size() <= vda5050::kMostNodes, "nodes are bounded");
  Require(order.edges.size() + 1 == order.nodes.size(), "an edge leads to each next node");
  Require(order.nodes.front().released, "the first node is released");
  for (std::size_t i = 1; i < order.nodes.size(); ++i) {
    Require(order.nodes[i].sequence > order.nodes[i - 1].sequence, "nodes are in their order");
    Require(order.nodes[i - 1].released || !order.nodes[i].released,
            "what is released comes first");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const auto version : {vda5050::Version::k2_1, vda5050::Version::k3_0}) {
    const vda5050::Identity identity{version, "acme", "robot1"};
    if (const auto order = vda5050::ParseOrder(identity, text)) {
      CheckOrder(*order);
    } else {
      CheckRefusal(order.error(), version);
    }
    if (const auto actions = vda5050::ParseInstantActions(identity, text)) {
      Require(actions->size() <= vda5050::kMostActions, "actions are bounded");
    } else {
      CheckRefusal(actions.error(), version);
    }
  }
  return 0;
}
