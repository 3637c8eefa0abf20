#include "services/program/json.h"

#include <gtest/gtest.h>

#include <limits>

namespace trailcast::program {
namespace {

TEST(Json, IsTextWhateverItsTextsAre) {
  const Json json = {{"name", "a\"\xff"}, {"count", 2}, {"at", {{"m", 1.5}}}};
  EXPECT_EQ(OneLine(json), "{\"name\":\"a\\\"\uFFFD\",\"count\":2,\"at\":{\"m\":1.5}}");
  EXPECT_EQ(Indented(json),
            "{\n  \"name\": \"a\\\"\uFFFD\",\n  \"count\": 2,\n  \"at\": {\n    \"m\": 1.5\n  "
            "}\n}\n");
}

TEST(Json, NumbersAreAsLongAsTheyAreRounded) {
  EXPECT_EQ(OneLine(Rounded(0.1 + 0.2, 100.0)), "0.3");
  EXPECT_EQ(OneLine(Rounded(-2.3456, 100.0)), "-2.35");
  EXPECT_EQ(OneLine(RoundedOrNull(1.0 / 3.0, 1000.0)), "0.333");
  EXPECT_EQ(OneLine(RoundedOrNull(std::nullopt, 1.0)), "null");
  EXPECT_EQ(OneLine(RoundedOrNull(std::numeric_limits<double>::infinity(), 1.0)), "null");
  EXPECT_EQ(OneLine(OrNull(std::optional<int>(7))), "7");
  EXPECT_EQ(OneLine(OrNull(std::optional<int>())), "null");
}

}  // namespace
}  // namespace trailcast::program
