#include "services/http/address.h"

#include <gtest/gtest.h>

namespace trailcast::http {
namespace {

TEST(AddressKey, OfIPv6TheNetworkCounts) {
  EXPECT_EQ(AddressKey("192.0.2.1"), "192.0.2.1");
  EXPECT_EQ(AddressKey("::ffff:192.0.2.1"), "192.0.2.1");
  EXPECT_EQ(AddressKey("2001:db8:1:2:3:4:5:6"), AddressKey("2001:db8:1:2::9"));
  EXPECT_NE(AddressKey("2001:db8:1:2::9"), AddressKey("2001:db8:1:3::9"));
  EXPECT_EQ(AddressKey("anything"), "anything");
}

}  // namespace
}  // namespace trailcast::http
