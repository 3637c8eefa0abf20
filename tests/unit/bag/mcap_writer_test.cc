#include "services/bag/mcap_writer.h"

#include <gtest/gtest.h>

#include "tests/support/recorded/bag_writers.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/bag/bag_reading.h"

namespace trailcast::bag {
namespace {

using std::chrono::milliseconds;

Bytes Append(Bytes bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
  return bytes;
}

TEST(McapWriter, WhatWasTakenBitByBitIsOneFile) {
  const test::TempDir folder;
  McapWriter writer(Compression::kZstd, "");
  const auto schema = writer.AddSchema("Some", "protobuf", Bytes{1, 2, 3});
  const auto first = writer.AddChannel(schema, "/first", "protobuf");
  Bytes file = writer.TakeBytes();
  for (int i = 0; i < 10; ++i) {
    writer.Put(first, milliseconds(i), Bytes(10, static_cast<std::uint8_t>(i)));
    if (i % 3 == 2) writer.EndChunk();
    file = Append(std::move(file), writer.TakeBytes());
  }
  const auto second = writer.AddChannel(0, "/second", "json");
  writer.Put(second, milliseconds(3), Bytes{'{', '}'});
  writer.End();
  file = Append(std::move(file), writer.TakeBytes());
  test::WriteBytes(folder / "a.mcap", file);

  const auto bag = OpenBag(folder / "a.mcap");
  ASSERT_TRUE(bag);
  ASSERT_EQ(bag->topics().size(), 2U);
  EXPECT_EQ(bag->topics()[0].type, "Some");
  EXPECT_EQ(bag->topics()[1].encoding, "json");
  EXPECT_EQ(ReadAll(*bag, "/first").size(), 10U);
  EXPECT_EQ(ReadAll(*bag, "/second").size(), 1U);
}

TEST(McapWriter, AFileWithoutMessagesHasAnEnd) {
  const test::TempDir folder;
  McapWriter writer(Compression::kNone, "");
  writer.End();
  test::WriteBytes(folder / "a.mcap", writer.TakeBytes());
  const auto bag = OpenBag(folder / "a.mcap");
  ASSERT_TRUE(bag);
  EXPECT_TRUE(bag->topics().empty());
  EXPECT_TRUE(bag->damage().empty());
}

TEST(McapWriter, ItIsReadFromATimeOn) {
  const test::TempDir folder;
  McapWriter writer(Compression::kZstd, "");
  const auto channel = writer.AddChannel(0, "/a", "");
  for (int i = 0; i < 10; ++i) {
    writer.Put(channel, milliseconds(i), Bytes(10, static_cast<std::uint8_t>(i)));
    if (i % 3 == 2) writer.EndChunk();
  }
  const Bytes whole_chunks = writer.TakeBytes();
  writer.End();
  const Bytes ended = Append(whole_chunks, writer.TakeBytes());
  test::WriteBytes(folder / "a.mcap", ended);
  test::WriteBytes(folder / "cut.mcap", whole_chunks);

  const auto bag = OpenBag(folder / "a.mcap");
  ASSERT_TRUE(bag);
  EXPECT_EQ(bag->last_at(), milliseconds(9));
  bag->Begin(bag->topics()[0], milliseconds(4));
  const auto message = bag->Next();
  ASSERT_TRUE(message && *message);
  EXPECT_EQ((*message)->logged_at, milliseconds(4)) << "from within a chunk";
  bag->Begin(bag->topics()[0], milliseconds(10));
  EXPECT_FALSE(*bag->Next());
  EXPECT_EQ(ReadAll(*bag, "/a").size(), 10U) << "and from the first again";
  EXPECT_EQ(OpenBag(folder / "cut.mcap")->last_at(), milliseconds(8));
}

TEST(McapWriter, ChunksEndByThemselves) {
  McapWriter writer(Compression::kNone, "");
  const auto channel = writer.AddChannel(0, "/a", "");
  (void)writer.TakeBytes();
  for (int i = 0; i < 11; ++i) writer.Put(channel, milliseconds(i), Bytes(100'000));
  EXPECT_GT(writer.TakeBytes().size(), 1'000'000U);
}

}  // namespace
}  // namespace trailcast::bag
