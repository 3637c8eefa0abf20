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

// Reads any still picture that OpenCV knows (PNG, JPEG, ...), turned as a JPEG's Exif says. Errors
// name the file and say what is wrong.
[[nodiscard]] Result<GrayImage> ReadGray(const std::filesystem::path& file);
[[nodiscard]] Result<RgbImage> ReadRgb(const std::filesystem::path& file);
// Checks that this installation can decode pictures; the error says what is missing.
[[nodiscard]] Result<void> CanDecode();
// Decodes an encoded picture in memory. Errors name it as `name`.
[[nodiscard]] Result<RgbImage> DecodeRgb(std::span<const std::uint8_t> bytes,
                                         const std::string& name);
[[nodiscard]] Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes,
                                           const std::string& name);
// Decodes the next picture of a run, turned and reduced as the run's pictures are, with the bits
// that they use of 16.
[[nodiscard]] Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes,
                                           const std::string& name, PictureRun& run);
// Encodes with a `quality` of 1 to 100. Every installation can do this. A picture without pixels is
// kInvalidArgument.
[[nodiscard]] Result<std::vector<std::uint8_t>> EncodeJpeg(const GrayImage& picture, int quality);
[[nodiscard]] Result<std::vector<std::uint8_t>> EncodeJpeg(const RgbImage& picture, int quality);
[[nodiscard]] Result<void> WritePng(const RgbImage& picture, const std::filesystem::path& file);
[[nodiscard]] Result<void> WritePng(const GrayImage& picture, const std::filesystem::path& file);

// The frames of a recorded run, in order. The run is a folder of pictures (by name, f2 before f10,
// without hidden files, folders and devices) or a video file.
class FrameSequence {
 public:
  // `enough_px` is PictureRun's, for a folder's pictures. Videos are not reduced.
  [[nodiscard]] static Result<std::unique_ptr<FrameSequence>> Open(
      const std::filesystem::path& folder_or_video, int enough_px = 0);
  virtual ~FrameSequence() = default;

  // Returns the next frame, or nothing at the end. It leaves out pictures that cannot be read. Too
  // many of these (LeftOutPictures), or a frame whose size differs from the first one's, are an
  // error that names it.
  [[nodiscard]] virtual Result<std::optional<GrayImage>> Next() = 0;
  // Returns the number, from 0, of the frame that Next gave last. Frames that were left out count.
  [[nodiscard]] virtual int number() const = 0;
  // Returns lines for people, each once: which pictures were left out, and what the pictures told
  // about themselves.
  [[nodiscard]] virtual std::vector<std::string> TakeNews() = 0;
  // Returns how many times the width and height of the frame that Next gave last the camera's
  // picture has.
  [[nodiscard]] virtual int reduced() const = 0;
  // Returns the number of frames if it is known beforehand.
  [[nodiscard]] virtual std::optional<int> size() const = 0;
  // Returns the frames a second if the recording says so, as videos do.
  [[nodiscard]] virtual std::optional<double> rate_hz() const = 0;
};

}  // namespace trailcast::image
