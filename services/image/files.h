#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/image.h"
#include "services/image/picture_run.h"

namespace trailcast::image {

// Reads any still picture OpenCV knows (PNG, JPEG, ...), turned as a JPEG's Exif says. Errors name
// the file and what is wrong.
[[nodiscard]] Result<GrayImage> ReadGray(const std::filesystem::path& file);
[[nodiscard]] Result<RgbImage> ReadRgb(const std::filesystem::path& file);
// Whether this installation has what decodes pictures; the error says what is missing.
[[nodiscard]] Result<void> CanDecode();
// Decodes an encoded picture held in memory; `name` stands for the file in errors.
[[nodiscard]] Result<RgbImage> DecodeRgb(std::span<const std::uint8_t> bytes,
                                         const std::string& name);
[[nodiscard]] Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes,
                                           const std::string& name);
// The next one of a run, as the run's pictures are turned and their 16 bits used.
[[nodiscard]] Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes,
                                           const std::string& name, PictureRun& run);
// `quality` is 1 to 100. Every installation can; kInvalidArgument for a picture without pixels.
[[nodiscard]] Result<std::vector<std::uint8_t>> EncodeJpeg(const GrayImage& picture, int quality);
[[nodiscard]] Result<std::vector<std::uint8_t>> EncodeJpeg(const RgbImage& picture, int quality);
[[nodiscard]] Result<void> WritePng(const RgbImage& picture, const std::filesystem::path& file);
[[nodiscard]] Result<void> WritePng(const GrayImage& picture, const std::filesystem::path& file);

// The frames of a recorded run, in order: a folder of pictures (by name, f2 before f10; hidden
// files are none) or a video file.
class FrameSequence {
 public:
  [[nodiscard]] static Result<std::unique_ptr<FrameSequence>> Open(
      const std::filesystem::path& folder_or_video);
  virtual ~FrameSequence() = default;

  // The next frame, or nothing at the end. Pictures that cannot be read are left out; too many of
  // them (LeftOutPictures), or a frame whose size differs from the first one's, are an error that
  // names it.
  [[nodiscard]] virtual Result<std::optional<GrayImage>> Next() = 0;
  // Of the frame that Next gave last, from 0: those that were left out count.
  [[nodiscard]] virtual int number() const = 0;
  // Lines for people, once each: what was left out, or found out of the pictures.
  [[nodiscard]] virtual std::vector<std::string> TakeNews() = 0;
  // Number of frames, if it is known beforehand.
  [[nodiscard]] virtual std::optional<int> size() const = 0;
  // Frames a second if the recording says so (videos), otherwise nothing.
  [[nodiscard]] virtual std::optional<double> rate_hz() const = 0;
};

}  // namespace trailcast::image
