#include "services/tool/keys_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::tool {
namespace {

using security::Authority;
using security::Role;
using testing::HasSubstr;

TEST(KeysReport, ShowsEachMemberWithItsStateForPeopleAndPrograms) {
  const auto expires = std::chrono::system_clock::from_time_t(1'795'363'200);
  const std::vector<Authority::Row> rows{
      {"robot1", {Role::kScout, "4f2a9c0d11223344", 2}, expires, Authority::State::kValid},
      {"x", {Role::kServer, "0011223344556677", 1}, expires, Authority::State::kRevoked}};
  EXPECT_EQ(KeysTable(rows),
            "name    role      expires               state    keys  id\n"
            "robot1  scout     2026-11-22T16:00:00Z  valid       2  4f2a9c0d11223344\n"
            "x       server    2026-11-22T16:00:00Z  revoked     1  0011223344556677\n");
  EXPECT_THAT(KeysJson(rows).dump(),
              HasSubstr(R"({"name":"x","role":"server","expires":"2026-11-22T16:00:00Z",)"
                        R"("state":"revoked","generation":1,"id":"0011223344556677"})"));
  EXPECT_EQ(KeysTable({}), "no members\n");
  EXPECT_EQ(KeysJson({}).dump(), "[]");
}

}  // namespace
}  // namespace trailcast::tool
