#include "services/bag/compression.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <memory>

namespace trailcast::bag {
namespace {

constexpr std::array kNames{"", "lz4", "zstd"};
constexpr std::size_t kStep = std::size_t{1} << 20U;

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};
struct FreeZstd {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

// How far a decompressor came with its input and its output.
struct Progress {
  std::size_t read = 0;
  std::size_t written = 0;
  bool failed = false;
  bool at_end = false;  // of a frame
};

class Lz4Stream {
 public:
  Progress Step(std::span<const std::uint8_t> from, std::span<std::uint8_t> to) {
    Progress progress{from.size(), to.size(), false, false};
    const std::size_t hint = LZ4F_decompress(context_.get(), to.data(), &progress.written,
                                             from.data(), &progress.read, nullptr);
    progress.failed = LZ4F_isError(hint) != 0;
    progress.at_end = hint == 0;
    return progress;
  }

 private:
  static LZ4F_dctx* Make() {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) {
      throw std::bad_alloc();
    }
    return context;
  }
  std::unique_ptr<LZ4F_dctx, FreeLz4> context_{Make()};
};

class ZstdStream {
 public:
  Progress Step(std::span<const std::uint8_t> from, std::span<std::uint8_t> to) {
    ZSTD_inBuffer in{from.data(), from.size(), 0};
    ZSTD_outBuffer out{to.data(), to.size(), 0};
    const std::size_t hint = ZSTD_decompressStream(context_.get(), &out, &in);
    return {in.pos, out.pos, ZSTD_isError(hint) != 0, hint == 0};
  }

 private:
  static ZSTD_DCtx* Make() {
    ZSTD_DCtx* context = ZSTD_createDCtx();
    if (context == nullptr) throw std::bad_alloc();
    return context;
  }
  std::unique_ptr<ZSTD_DCtx, FreeZstd> context_{Make()};
};

template <typename Stream>
Decompressed Run(std::span<const std::uint8_t> from, std::uint64_t most_bytes) {
  Stream stream;
  Decompressed result;
  std::size_t size = 0;
  while (true) {
    // The room has one byte more than is allowed, so that an excess shows.
    const std::uint64_t room = std::min<std::uint64_t>(kStep, most_bytes + 1 - size);
    result.bytes.resize(size + static_cast<std::size_t>(room));
    const Progress step = stream.Step(from, std::span(result.bytes).subspan(size));
    if (!step.failed) size += step.written;
    from = from.subspan(step.failed ? 0 : step.read);
    const bool stands = step.read == 0 && step.written == 0;
    const bool ended = step.at_end && from.empty();
    if (step.failed || stands || ended || size > most_bytes) {
      result.whole = ended && size <= most_bytes;
      result.bytes.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size, most_bytes)));
      return result;
    }
  }
}

}  // namespace

const char* NameOf(Compression compression) {
  return kNames.at(static_cast<std::size_t>(compression));
}

std::optional<Compression> FindCompression(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames.at(i)) return static_cast<Compression>(i);
  }
  return std::nullopt;
}

Bytes Compress(Compression compression, std::span<const std::uint8_t> bytes) {
  Bytes result;
  std::size_t size = bytes.size();
  switch (compression) {
    case Compression::kNone:
      return {bytes.begin(), bytes.end()};
    case Compression::kLz4:
      result.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
      size = LZ4F_compressFrame(result.data(), result.size(), bytes.data(), bytes.size(), nullptr);
      break;
    case Compression::kZstd:
      result.resize(ZSTD_compressBound(bytes.size()));
      size = ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), 1);
      break;
  }
  result.resize(std::min(size, result.size()));
  return result;
}

Decompressed Decompress(Compression compression, std::span<const std::uint8_t> bytes,
                        std::uint64_t most_bytes) {
  if (compression == Compression::kLz4) return Run<Lz4Stream>(bytes, most_bytes);
  if (compression == Compression::kZstd) return Run<ZstdStream>(bytes, most_bytes);
  const std::uint64_t size = std::min<std::uint64_t>(bytes.size(), most_bytes);
  const auto part = bytes.first(static_cast<std::size_t>(size));
  return {{part.begin(), part.end()}, size == bytes.size()};
}

bool IsZstd(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 4> kMagic{0x28, 0xB5, 0x2F, 0xFD};
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

Result<bool> DecompressZstdFile(const std::filesystem::path& from,
                                const std::filesystem::path& to) {
  constexpr std::uint64_t kMostTimes = 1000;  // pictures never shrink that much
  std::error_code unknown;
  const std::uint64_t most = 16 * kStep + kMostTimes * std::filesystem::file_size(from, unknown);
  std::ifstream in(from, std::ios::binary);
  std::ofstream out(to, std::ios::binary | std::ios::trunc);
  ZstdStream stream;
  Bytes packed(kStep);
  Bytes unpacked(kStep);
  std::uint64_t size = 0;
  Progress step;
  while (in && !step.failed) {
    in.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
    std::span<const std::uint8_t> left(packed.data(), static_cast<std::size_t>(in.gcount()));
    if (left.empty()) break;
    do {
      step = stream.Step(left, unpacked);
      if (step.failed) break;
      left = left.subspan(step.read);
      size += step.written;
      out.write(reinterpret_cast<const char*>(unpacked.data()),
                static_cast<std::streamsize>(step.written));
      if (!out || size > most) break;
    } while (!left.empty() || (step.written == unpacked.size() && !step.at_end));
    if (!out || size > most) break;
  }
  out.close();
  if (!out || in.bad()) {
    return Fail(ErrorCode::kUnavailable,
                "{} cannot be unpacked into {}: is there room? (TMPDIR names another folder)",
                from.string(), to.parent_path().string());
  }
  if (size > most) {
    return Fail(ErrorCode::kCorrupt, "{} would unpack to more than {} times its size",
                from.string(), kMostTimes);
  }
  return step.at_end && !step.failed;
}

}  // namespace trailcast::bag
