#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trailcast::tool {

// What a look at this machine found, and what to do about it.
struct Finding {
  enum class Grade : std::uint8_t { kGood, kWarning, kBad };
  Grade grade = Grade::kGood;
  std::string what;
  std::string advice;  // empty when there is none to give
};

struct NetworkInterface {
  std::string name;
  bool up = false;
  bool multicast = false;
  bool loopback = false;
};

// The kernel's bound on a socket's receive buffer, bytes; nothing: it could not be read. Routes
// come in bursts: with Debian's 208 KiB some of each is lost on a busy machine, and sent again.
[[nodiscard]] Finding JudgeReceiveBuffer(std::optional<std::uint64_t> most_bytes);
// `wanted`: the one to be used; empty: DDS chooses.
[[nodiscard]] Finding JudgeNetwork(const std::vector<NetworkInterface>& interfaces,
                                   const std::string& wanted);
// How far the kernel thinks its clock may be off, seconds; nothing: nobody keeps it right.
[[nodiscard]] Finding JudgeClock(std::optional<double> off_s);
// `uri`: CYCLONEDDS_URI, as Cyclone DDS reads it: files, or XML itself, with commas between.
[[nodiscard]] Finding JudgeCycloneUri(const std::string& uri);
[[nodiscard]] Finding JudgeDisk(const std::filesystem::path& folder,
                                std::optional<std::uint64_t> free_bytes);

// All of that on this machine, with `folder` for its routes.
[[nodiscard]] std::vector<Finding> ExamineMachine(const std::filesystem::path& folder,
                                                  const std::string& network_interface);

// One line each, "ok", "warn" or "BAD" first, the advice below.
[[nodiscard]] std::string CheckupText(const std::vector<Finding>& findings);

}  // namespace trailcast::tool
