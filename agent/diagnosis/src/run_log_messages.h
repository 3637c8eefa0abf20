#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "agent/diagnosis/run_log.h"
#include "services/bag/bag.h"
#include "services/base/result.h"

namespace trailcast::agent {

// A log has its messages of idl/run_log.proto under these topics of its MCAP file, and its readers
// use only these.
inline constexpr const char* kHeaderTopic = "/replay/header";
inline constexpr const char* kFrameTopic = "/replay/frame";
inline constexpr const char* kEventTopic = "/replay/event";
// A longer message is damage.
inline constexpr std::size_t kLongestMessage = std::size_t{16} << 10U;
inline constexpr std::size_t kMostFields = 64;

[[nodiscard]] std::string HeaderMessage(const Fields& header);
[[nodiscard]] std::string FrameMessage(const FrameRow& row);
[[nodiscard]] std::string EventMessage(const RunEvent& event);

// These read bytes that may come from anybody. They return plain texts and finite numbers, and skip
// fields that they do not know. Errors are kCorrupt and say what is wrong with the message.
[[nodiscard]] Result<Fields> ReadHeader(std::span<const std::uint8_t> message);
[[nodiscard]] Result<FrameRow> ReadFrame(std::span<const std::uint8_t> message);
[[nodiscard]] Result<RunEvent> ReadEvent(std::span<const std::uint8_t> message);

// Opens an MCAP file with a bound on its unpacked size. Errors: kNotFound, or that it is no such
// file.
[[nodiscard]] Result<std::unique_ptr<bag::Bag>> OpenMcap(const std::filesystem::path& file);

}  // namespace trailcast::agent
