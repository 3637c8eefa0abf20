#include "services/vda5050/order.h"

#include "tests/unit/vda5050/master.h"

namespace trailcast::vda5050 {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

class OrderTest : public testing::TestWithParam<Version> {
 protected:
  OrderTest() { order_ = master_.Order("o1", 0, {"hall:0", "hall:4.5", "dock"}, 2); }
  // Refused, with its type and description.
  std::pair<std::string, std::string> Refused(const json& order) {
    const auto parsed = ParseOrder(identity_, order.dump());
    if (parsed) return {};
    return {parsed.error().type, parsed.error().description};
  }
  json With(const char* pointer, json value) {
    json changed = order_;
    changed[json::json_pointer(pointer)] = std::move(value);
    return changed;
  }

  Identity identity_{GetParam(), "acme", "robot1"};
  Master master_{identity_};
  json order_;
};
INSTANTIATE_TEST_SUITE_P(Both, OrderTest, testing::Values(Version::k2_1, Version::k3_0),
                         [](const auto& each) {
                           return std::string(each.param == Version::k3_0 ? "of30" : "of21");
                         });

TEST_P(OrderTest, NodesAndEdgesAreRead) {
  if (HasSchemas()) {
    EXPECT_THAT(Violations(GetParam(), "order", order_.dump()), IsEmpty());
    EXPECT_THAT(Violations(GetParam(), "instantActions", master_.Actions("a", "b", "c").dump()),
                IsEmpty());
  }
  const auto order = ParseOrder(identity_, order_.dump());
  ASSERT_TRUE(order) << order.error().description;
  EXPECT_EQ(order->id, "o1");
  EXPECT_EQ(order->update, 0U);
  EXPECT_THAT(order->nodes, testing::ElementsAre(Step{"hall:0", 0, true}, Step{"hall:4.5", 2, true},
                                                 Step{"dock", 4, false}));
  EXPECT_THAT(order->edges, testing::ElementsAre(Step{"hall:0-hall:4.5", 1, true},
                                                 Step{"hall:4.5-dock", 3, false}));
  json again = order_;
  again["headerId"] = 8;
  again["timestamp"] = "2026-01-01T00:00:00.000Z";
  EXPECT_EQ(ParseOrder(identity_, again.dump())->content, order->content) << "said again";
}

TEST_P(OrderTest, WhatIsMalformedIsRefusedInWords) {
  const auto is = [](const char* words) { return Pair("VALIDATION_FAILURE", HasSubstr(words)); };
  const auto parsed = [&](const std::string& text) {
    const auto order = ParseOrder(identity_, text);
    return order ? std::pair<std::string, std::string>()
                 : std::pair(order.error().type, order.error().description);
  };
  EXPECT_THAT(parsed("{"), is("no JSON"));
  EXPECT_THAT(parsed("[]"), is("no JSON object"));
  EXPECT_THAT(parsed(std::string(100'000, '[')), is("no JSON"));
  EXPECT_THAT(parsed(std::string(kMostBytes + 1, ' ')), is("262145 bytes"));
  EXPECT_THAT(Refused(With("/version", "1.1.0")), is("version is '1.1.0'"));
  EXPECT_THAT(Refused(With("/serialNumber", "robot2")), is("serialNumber is 'robot2'"));
  EXPECT_THAT(Refused(With("/manufacturer", 3)), is("manufacturer"));
  EXPECT_THAT(Refused(With("/headerId", -1)), is("headerId"));
  EXPECT_THAT(Refused(With("/orderId", "")), is("orderId"));
  EXPECT_THAT(Refused(With("/orderId", "a\nb")), is("orderId"));
  EXPECT_THAT(Refused(With("/orderUpdateId", -1)), is("orderUpdateId"));
  EXPECT_THAT(Refused(With("/orderUpdateId", 4294967296)), is("orderUpdateId"));
  EXPECT_THAT(Refused(With("/nodes", json::array())), is("nodes is no list"));
  EXPECT_THAT(Refused(With("/edges", json::array())), is("edges is no list of 2"));
  EXPECT_THAT(Refused(With("/nodes/0", 5)), is("sequenceId of the first node"));
  EXPECT_THAT(Refused(With("/nodes/1", 5)), is("no object"));
  EXPECT_THAT(Refused(With("/nodes/0/sequenceId", 1)), is("no even number"));
  EXPECT_THAT(Refused(With("/nodes/0/sequenceId", 4294967294)), is("no even number"));
  EXPECT_THAT(Refused(With("/nodes/1/sequenceId", 4)), is("sequenceId of 'hall:4.5' is not 2"));
  EXPECT_THAT(Refused(With("/nodes/1/nodeId", std::string(129, 'x'))), is("nodeId of nodes"));
  EXPECT_THAT(Refused(With("/nodes/0/released", false)), is("first node is not released"));
  EXPECT_THAT(Refused(With("/nodes/1/released", false)), is("contradict"));
  EXPECT_THAT(Refused(With("/nodes/2/released", true)), is("contradict"));
  EXPECT_THAT(Refused(With("/edges/0/released", 1)), is("neither true nor false"));
  EXPECT_THAT(Refused(With("/edges/0/actions", nullptr)), is("no list of actions"));
  if (GetParam() == Version::k2_1) {
    EXPECT_THAT(Refused(With("/edges/0/endNodeId", "dock")), is("startNodeId and endNodeId"));
  }
  const auto fault = ParseOrder(identity_, With("/edges", json::array()).dump()).error();
  EXPECT_THAT(fault.references,
              AllOf(Contains(Pair("orderId", "o1")), Contains(Pair("orderUpdateId", "0"))));
}

TEST_P(OrderTest, WhatARouteFollowerCannotDoIsRefused) {
  const bool is_new = GetParam() == Version::k3_0;
  EXPECT_THAT(Refused(With("/edges/0/trajectory", json::object())),
              Pair("UNSUPPORTED_PARAMETER", HasSubstr("trajectory")));
  EXPECT_THAT(Refused(With(is_new ? "/edges/1/maximumSpeed" : "/edges/1/maxSpeed", 0.5)),
              Pair("UNSUPPORTED_PARAMETER", HasSubstr("hall:4.5-dock has ma")));
  EXPECT_EQ(ParseOrder(identity_, With("/edges/0/trajectory", json::object()).dump()).error().level,
            Level::kCritical);
  const json action{{"actionType", "pick"}, {"actionId", "a1"}, {"blockingType", "HARD"}};
  EXPECT_THAT(Refused(With("/nodes/2/actions", json::array({action}))),
              Pair("INVALID_ORDER_ACTION", HasSubstr("dock has actions")));
  EXPECT_THAT(Refused(With("/nodes/0/nodePosition", {{"x", 1}, {"y", 2}, {"mapId", "m"}})),
              Pair("UNKNOWN_MAP_ID", HasSubstr("map 'm'")));
  EXPECT_EQ(Refused(With("/edges/0/trajectory", nullptr)).first, "") << "says nothing";
}

TEST_P(OrderTest, InstantActionsAreRead) {
  const auto actions =
      ParseInstantActions(identity_, master_.Actions("cancelOrder", "a1", "o1").dump());
  ASSERT_TRUE(actions);
  ASSERT_EQ(actions->size(), 1U);
  EXPECT_EQ(actions->front().type, "cancelOrder");
  EXPECT_EQ(actions->front().id, "a1");
  EXPECT_EQ(actions->front().order, "o1");
  json many = master_.Actions("startPause", "a");
  for (std::size_t i = 0; i < kMostActions; ++i) many["actions"].push_back(many["actions"][0]);
  for (const json& wrong : {many, master_.Actions("", "a"), master_.Actions("startPause", ""),
                            json(master_.Head()), json("x")}) {
    const auto refused = ParseInstantActions(identity_, wrong.dump());
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().type, "VALIDATION_FAILURE");
    EXPECT_THAT(refused.error().references, Contains(Pair("topic", "instantActions")));
  }
}

}  // namespace
}  // namespace trailcast::vda5050
