#include "services/program/radio.h"

#include <gtest/gtest.h>

namespace trailcast::program {
namespace {

constexpr std::string_view kHeads =
    "Inter-| sta-|   Quality        |   Discarded packets               | Missed | WE\n"
    " face | tus | link level noise |  nwid  crypt   frag  retry   misc | beacon | 22\n";

std::optional<std::uint8_t> Percent(const std::string& lines, std::string_view interface = "") {
  return LinkPercent(std::string(kHeads) + lines, interface);
}

TEST(LinkPercent, IsOfTheQualityAboveTheLeastSignal) {
  EXPECT_EQ(
      Percent(" wlan0: 0000   70.  -40.  -256        0      0      0      0      0        0\n"),
      100);
  EXPECT_EQ(
      Percent(" wlan0: 0000   35.  -75.  -256        0      0      0      0      0        0\n"),
      50);
  EXPECT_EQ(
      Percent(" wlan0: 0000   35   -75   -256        0      0      0      0      0        0\n"), 50)
      << "not renewed";
  EXPECT_EQ(Percent("wlp0s20f3: 0000   64  100   0   0   0   0   0   0   0\n"), 64)
      << "a driver that knows no dBm";
}

TEST(LinkPercent, IsOfTheInterfaceInUse) {
  const std::string two =
      " wlan0: 0000   70.  -40.  -256   0   0   0   0   0   0\n"
      " wlan1: 0000    7. -103.  -256   0   0   0   0   0   0\n";
  EXPECT_EQ(Percent(two, "wlan0"), 100);
  EXPECT_EQ(Percent(two, "wlan1"), 10);
  EXPECT_EQ(Percent(two, "eth0"), std::nullopt);
  EXPECT_EQ(Percent(two), std::nullopt) << "which of them?";
}

TEST(LinkPercent, IsNothingWithoutARadioOrAWord) {
  EXPECT_EQ(Percent(""), std::nullopt);
  EXPECT_EQ(LinkPercent("", ""), std::nullopt);
  EXPECT_EQ(LinkPercent("\n:\n::\nwlan0:\nwlan0: 0000\n", ""), std::nullopt);
  EXPECT_EQ(Percent(" wlan0: 0000 nan nan nan 0 0 0 0 0 0\n"), std::nullopt);
  EXPECT_EQ(Percent(" wlan0: 0000 900. -40. 0 0 0 0 0 0 0\n"), 100);
  EXPECT_EQ(Percent(" wlan0: 0000 -5. -40. 0 0 0 0 0 0 0\n"), 0);
  EXPECT_EQ(LinkPercent(std::string("no-such-interface")), std::nullopt);
}

}  // namespace
}  // namespace trailcast::program
