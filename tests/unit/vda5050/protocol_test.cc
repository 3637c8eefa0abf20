#include "services/vda5050/protocol.h"

#include "tests/unit/vda5050/master.h"

namespace trailcast::vda5050 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ProtocolTest : public testing::TestWithParam<Version> {
 protected:
  Identity identity_{GetParam(), "acme", "robot1"};
};
INSTANTIATE_TEST_SUITE_P(Both, ProtocolTest, testing::Values(Version::k2_1, Version::k3_0),
                         [](const auto& each) {
                           return std::string(each.param == Version::k3_0 ? "of30" : "of21");
                         });

TEST_P(ProtocolTest, ConnectionsAndFactsheetsAreAsTheStandardsSchemasHaveThem) {
  if (!HasSchemas()) GTEST_SKIP() << "../shared/conformance/vda5050 is absent";
  for (const auto connection : {Connection::kOnline, Connection::kOffline, Connection::kBroken}) {
    EXPECT_THAT(Violations(GetParam(), "connection", ConnectionText(identity_, connection, 3, 0)),
                IsEmpty());
  }
  EXPECT_THAT(Violations(GetParam(), "factsheet", FactsheetText(identity_, Body{}, 1, 0)),
              IsEmpty());
  // The teeth of this test.
  EXPECT_THAT(Violations(GetParam(), "connection", R"({"headerId":"1","connectionState":"ON"})"),
              testing::Contains(HasSubstr("/headerId: \"1\" is no \"integer\"")));
  EXPECT_THAT(Violations(GetParam(), "connection", R"({"headerId":"1","connectionState":"ON"})"),
              testing::Contains(HasSubstr("lacks \"serialNumber\"")));
}

TEST(SchemaTest, WhatASchemaForbidsIsNamed) {
  const json schema = json::parse(R"({"type":"object","required":["a"],"properties":{
      "a":{"$ref":"#/definitions/a"},"b":{"type":"array","items":{"enum":["x"]}},
      "t":{"type":"string","format":"date-time"}},
      "definitions":{"a":{"type":["integer","boolean"],"minimum":2}}})");
  EXPECT_THAT(Violations(schema, json::parse(R"({"a":2,"b":["x"],"t":"2026-01-02T03:04:05Z"})")),
              IsEmpty());
  EXPECT_THAT(Violations(schema, json::parse(R"({"a":1,"b":["y"],"t":"today"})")),
              ElementsAre(HasSubstr("/a: 1 is out"), HasSubstr("/b/0: \"y\" is none"),
                          HasSubstr("/t: \"today\" is no")));
  EXPECT_THAT(Violations(schema, json::parse("{}")), ElementsAre(HasSubstr("lacks \"a\"")));
  EXPECT_THAT(Violations(json::parse(R"({"oneOf":[]})"), json()),
              ElementsAre(HasSubstr("keyword oneOf")));
}

TEST(ProtocolWordsTest, TopicsAndTimesAreTheStandards) {
  const Identity new_one{Version::k3_0, "acme", "robot1"};
  EXPECT_EQ(TopicOf(new_one, "state"), "vda5050/v3/acme/robot1/state");
  EXPECT_EQ(TopicOf({Version::k2_1, "acme", "robot1"}, "state"), "uagv/v2/acme/robot1/state");
  EXPECT_EQ(Header(new_one, 1, 1'491'910'803'123).at("timestamp"), "2017-04-11T11:40:03.123Z");
  EXPECT_TRUE(IsTopicWord("acme-2_x.y:z"));
  for (const char* wrong : {"", "a/b", "a+", "#", "a b", "$x"}) EXPECT_FALSE(IsTopicWord(wrong));
}

TEST(FaultTest, WhatStrangersSaidIsToldPlainAndShort) {
  const Fault fault{.type = "VALIDATION_FAILURE",
                    .level = Level::kCritical,
                    .description = std::string(2000, 'x') + "\n\xff",
                    .references = {{"orderId", "a\x1b[2Jb"}}};
  const auto told = FaultJson(fault, Version::k2_1);
  EXPECT_EQ(told.at("errorLevel"), "FATAL") << "2.1 has no other";
  EXPECT_LE(told.at("errorDescription").get<std::string>().size(), 512U);
  EXPECT_EQ(told.at("errorReferences")[0].at("referenceValue").get<std::string>().find('\x1b'),
            std::string::npos);
  EXPECT_EQ(FaultJson(fault, Version::k3_0).at("errorLevel"), "CRITICAL");
}

}  // namespace
}  // namespace trailcast::vda5050
