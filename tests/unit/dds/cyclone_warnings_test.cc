#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/dds/src/domain/cyclone_log.h"

namespace trailcast::dds {
namespace {

using std::chrono::minutes;
using testing::HasSubstr;

TEST(CycloneWarnings, LinesThatDifferInNumbersAreToldOnceAndCounted) {
  CycloneWarnings warnings;
  const CycloneWarnings::Time now{};
  const std::string first = "ddsi_udp_conn_write to udp/239.255.0.2:7402 failed with retcode -1";
  const std::string next = "ddsi_udp_conn_write to udp/239.255.0.1:7400 failed with retcode -1";
  EXPECT_EQ(warnings.Note(first, now), first);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(warnings.Note(next, now + minutes(5)), "");
  EXPECT_EQ(warnings.Note("another matter", now + minutes(5)), "another matter");
  EXPECT_THAT(warnings.Note(next, now + minutes(11)), HasSubstr("and 3 alike"));
  EXPECT_EQ(warnings.Note(next, now + minutes(22)), next) << "none in between";
}

}  // namespace
}  // namespace trailcast::dds
