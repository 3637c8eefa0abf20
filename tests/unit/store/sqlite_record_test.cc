#include "services/store/src/salvage/sqlite_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::store {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Kind = RecordValue::Kind;

TEST(SqliteRecord, NumbersHaveOneToNineBytes) {
  EXPECT_EQ(ReadVarint(Bytes{0x7F})->value, 127U);
  EXPECT_EQ(ReadVarint(Bytes{0x81, 0x00})->value, 128U);
  const Bytes most(9, 0xFF);
  EXPECT_EQ(ReadVarint(most)->value, UINT64_MAX);
  EXPECT_TRUE(ReadVarint(most)->rest.empty());
  EXPECT_FALSE(ReadVarint(Bytes{0x81}));
  EXPECT_FALSE(ReadVarint(Bytes{}));
}

TEST(SqliteRecord, HasItsColumnsTypesAndThenTheirValues) {
  // NULL, 1, -2 in two bytes, 0.5, 'ab', x'07'.
  const Bytes record{7,    0, 9, 2, 7, 17, 14,  0xFF, 0xFE, 0x3F, 0xE0,
                     0x00, 0, 0, 0, 0, 0,  'a', 'b',  7,    99};
  const auto header = ReadRecordHeader(record, 6);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->record_bytes, record.size() - 1);
  const Record values = ReadRecord(*header, record);
  ASSERT_EQ(values.size(), 6U);
  EXPECT_EQ(values[0].kind, Kind::kNull);
  EXPECT_EQ(values[1].integer, 1);
  EXPECT_EQ(values[2].integer, -2);
  EXPECT_EQ(values[3].real, 0.5);
  EXPECT_EQ(values[4].kind, Kind::kText);
  EXPECT_THAT(values[4].bytes, testing::ElementsAre('a', 'b'));
  EXPECT_EQ(values[5].kind, Kind::kBlob);
  EXPECT_THAT(values[5].bytes, testing::ElementsAre(7));
  EXPECT_FALSE(ReadRecordHeader(record, 5)) << "more columns than are wanted";
}

TEST(SqliteRecord, WhatIsCutOffOrImpossibleIsNone) {
  EXPECT_FALSE(ReadRecordHeader(Bytes{}, 9));
  EXPECT_FALSE(ReadRecordHeader(Bytes{0}, 9)) << "shorter than itself";
  EXPECT_FALSE(ReadRecordHeader(Bytes{3, 1}, 9)) << "longer than what is there";
  EXPECT_FALSE(ReadRecordHeader(Bytes{2, 10}, 9)) << "a type that means nothing";
  EXPECT_FALSE(ReadRecordHeader(Bytes{2, 0x81}, 9)) << "a type that goes on beyond its end";
}

}  // namespace
}  // namespace trailcast::store
