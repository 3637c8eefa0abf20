#include "services/image/files.h"

#include "services/base/module.h"
#include "services/image/src/codecs.h"

namespace trailcast::image {
namespace {

namespace fs = std::filesystem;

Result<const Codecs*> Load() {
  const auto symbol = FindInModule(kCodecsLibrary, kCodecsSymbol);
  if (!symbol) {
    return Fail(ErrorCode::kUnavailable,
                "this installation reads and writes no compressed pictures or videos, which robots "
                "with uncompressed ones do not need: {}; the library lies beside the programs that "
                "'./run build' makes, in the package trailcast-tools and in the image 'tools'",
                symbol.error().message);
  }
  return reinterpret_cast<decltype(&trailcast_codecs)>(*symbol)();
}

// The library is loaded once and stays until the process ends.
const Result<const Codecs*>& Loaded() {
  static const Result<const Codecs*> codecs = Load();
  return codecs;
}

}  // namespace

Result<void> CanDecode() {
  if (!Loaded()) return tl::unexpected(Loaded().error());
  return {};
}

Result<GrayImage> ReadGray(const fs::path& file) {
  return Loaded().and_then([&](const Codecs* codecs) { return codecs->ReadGray(file); });
}

Result<RgbImage> ReadRgb(const fs::path& file) {
  return Loaded().and_then([&](const Codecs* codecs) { return codecs->ReadRgb(file); });
}

Result<RgbImage> DecodeRgb(std::span<const std::uint8_t> bytes, const std::string& name) {
  return Loaded().and_then([&](const Codecs* codecs) { return codecs->DecodeRgb(bytes, name); });
}

Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes, const std::string& name) {
  PictureRun alone;
  return DecodeGray(bytes, name, alone);
}

Result<GrayImage> DecodeGray(std::span<const std::uint8_t> bytes, const std::string& name,
                             PictureRun& run) {
  return Loaded().and_then(
      [&](const Codecs* codecs) { return codecs->DecodeGray(bytes, name, run); });
}

Result<void> WritePng(const RgbImage& picture, const fs::path& file) {
  return Loaded().and_then([&](const Codecs* codecs) { return codecs->WritePng(picture, file); });
}

Result<void> WritePng(const GrayImage& picture, const fs::path& file) {
  return Loaded().and_then([&](const Codecs* codecs) { return codecs->WritePng(picture, file); });
}

Result<std::unique_ptr<FrameSequence>> FrameSequence::Open(const fs::path& folder_or_video,
                                                           int enough_px) {
  return Loaded().and_then(
      [&](const Codecs* codecs) { return codecs->OpenFrames(folder_or_video, enough_px); });
}

}  // namespace trailcast::image
