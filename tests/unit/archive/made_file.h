#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "services/archive/route_file.h"
#include "services/archive/src/layout.h"
#include "services/route/digest.h"
#include "services/route/info_codec.h"
#include "tests/support/taught_route.h"

namespace trailcast::archive {

[[nodiscard]] inline route::Bytes ReadFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void WriteFile(const std::filesystem::path& file, const route::Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<long>(bytes.size()));
}

// This is a route file made field by field, as an attacker would: sizes and checksum are right
// whatever the fields say.
struct MadeFile {
  struct Frame {
    std::uint32_t index = 0;
    std::uint32_t size = 0;
    route::Digest digest{};
    route::Bytes bytes;
  };
  std::uint32_t version = kFileVersion;
  route::Bytes description;
  std::vector<Frame> frames;
  route::Bytes rest;  // after the last segment

  static MadeFile Of(const test::TaughtRoute& taught) {
    MadeFile made;
    made.description = route::EncodeInfo(taught.info);
    for (const route::SegmentPiece& piece : taught.pieces) {
      made.frames.push_back({piece.index.value(), static_cast<std::uint32_t>(piece.bytes.size()),
                             piece.digest, piece.bytes});
    }
    return made;
  }

  [[nodiscard]] route::Bytes Bytes() const {
    route::Bytes body;
    for (const Frame& frame : frames) {
      AppendNumber(body, frame.index, 4);
      AppendNumber(body, frame.size, 4);
      body.insert(body.end(), frame.digest.begin(), frame.digest.end());
      body.insert(body.end(), frame.bytes.begin(), frame.bytes.end());
    }
    body.insert(body.end(), rest.begin(), rest.end());
    route::Bytes bytes(kMagic.begin(), kMagic.end());
    AppendNumber(bytes, version, 4);
    AppendNumber(bytes, description.size(), 4);
    AppendNumber(bytes, kPreambleBytes + description.size() + body.size() + kChecksumBytes, 8);
    bytes.insert(bytes.end(), description.begin(), description.end());
    bytes.insert(bytes.end(), body.begin(), body.end());
    const route::Digest checksum = route::Sha256(bytes);
    bytes.insert(bytes.end(), checksum.begin(), checksum.end());
    return bytes;
  }
};

}  // namespace trailcast::archive
