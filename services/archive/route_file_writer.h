#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "services/base/result.h"
#include "services/route/digest.h"
#include "services/route/route.h"

namespace trailcast::archive {

// Writes a complete route as one file: under another name beside it until all of it is on the disk
// and was read back, so that there is the whole file or none. Equal routes give equal files.
class RouteFileWriter {
 public:
  enum class Existing : std::uint8_t { kKeep, kReplace };

  // kInvalidArgument for a route that is not complete or out of bounds; kConflict when `path` is
  // there already and shall be kept, or is no file; kUnavailable when its folder cannot be written.
  [[nodiscard]] static Result<RouteFileWriter> Create(std::filesystem::path path,
                                                      const route::RouteInfo& info,
                                                      Existing existing);
  // Without Finish nothing is left behind.
  ~RouteFileWriter();
  RouteFileWriter(RouteFileWriter&& other) noexcept;
  RouteFileWriter& operator=(RouteFileWriter&&) = delete;
  RouteFileWriter(const RouteFileWriter&) = delete;
  RouteFileWriter& operator=(const RouteFileWriter&) = delete;

  // The next segment in order of index: kInvalidArgument for any other. kCorrupt if its bytes fail
  // their digest; kUnavailable when the disk is full.
  [[nodiscard]] Result<void> Add(const route::SegmentPiece& piece);
  // All segments were added: on disk under its name when this returns. Returns the file's size.
  // kCorrupt when they do not make up the route.
  [[nodiscard]] Result<std::uint64_t> Finish();

 private:
  RouteFileWriter(std::filesystem::path path, std::filesystem::path part, route::RouteInfo info,
                  Existing existing);
  [[nodiscard]] Result<void> Begin();
  [[nodiscard]] Result<void> Write(std::span<const std::uint8_t> bytes);
  [[nodiscard]] Result<void> Close();
  [[nodiscard]] Result<void> TakeName();
  [[nodiscard]] tl::unexpected<Error> CannotWrite(int error) const;

  std::filesystem::path path_;
  std::filesystem::path part_;  // its name until it is whole; empty: there is none
  route::RouteInfo info_;
  Existing existing_;
  int descriptor_ = -1;
  std::uint32_t added_ = 0;
  std::uint64_t written_ = 0;
  route::Sha256Stream hash_;
};

}  // namespace trailcast::archive
