#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/packet_pieces.h"

namespace trailcast::tool {

// This is one result of examining the machine, with advice.
struct Finding {
  enum class Grade : std::uint8_t { kGood, kWarning, kBad };
  Grade grade = Grade::kGood;
  std::string what;
  std::string advice;  // empty if there is none
};

struct NetworkInterface {
  std::string name;
  bool up = false;
  bool multicast = false;
  bool loopback = false;
};

// Takes the kernel's bound on a socket's receive buffer in bytes, or nothing if it could not be
// read. Routes come in bursts: with Debian's 208 KiB a busy machine loses some of each, and it is
// sent again.
[[nodiscard]] Finding JudgeReceiveBuffer(std::optional<std::uint64_t> most_bytes);
// Takes the kernel's memory for packets that come in pieces, or nothing if it could not be read.
// Other programs' pictures come so: over a link that loses packets Debian's 4 MB are full within
// seconds, and then none comes.
[[nodiscard]] Finding JudgePacketPieces(const std::optional<PacketPieces>& pieces);
// `wanted` is the interface to use. If it is empty, DDS chooses.
[[nodiscard]] Finding JudgeNetwork(const std::vector<NetworkInterface>& interfaces,
                                   const std::string& wanted);
// Takes the kernel's estimate of its clock's error in seconds, or nothing if no program keeps the
// clock right.
[[nodiscard]] Finding JudgeClock(std::optional<double> off_s);
// `uri` is CYCLONEDDS_URI, as Cyclone DDS reads it: files or XML, with commas between.
[[nodiscard]] Finding JudgeCycloneUri(const std::string& uri);
[[nodiscard]] Finding JudgeDisk(const std::filesystem::path& folder,
                                std::optional<std::uint64_t> free_bytes);

// Judges all of that on this machine, with `folder` for its routes.
[[nodiscard]] std::vector<Finding> ExamineMachine(const std::filesystem::path& folder,
                                                  const std::string& network_interface);

// Returns a line for each finding, with "ok", "warn" or "BAD" first and the advice below.
[[nodiscard]] std::string CheckupText(const std::vector<Finding>& findings);

}  // namespace trailcast::tool
