#include "services/base/packet_pieces.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast {
namespace {

class PacketPiecesTest : public testing::Test {
 protected:
  PacketPiecesTest() {
    std::filesystem::create_directories(proc_ / "sys/net/ipv4");
    std::filesystem::create_directories(proc_ / "net");
    Write("sys/net/ipv4/ipfrag_high_thresh", "4194304\n");
    Write("sys/net/ipv4/ipfrag_time", "30\n");
  }
  void Write(const std::string& file, const std::string& text) {
    std::ofstream(proc_ / file) << text;
  }
  [[nodiscard]] std::optional<PacketPieces> Read() const { return ReadPacketPieces(proc_ / ""); }

  const test::TempDir proc_;
};

TEST_F(PacketPiecesTest, AreFullOnceHardlyAnyMemoryIsLeft) {
  Write("net/sockstat", "sockets: used 42\nUDP: inuse 3 mem 512\nFRAG: inuse 130 memory 3653904\n");
  const auto some = Read();
  ASSERT_TRUE(some);
  EXPECT_EQ(some->held_bytes, 3'653'904U);
  EXPECT_EQ(some->most_bytes, 4'194'304U);
  EXPECT_EQ(some->kept_s, 30U);
  EXPECT_FALSE(some->full());
  Write("net/sockstat", "FRAG: inuse 150 memory 4180000\n");
  EXPECT_TRUE(Read()->full());
}

TEST_F(PacketPiecesTest, AreUnknownWhereTheKernelDoesNotTell) {
  EXPECT_FALSE(Read()) << "there is no sockstat";
  Write("net/sockstat", "sockets: used 42\nFRAG: inuse\n");
  EXPECT_FALSE(Read());
  Write("net/sockstat", "FRAG: inuse 0 memory 0\n");
  EXPECT_TRUE(Read());
  Write("sys/net/ipv4/ipfrag_time", "a while");
  EXPECT_FALSE(Read());
}

TEST(PacketPieces, OfThisComputerAreRead) {
  if (!std::filesystem::exists("/proc/sys/net/ipv4/ipfrag_time")) GTEST_SKIP() << "no IPv4 here";
  const auto pieces = ReadPacketPieces();
  ASSERT_TRUE(pieces);
  EXPECT_GT(pieces->most_bytes, 0U);
}

}  // namespace
}  // namespace trailcast
