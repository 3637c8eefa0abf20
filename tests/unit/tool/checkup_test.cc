#include "services/tool/checkup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::tool {
namespace {

using testing::HasSubstr;
using Grade = Finding::Grade;

TEST(Checkup, ReceiveBuffersOfDebianAreSmall) {
  const Finding stock = JudgeReceiveBuffer(212'992);
  EXPECT_EQ(stock.grade, Grade::kWarning);
  EXPECT_THAT(stock.what, HasSubstr("208 KiB"));
  EXPECT_THAT(stock.advice, HasSubstr("net.core.rmem_max=4194304"));
  EXPECT_EQ(JudgeReceiveBuffer(4U << 20U).grade, Grade::kGood);
  EXPECT_EQ(JudgeReceiveBuffer(std::nullopt).grade, Grade::kWarning);
}

TEST(Checkup, MemoryOfDebianForPacketsInPiecesIsSmall) {
  const Finding stock = JudgePacketPieces(PacketPieces{0, 4U << 20U, 30});
  EXPECT_EQ(stock.grade, Grade::kWarning);
  EXPECT_THAT(stock.what, HasSubstr("4.0 MiB of memory, for 30 s"));
  EXPECT_THAT(stock.advice, HasSubstr("ipfrag_time=3"));
  EXPECT_EQ(JudgePacketPieces(PacketPieces{0, 4U << 20U, 3}).grade, Grade::kGood);
  EXPECT_EQ(JudgePacketPieces(PacketPieces{0, 64U << 20U, 30}).grade, Grade::kGood);
  EXPECT_EQ(JudgePacketPieces(std::nullopt).grade, Grade::kWarning);
}

TEST(Checkup, NetworkNeedsAnInterfaceThatIsUpWithMulticast) {
  const NetworkInterface lo{"lo", true, false, true};
  const NetworkInterface wlan{"wlan0", true, true, false};
  const NetworkInterface down{"eth0", false, true, false};
  const NetworkInterface mute{"wg0", true, false, false};
  EXPECT_EQ(JudgeNetwork({lo, wlan}, "").grade, Grade::kGood);
  EXPECT_EQ(JudgeNetwork({lo, wlan}, "lo").grade, Grade::kGood);
  EXPECT_EQ(JudgeNetwork({lo}, "").grade, Grade::kWarning);
  EXPECT_EQ(JudgeNetwork({lo, down}, "").grade, Grade::kWarning);
  EXPECT_THAT(JudgeNetwork({lo, down}, "eth0").advice, HasSubstr("ip link set eth0 up"));
  EXPECT_THAT(JudgeNetwork({lo, mute}, "").advice, HasSubstr("multicast on"));
  const Finding unknown = JudgeNetwork({lo, wlan}, "wlan1");
  EXPECT_EQ(unknown.grade, Grade::kBad);
  EXPECT_THAT(unknown.advice, HasSubstr("lo, wlan0"));
}

TEST(Checkup, AClockThatNobodyKeepsRightIsAWarning) {
  EXPECT_EQ(JudgeClock(0.05).grade, Grade::kGood);
  EXPECT_THAT(JudgeClock(16.0).what, HasSubstr("off by 16.0 s"));
  EXPECT_THAT(JudgeClock(std::nullopt).advice, HasSubstr("chrony"));
}

TEST(Checkup, SettingsOfDdsHaveToBeThere) {
  const test::TempDir folder;
  const std::string file = (folder / "dds.xml").string();
  EXPECT_EQ(JudgeCycloneUri("").grade, Grade::kGood);
  EXPECT_EQ(JudgeCycloneUri("<CycloneDDS/>").grade, Grade::kGood);
  EXPECT_THAT(JudgeCycloneUri("file://" + file).what, HasSubstr(file));
  EXPECT_EQ(JudgeCycloneUri("file://" + file).grade, Grade::kBad);
  std::ofstream(file) << "<CycloneDDS/>";
  EXPECT_EQ(JudgeCycloneUri("file://" + file).grade, Grade::kGood);
  EXPECT_EQ(JudgeCycloneUri(file + ",/nowhere.xml").grade, Grade::kBad);
}

TEST(Checkup, ADiskIsGoodLowOrFull) {
  EXPECT_EQ(JudgeDisk("/data", 5ULL << 30U).grade, Grade::kGood);
  EXPECT_EQ(JudgeDisk("/data", 500ULL << 20U).grade, Grade::kWarning);
  EXPECT_EQ(JudgeDisk("/data", 1ULL << 20U).grade, Grade::kBad);
  EXPECT_THAT(JudgeDisk("/nowhere", std::nullopt).what, HasSubstr("no folder /nowhere"));
}

TEST(Checkup, ThisMachineGetsALineForEach) {
  const auto findings = ExamineMachine(".", "lo");
  ASSERT_EQ(findings.size(), 6U);
  EXPECT_EQ(findings[2].grade, Grade::kGood);
  const std::string text = CheckupText(findings);
  for (const char* what :
       {"receive buffers", "packets in pieces", "network", "clock", "settings of DDS", "disk"}) {
    EXPECT_THAT(text, HasSubstr(what));
  }
}

}  // namespace
}  // namespace trailcast::tool
