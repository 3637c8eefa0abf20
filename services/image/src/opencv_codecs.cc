// This file is the library of codecs, made from OpenCV's.
#include "services/image/src/codecs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "services/image/src/picture_layout.h"

namespace trailcast::image {
namespace {

namespace fs = std::filesystem;

bool IsPicture(const fs::path& file) {
  static constexpr std::array kExtensions = {".png", ".jpg", ".jpeg", ".bmp", ".pgm",
                                             ".ppm", ".tif", ".tiff", ".webp"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

Result<std::vector<std::uint8_t>> ReadBytes(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    return Fail(ErrorCode::kNotFound, "no picture {}: the file does not exist", file.string());
  }
  if (!fs::is_regular_file(file, error)) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} is not a file; expected a picture (PNG, JPEG, ...)", file.string());
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return Fail(ErrorCode::kUnavailable, "cannot open the picture {}: check its permissions",
                file.string());
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return Fail(ErrorCode::kUnavailable, "{}: {}", file.string(), error.message());
  std::vector<std::uint8_t> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (stream.bad()) {
    return Fail(ErrorCode::kUnavailable, "cannot read the picture {}: does the disk work?",
                file.string());
  }
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

// No camera's picture has more, but a header of a few bytes can promise a thousand times as many.
constexpr std::uint64_t kMostPixels = 100'000'000;

Result<cv::Mat> DecodeBytes(const std::vector<std::uint8_t>& bytes, const PictureLayout& layout,
                            const std::string& name, int flags) {
  if (layout.pixels > kMostPixels) {
    return Fail(ErrorCode::kCorrupt,
                "the picture {} says that it has {} pixels; at most {} are read: make it smaller",
                name, layout.pixels, kMostPixels);
  }
  cv::Mat picture;
  // libjpeg fills a JPEG that is cut off up with grey and reports success.
  if (!bytes.empty() && !layout.cut_off) {
    try {
      picture = cv::imdecode(bytes, flags | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (const cv::Exception&) {
      picture.release();
    }
  }
  if (picture.empty()) {
    return Fail(ErrorCode::kCorrupt,
                "cannot decode the picture {} ({} bytes): it is truncated, damaged or no picture; "
                "expected PNG, JPEG or another format OpenCV reads",
                name, bytes.size());
  }
  return picture;
}

// CIPA DC-008 (Exif), section 4.6.5, tells which sides the first row and the first column are.
cv::Mat Turned(const cv::Mat& picture, int orientation) {
  cv::Mat turned = picture;
  if (orientation >= 5) cv::transpose(picture, turned);
  constexpr int kLeftAndRight = 1;
  constexpr int kUpAndDown = 0;
  if (orientation == 2 || orientation == 6) cv::flip(turned, turned, kLeftAndRight);
  if (orientation == 4 || orientation == 8) cv::flip(turned, turned, kUpAndDown);
  if (orientation == 3 || orientation == 7) cv::flip(turned, turned, kLeftAndRight - 2);
  return turned;
}

// Returns the flag that has libjpeg make fewer pixels of each of a picture's blocks.
int ReducedFlag(int times) {
  if (times == 2) return cv::IMREAD_REDUCED_GRAYSCALE_2;
  if (times == 4) return cv::IMREAD_REDUCED_GRAYSCALE_4;
  return times == 8 ? cv::IMREAD_REDUCED_GRAYSCALE_8 : 0;
}

// Pictures of 16 bits a pixel keep the bits that the run uses.
Result<cv::Mat> DecodeGrayBytes(const std::vector<std::uint8_t>& bytes, const std::string& name,
                                PictureRun& run) {
  const PictureLayout layout = ReadPictureLayout(bytes);
  const int reduced = ReducedFlag(run.Reduce(layout.longer_side_px));
  auto picture =
      DecodeBytes(bytes, layout, name, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH | reduced);
  if (picture && picture->depth() != CV_8U && picture->depth() != CV_16U) {
    picture = DecodeBytes(bytes, layout, name, cv::IMREAD_GRAYSCALE);
  }
  if (!picture) return picture;
  if (picture->depth() == CV_16U) {
    double brightest = 0.0;
    cv::minMaxLoc(*picture, nullptr, &brightest);
    const int bits = run.Bits(std::bit_width(static_cast<unsigned>(brightest)));
    const double scale = std::ldexp(1.0, 8 - bits);
    picture->convertTo(*picture, CV_8U, scale, 0.5 * scale - 0.5);  // rounds down
  }
  return Turned(*picture, run.Orientation(layout.orientation));
}

Result<cv::Mat> DecodeColor(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  const PictureLayout layout = ReadPictureLayout(bytes);
  return DecodeBytes(bytes, layout, name, cv::IMREAD_COLOR).map([&](const cv::Mat& picture) {
    return Turned(picture, layout.turn());
  });
}

template <typename Image>
Image FromMat(const cv::Mat& picture) {
  const cv::Mat packed = picture.isContinuous() ? picture : picture.clone();
  return {packed.cols, packed.rows, {packed.datastart, packed.dataend}};
}

RgbImage FromBgr(const cv::Mat& bgr) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return FromMat<RgbImage>(rgb);
}

Result<void> Write(const cv::Mat& picture, const fs::path& file) {
  if (picture.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "nothing to write to {}: the picture is empty",
                file.string());
  }
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", picture, bytes)) {
    return Fail(ErrorCode::kInternal, "cannot encode {} as PNG", file.string());
  }
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) {
    return Fail(ErrorCode::kUnavailable,
                "cannot write the picture {}: check that its folder exists, is writable and has "
                "{} bytes free",
                file.string(), bytes.size());
  }
  return {};
}

// OpenCV's headers want a mutable pointer even for reading.
template <typename Image>
cv::Mat View(const Image& picture, int type) {
  if (picture.empty()) return {};
  return {picture.height, picture.width, type, const_cast<std::uint8_t*>(picture.pixels.data())};
}

Result<GrayImage> ReadGrayOf(const fs::path& file, PictureRun& run) {
  return ReadBytes(file)
      .and_then([&](const std::vector<std::uint8_t>& bytes) {
        return DecodeGrayBytes(bytes, file.string(), run);
      })
      .map(FromMat<GrayImage>);
}

// Refuses any size but the first frame's. A frame that was decoded `reduced` times smaller counts
// as large as it was.
class SizeGuard {
 public:
  Result<GrayImage> Check(GrayImage frame, int reduced, const std::string& name) {
    const int width = reduced * frame.width;
    const int height = reduced * frame.height;
    if (width_ == 0) {
      width_ = width;
      height_ = height;
    }
    if (width != width_ || height != height_) {
      return Fail(
          ErrorCode::kInvalidArgument,
          "{} is {}x{} pixels, but the run's first frame is {}x{}: all frames of a run must "
          "be of one size",
          name, width, height, width_, height_);
    }
    return frame;
  }

 private:
  int width_ = 0;
  int height_ = 0;
};

class FolderSequence final : public FrameSequence {
 public:
  FolderSequence(std::vector<fs::path> files, int enough_px)
      : files_(std::move(files)), run_(enough_px) {}

  Result<std::optional<GrayImage>> Next() override {
    while (next_ < files_.size()) {
      const fs::path& file = files_[next_];
      ++next_;
      auto frame = ReadGrayOf(file, run_);
      if (frame) {
        left_out_.Read();
        return size_guard_.Check(std::move(*frame), run_.reduced(), file.string());
      }
      if (auto few = left_out_.LeaveOut(frame.error()); !few) return tl::unexpected(few.error());
    }
    return std::nullopt;
  }
  int number() const override { return static_cast<int>(next_) - 1; }
  std::vector<std::string> TakeNews() override {
    std::vector<std::string> news = run_.TakeNews();
    if (next_ == files_.size() && left_out_.count() > 0) {
      news.push_back(std::exchange(left_out_, {}).Text() + ": they are left out");
    }
    return news;
  }
  int reduced() const override { return run_.reduced(); }
  std::optional<int> size() const override { return static_cast<int>(files_.size()); }
  std::optional<double> rate_hz() const override { return std::nullopt; }

 private:
  std::vector<fs::path> files_;
  std::size_t next_ = 0;
  PictureRun run_;
  LeftOutPictures left_out_;
  SizeGuard size_guard_;
};

class VideoSequence final : public FrameSequence {
 public:
  VideoSequence(fs::path file, const cv::VideoCapture& video)
      : file_(std::move(file)), video_(video) {
    announced_frames_ = static_cast<int>(video_.get(cv::CAP_PROP_FRAME_COUNT));
  }

  Result<std::optional<GrayImage>> Next() override {
    cv::Mat frame;
    try {
      if (!video_.read(frame) || frame.empty()) return AtEnd();
    } catch (const cv::Exception& exception) {
      return Fail(ErrorCode::kCorrupt, "cannot decode frame {} of {}: {}", read_, file_.string(),
                  exception.err);
    }
    cv::Mat gray = frame;
    if (frame.channels() == 3) cv::cvtColor(frame, gray, cv::COLOR_BGR2GRAY);
    const std::string name = fmt::format("frame {} of {}", read_, file_.string());
    ++read_;
    return size_guard_.Check(FromMat<GrayImage>(gray), 1, name);
  }
  int number() const override { return read_ - 1; }
  std::vector<std::string> TakeNews() override { return {}; }
  int reduced() const override { return 1; }
  std::optional<int> size() const override {
    return announced_frames_ > 0 ? std::optional(announced_frames_) : std::nullopt;
  }
  std::optional<double> rate_hz() const override {
    const double rate = video_.get(cv::CAP_PROP_FPS);
    return rate > 0.0 ? std::optional(rate) : std::nullopt;
  }

 private:
  // Containers announce their length only roughly, so an end is early only when a tenth is missing.
  Result<std::optional<GrayImage>> AtEnd() const {
    if (read_ == 0 || read_ < announced_frames_ * 9 / 10) {
      return Fail(ErrorCode::kCorrupt,
                  "{} ends after {} of {} frames: the video is truncated or damaged",
                  file_.string(), read_, announced_frames_);
    }
    return std::nullopt;
  }

  fs::path file_;
  cv::VideoCapture video_;
  int announced_frames_ = 0;
  int read_ = 0;
  SizeGuard size_guard_;
};

// Compares in natural order: f2 comes before f10, although "f10" is less than "f2" letter by
// letter.
bool ComesBefore(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto number_at = [&](const std::string& name, std::size_t from) {
    std::size_t end = from;
    while (end < name.size() && is_digit(name[end])) ++end;
    const std::size_t first = std::min(name.find_first_not_of('0', from), end);
    return name.substr(first, end - first);
  };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string number_a = number_at(a, i);
      const std::string number_b = number_at(b, j);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
      while (i < a.size() && is_digit(a[i])) ++i;
      while (j < b.size() && is_digit(b[j])) ++j;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;
}

Result<std::unique_ptr<FrameSequence>> OpenFolder(const fs::path& folder, int enough_px) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    // macOS keeps its notes on a file in another file beside it, named "._" and the file's name.
    const bool hidden = entry->path().filename().string().front() == '.';
    std::error_code unknown;
    const bool other = entry->exists(unknown) && !entry->is_regular_file(unknown);
    if (IsPicture(entry->path()) && !hidden && !other) files.push_back(entry->path());
  }
  if (error) {
    return Fail(ErrorCode::kUnavailable, "cannot list the folder {}: {}", folder.string(),
                error.message());
  }
  if (files.empty()) {
    return Fail(ErrorCode::kNotFound,
                "the folder {} has no pictures: expected files ending in .png, .jpg, .bmp, .pgm, "
                ".ppm, .tif or .webp",
                folder.string());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return ComesBefore(a.filename().string(), b.filename().string());
  });
  return std::make_unique<FolderSequence>(std::move(files), enough_px);
}

Result<std::unique_ptr<FrameSequence>> OpenVideo(const fs::path& file) {
  cv::VideoCapture video;
  try {
    // The backends are named because OpenCV would otherwise also ask for cameras, and GStreamer for
    // devices.
    const std::string name = file.string();
    if (!video.open(name, cv::CAP_FFMPEG)) video.open(name, cv::CAP_OPENCV_MJPEG);
  } catch (const cv::Exception&) {
    video.release();
  }
  if (!video.isOpened()) {
    return Fail(ErrorCode::kCorrupt,
                "cannot open {} as a video: expected a folder of pictures or a video that OpenCV "
                "decodes (AVI, MP4, ...)",
                file.string());
  }
  return std::make_unique<VideoSequence>(file, video);
}

class OpenCvCodecs final : public Codecs {
 public:
  [[nodiscard]] Result<GrayImage> ReadGray(const fs::path& file) const override {
    PictureRun alone;
    return ReadGrayOf(file, alone);
  }
  [[nodiscard]] Result<RgbImage> ReadRgb(const fs::path& file) const override {
    return ReadBytes(file)
        .and_then([&](const std::vector<std::uint8_t>& bytes) {
          return DecodeColor(bytes, file.string());
        })
        .map(FromBgr);
  }
  [[nodiscard]] Result<RgbImage> DecodeRgb(std::span<const std::uint8_t> bytes,
                                           const std::string& name) const override {
    return DecodeColor({bytes.begin(), bytes.end()}, name).map(FromBgr);
  }
  [[nodiscard]] Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes,
                                             const std::string& name,
                                             PictureRun& run) const override {
    return DecodeGrayBytes({bytes.begin(), bytes.end()}, name, run).map(FromMat<GrayImage>);
  }
  [[nodiscard]] Result<void> WritePng(const RgbImage& picture,
                                      const fs::path& file) const override {
    cv::Mat bgr;
    if (!picture.empty()) cv::cvtColor(View(picture, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
    return Write(bgr, file);
  }
  [[nodiscard]] Result<void> WritePng(const GrayImage& picture,
                                      const fs::path& file) const override {
    return Write(View(picture, CV_8UC1), file);
  }
  [[nodiscard]] Result<std::unique_ptr<FrameSequence>> OpenFrames(const fs::path& folder_or_video,
                                                                  int enough_px) const override {
    std::error_code error;
    if (!fs::exists(folder_or_video, error)) {
      return Fail(ErrorCode::kNotFound,
                  "no recorded run at {}: expected a folder of pictures or a video file",
                  folder_or_video.string());
    }
    if (fs::is_directory(folder_or_video, error)) return OpenFolder(folder_or_video, enough_px);
    if (IsPicture(folder_or_video)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "{} is a single picture; give the folder it is in, or a video file",
                  folder_or_video.string());
    }
    return OpenVideo(folder_or_video);
  }
};

}  // namespace
}  // namespace trailcast::image

const trailcast::image::Codecs* trailcast_codecs() {
  static const trailcast::image::OpenCvCodecs codecs;
  return &codecs;
}
