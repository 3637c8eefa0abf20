// This file writes JPEG with libjpeg itself, because robots have that library but not OpenCV's
// codecs (codecs.h).
#include <cstddef>
#include <cstdio>
// jpeglib.h needs these headers before it.
#include <jpeglib.h>

#include <csetjmp>
#include <cstdlib>
#include <utility>

#include "services/image/files.h"

namespace trailcast::image {
namespace {

struct Errors {
  jpeg_error_mgr manager;  // must come first, because libjpeg sees only this member
  std::jmp_buf back;
};

// libjpeg would end the process here.
[[noreturn]] void GoBack(j_common_ptr info) {
  std::longjmp(reinterpret_cast<Errors*>(info->err)->back, 1);
}

struct Encoded {
  unsigned char* bytes = nullptr;  // allocated by malloc
  unsigned long size = 0;
};

// This function must hold nothing that has a destructor, because errors jump out of it.
bool Encode(const std::uint8_t* pixels, int width, int height, int channels, int quality,
            Encoded& encoded) {
  jpeg_compress_struct info;
  Errors errors;
  info.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = GoBack;
  errors.manager.output_message = [](j_common_ptr) {};
  if (setjmp(errors.back) != 0) {
    jpeg_destroy_compress(&info);
    return false;
  }
  jpeg_create_compress(&info);
  jpeg_mem_dest(&info, &encoded.bytes, &encoded.size);
  info.image_width = static_cast<JDIMENSION>(width);
  info.image_height = static_cast<JDIMENSION>(height);
  info.input_components = channels;
  info.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  info.optimize_coding = TRUE;
  jpeg_start_compress(&info, TRUE);
  const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  while (info.next_scanline < info.image_height) {
    // libjpeg takes a mutable pointer but does not write to it.
    auto* line = const_cast<JSAMPROW>(pixels + info.next_scanline * row);
    jpeg_write_scanlines(&info, &line, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  return true;
}

template <typename Image>
Result<std::vector<std::uint8_t>> EncodePicture(const Image& picture, int channels, int quality) {
  Encoded encoded;
  const bool made = !picture.empty() && Encode(picture.pixels.data(), picture.width, picture.height,
                                               channels, quality, encoded);
  std::vector<std::uint8_t> bytes;
  if (made) bytes.assign(encoded.bytes, encoded.bytes + encoded.size);
  std::free(encoded.bytes);
  if (!made) {
    return Fail(ErrorCode::kInvalidArgument, "a picture of {}x{} pixels cannot be made JPEG",
                picture.width, picture.height);
  }
  return bytes;
}

}  // namespace

Result<std::vector<std::uint8_t>> EncodeJpeg(const GrayImage& picture, int quality) {
  return EncodePicture(picture, 1, quality);
}

Result<std::vector<std::uint8_t>> EncodeJpeg(const RgbImage& picture, int quality) {
  return EncodePicture(picture, 3, quality);
}

}  // namespace trailcast::image
