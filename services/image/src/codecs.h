#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/files.h"

namespace trailcast::image {

// The implementation of files.h, without writing JPEG (jpeg.cc). OpenCV's codecs bring two hundred
// libraries with them (GDAL, FFmpeg, GStreamer), 240 MB, which a driving robot has no use for. They
// are therefore in a library of their own beside the programs, which files.cc loads when the first
// file is read or written.
class Codecs {
 public:
  virtual ~Codecs() = default;
  [[nodiscard]] virtual Result<GrayImage> ReadGray(const std::filesystem::path& file) const = 0;
  [[nodiscard]] virtual Result<RgbImage> ReadRgb(const std::filesystem::path& file) const = 0;
  [[nodiscard]] virtual Result<RgbImage> DecodeRgb(std::span<const std::uint8_t> bytes,
                                                   const std::string& name) const = 0;
  [[nodiscard]] virtual Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes,
                                                     const std::string& name,
                                                     PictureRun& run) const = 0;
  [[nodiscard]] virtual Result<void> WritePng(const RgbImage& picture,
                                              const std::filesystem::path& file) const = 0;
  [[nodiscard]] virtual Result<void> WritePng(const GrayImage& picture,
                                              const std::filesystem::path& file) const = 0;
  [[nodiscard]] virtual Result<std::unique_ptr<FrameSequence>> OpenFrames(
      const std::filesystem::path& folder_or_video, int enough_px) const = 0;
};

inline constexpr const char* kCodecsLibrary = "libtrailcast_codecs.so";
inline constexpr const char* kCodecsSymbol = "trailcast_codecs";

}  // namespace trailcast::image

// The library exports its codecs under this name; they live as long as the process.
extern "C" const trailcast::image::Codecs* trailcast_codecs();
