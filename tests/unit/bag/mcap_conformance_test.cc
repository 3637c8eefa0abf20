// MCAP's own conformance suite (https://github.com/foxglove/mcap, tests/conformance): one file for
// each combination of what a writer may do and leave out, and beside it, as JSON, what it holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "services/bag/bag.h"
#include "tests/support/places.h"
#include "tests/unit/bag/bag_reading.h"

namespace trailcast::bag {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kFiles = 416;

struct Said {
  std::string type;
  std::string encoding;
  std::vector<Read> messages;
};

std::uint64_t Number(const json& text) { return std::stoull(text.get<std::string>()); }

Bytes Octets(const json& texts) {
  Bytes bytes;
  for (const json& text : texts) bytes.push_back(static_cast<std::uint8_t>(Number(text)));
  return bytes;
}

// By topic: what the file has between its header and the end of its data.
std::map<std::string, Said> WhatIsSaid(const fs::path& file) {
  std::ifstream stream(file);
  std::map<std::string, std::string> schemas;
  std::map<std::string, std::string> topics;  // of channels
  std::map<std::string, Said> said;
  const json all = json::parse(stream);
  for (const json& record : all.at("records")) {
    std::map<std::string, json> fields;
    for (const json& field : record.at("fields")) fields[field.at(0)] = field.at(1);
    const std::string type = record.at("type");
    if (type == "DataEnd") break;
    if (type == "Schema") schemas[fields["id"]] = fields["name"];
    if (type == "Channel") {
      topics[fields["id"]] = fields["topic"];
      said[fields["topic"]].type = schemas[fields["schema_id"]];
      said[fields["topic"]].encoding = fields["message_encoding"];
    }
    if (type == "Message") {
      said[topics.at(fields["channel_id"])].messages.push_back(
          {std::chrono::nanoseconds(Number(fields["log_time"])), Octets(fields["data"])});
    }
  }
  return said;
}

TEST(McapConformance, AllOfEveryFileIsRead) {
  const fs::path suite = fs::path(SourceDir()) / ".." / "shared" / "conformance" / "mcap";
  if (!fs::is_directory(suite)) GTEST_SKIP() << suite << " is not on this machine";
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(suite)) {
    if (entry.path().extension() != ".mcap") continue;
    ++files;
    SCOPED_TRACE(entry.path().filename());
    const auto said = WhatIsSaid(fs::path(entry.path()).replace_extension(".json"));
    const auto bag = OpenBag(entry.path());
    ASSERT_TRUE(bag);
    EXPECT_EQ(bag->topics().size(), said.size());
    for (const Topic& topic : bag->topics()) {
      ASSERT_TRUE(said.contains(topic.name)) << topic.name;
      const Said& expected = said.at(topic.name);
      EXPECT_EQ(topic.type, expected.type);
      EXPECT_EQ(topic.encoding, expected.encoding);
      EXPECT_EQ(topic.messages, expected.messages.size());
      EXPECT_EQ(ReadAll(*bag, topic.name), expected.messages);
    }
    EXPECT_THAT(bag->damage(), testing::IsEmpty());
  }
  EXPECT_EQ(files, kFiles) << "in " << suite;
}

}  // namespace
}  // namespace trailcast::bag
