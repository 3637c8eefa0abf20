#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "services/image/files.h"
#include "services/lab/trial/recording/src/other_camera.h"

namespace trailcast::test {

// Writes a whole run, a folder of pictures, as another camera would have recorded it, into another
// folder, which it makes. Throws std::runtime_error if a picture cannot be read or written.
inline void RecordThrough(const trial::OtherCamera& camera, const std::filesystem::path& frames,
                          const std::filesystem::path& into) {
  std::filesystem::create_directories(into);
  auto sequence = image::FrameSequence::Open(frames);
  if (!sequence) throw std::runtime_error(sequence.error().message);
  for (int number = 0;; ++number) {
    auto frame = (*sequence)->Next();
    if (!frame) throw std::runtime_error(frame.error().message);
    if (!*frame) return;
    const auto written =
        image::WritePng(trial::Through(camera, **frame), into / fmt::format("{:06}.png", number));
    if (!written) throw std::runtime_error(written.error().message);
  }
}

}  // namespace trailcast::test
