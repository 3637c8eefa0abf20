#include "services/image/raw_picture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

namespace trailcast::image {
namespace {

constexpr int kAsItIs = -1;
constexpr int kOf16Bits = -2;  // the bits that the run uses

struct Encoding {
  std::string_view name;
  int type;     // OpenCV's
  int to_gray;  // OpenCV's conversion, or one of the above
};

// OpenCV names Bayer patterns by the second row's second and third pixel; ROS names them by the
// first row.
constexpr std::array kEncodings{
    Encoding{"mono8", CV_8UC1, kAsItIs},
    Encoding{"8UC1", CV_8UC1, kAsItIs},
    Encoding{"mono16", CV_8UC2, kOf16Bits},
    Encoding{"16UC1", CV_8UC2, kOf16Bits},
    Encoding{"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
    Encoding{"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
    Encoding{"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
    Encoding{"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
    Encoding{"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
    Encoding{"8UC4", CV_8UC4, cv::COLOR_BGRA2GRAY},
    Encoding{"yuv422", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
    Encoding{"uyvy", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
    Encoding{"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
    Encoding{"yuyv", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
    Encoding{"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2GRAY},
    Encoding{"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2GRAY},
    Encoding{"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2GRAY},
    Encoding{"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2GRAY},
};

std::string Known() {
  std::vector<std::string_view> names;
  names.reserve(kEncodings.size());
  for (const Encoding& encoding : kEncodings) names.push_back(encoding.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Result<void> CheckSize(const RawPicture& picture, std::size_t pixel_bytes) {
  constexpr std::uint32_t kMostSide_px = 65535;
  if (picture.width_px == 0 || picture.height_px == 0 || picture.width_px > kMostSide_px ||
      picture.height_px > kMostSide_px) {
    return Fail(ErrorCode::kInvalidArgument, "a picture of {}x{} pixels: expected 1 to {} a side",
                picture.width_px, picture.height_px, kMostSide_px);
  }
  const std::size_t row = picture.width_px * pixel_bytes;
  const std::size_t needed = std::size_t{picture.height_px - 1} * picture.step + row;
  if (picture.step < row || picture.bytes.size() < needed) {
    return Fail(ErrorCode::kCorrupt,
                "a picture of {}x{} pixels in {} with {} bytes, {} to a row: expected at least {}, "
                "{} to a row",
                picture.width_px, picture.height_px, picture.encoding, picture.bytes.size(),
                picture.step, picture.height_px * row, row);
  }
  return {};
}

GrayImage Of16Bits(const RawPicture& picture, PictureRun& run) {
  const std::size_t width = picture.width_px;
  const std::size_t low = picture.big_endian ? 1 : 0;
  std::vector<std::uint16_t> numbers;
  numbers.reserve(width * picture.height_px);
  unsigned all = 0;
  for (std::size_t y = 0; y < picture.height_px; ++y) {
    const auto row = picture.bytes.subspan(y * picture.step, 2 * width);
    for (std::size_t x = 0; x < 2 * width; x += 2) {
      numbers.push_back(static_cast<std::uint16_t>(row[x + low] | row[x + 1 - low] << 8U));
      all |= numbers.back();
    }
  }
  const int dropped = run.Bits(std::bit_width(all)) - 8;
  GrayImage gray{static_cast<int>(width), static_cast<int>(picture.height_px), {}};
  gray.pixels.resize(numbers.size());
  std::transform(
      numbers.begin(), numbers.end(), gray.pixels.begin(),
      [dropped](std::uint16_t number) { return static_cast<std::uint8_t>(number >> dropped); });
  return gray;
}

}  // namespace

Result<GrayImage> GrayFromRaw(const RawPicture& picture, PictureRun& run) {
  const auto* encoding =
      std::find_if(kEncodings.begin(), kEncodings.end(),
                   [&](const Encoding& one) { return one.name == picture.encoding; });
  if (encoding == kEncodings.end()) {
    return Fail(ErrorCode::kInvalidArgument,
                "the camera's encoding '{}' is not understood: expected one of {}",
                picture.encoding, Known());
  }
  if (auto fits = CheckSize(picture, static_cast<std::size_t>(CV_ELEM_SIZE(encoding->type)));
      !fits) {
    return tl::unexpected(fits.error());
  }
  if (encoding->to_gray == kOf16Bits) return Of16Bits(picture, run);
  // OpenCV's headers want a mutable pointer even for reading.
  const cv::Mat raw(static_cast<int>(picture.height_px), static_cast<int>(picture.width_px),
                    encoding->type, const_cast<std::uint8_t*>(picture.bytes.data()), picture.step);
  cv::Mat gray;
  try {
    if (encoding->to_gray == kAsItIs) {
      gray = raw.clone();
    } else {
      cv::cvtColor(raw, gray, encoding->to_gray);
    }
  } catch (const cv::Exception& exception) {
    return Fail(ErrorCode::kInvalidArgument,
                "a picture of {}x{} pixels in {} cannot be made grey: "
                "{}",
                picture.width_px, picture.height_px, picture.encoding, exception.err);
  }
  return GrayImage{gray.cols, gray.rows, {gray.datastart, gray.dataend}};
}

}  // namespace trailcast::image
