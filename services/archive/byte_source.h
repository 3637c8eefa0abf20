#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "services/base/result.h"

namespace trailcast::archive {

// A known number of bytes that do not change and can be read at any place.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  [[nodiscard]] virtual const std::string& name() const = 0;  // for messages
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  // Fills `out` from `offset` on, which must lie within size(). kUnavailable names the source if it
  // cannot be read, or has become shorter since.
  [[nodiscard]] virtual Result<void> Read(std::uint64_t offset,
                                          std::span<std::uint8_t> out) const = 0;

 protected:
  ByteSource() = default;
};

// Errors: kNotFound without such a file, kInvalidArgument for a folder, a pipe or a device,
// kUnavailable if it cannot be opened.
[[nodiscard]] Result<std::unique_ptr<ByteSource>> OpenFile(const std::filesystem::path& path);
// Reads from memory; `bytes` must outlive the source.
[[nodiscard]] std::unique_ptr<ByteSource> FromMemory(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::archive
