#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "services/base/result.h"
#include "services/route/digest.h"
#include "services/route/route.h"

namespace trailcast::archive {

// Writes a complete route as one file. It writes to another name beside the file until every byte
// is on the disk and was read back, so that there is a whole file or none. Equal routes give equal
// files.
class RouteFileWriter {
 public:
  enum class Existing : std::uint8_t { kKeep, kReplace };

  // Errors: kInvalidArgument for a route that is not complete or out of bounds; kConflict if `path`
  // exists and must be kept, or is no file; kUnavailable if its folder cannot be written.
  [[nodiscard]] static Result<RouteFileWriter> Create(std::filesystem::path path,
                                                      const route::RouteInfo& info,
                                                      Existing existing);
  // Without Finish, nothing is left behind.
  ~RouteFileWriter();
  RouteFileWriter(RouteFileWriter&& other) noexcept;
  RouteFileWriter& operator=(RouteFileWriter&&) = delete;
  RouteFileWriter(const RouteFileWriter&) = delete;
  RouteFileWriter& operator=(const RouteFileWriter&) = delete;

  // Adds the next segment in order of index; any other is kInvalidArgument. Bytes that do not match
  // their digest are kCorrupt; a full disk is kUnavailable.
  [[nodiscard]] Result<void> Add(const route::SegmentPiece& piece);
  // Completes the file once all segments were added, and returns its size. The file is on the disk
  // under its name when this returns. Segments that do not make up the route are kCorrupt.
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
  std::filesystem::path part_;  // its name until it is whole; empty if there is no such file
  route::RouteInfo info_;
  Existing existing_;
  int descriptor_ = -1;
  std::uint32_t added_ = 0;
  std::uint64_t written_ = 0;
  route::Sha256Stream hash_;
};

}  // namespace trailcast::archive
