#include "services/route/digest.h"

#include <openssl/evp.h>

#include <array>
#include <new>

#include "services/base/hex.h"
#include "services/route/codec.h"
#include "services/route/labels.h"

namespace trailcast::route {
namespace {

// OpenSSL takes as long to look this up as to hash a short text, so it is looked up once.
const EVP_MD* Algorithm() {
  static const EVP_MD* const found = EVP_MD_fetch(nullptr, "SHA256", nullptr);
  return found;
}

}  // namespace

struct Sha256Stream::State {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(),
                                                                  &EVP_MD_CTX_free};
};

// OpenSSL refuses only when it cannot allocate.
Sha256Stream::Sha256Stream() : state_(std::make_unique<State>()) {
  if (!state_->context || EVP_DigestInit_ex(state_->context.get(), Algorithm(), nullptr) != 1) {
    throw std::bad_alloc();
  }
}

Sha256Stream::~Sha256Stream() = default;
Sha256Stream::Sha256Stream(Sha256Stream&&) noexcept = default;
Sha256Stream& Sha256Stream::operator=(Sha256Stream&&) noexcept = default;

void Sha256Stream::Add(std::span<const std::uint8_t> bytes) {
  if (EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()) != 1) {
    throw std::bad_alloc();
  }
}

Digest Sha256Stream::Finish() {
  Digest digest{};
  if (EVP_DigestFinal_ex(state_->context.get(), digest.data(), nullptr) != 1) {
    throw std::bad_alloc();
  }
  return digest;
}

Digest Sha256(std::span<const std::uint8_t> bytes) {
  Digest digest{};
  unsigned int length = 0;
  // OpenSSL refuses only when it cannot allocate, as above.
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, Algorithm(), nullptr) != 1 ||
      length != digest.size()) {
    throw std::bad_alloc();
  }
  return digest;
}

Digest ManifestDigest(std::span<const Digest> digests) {
  static_assert(sizeof(Digest) == std::tuple_size_v<Digest>, "digests lie one after the other");
  return Sha256({reinterpret_cast<const std::uint8_t*>(digests.data()), digests.size_bytes()});
}

Digest ChainDigest(const Digest& before, const Digest& next) {
  return ManifestDigest(std::array{before, next});
}

SegmentPiece MakePiece(const RouteKey& key, const Segment& segment) {
  SegmentPiece piece{key, segment.index, {}, Encode(segment)};
  piece.digest = Sha256(piece.bytes);
  return piece;
}

Result<void> CheckDigest(const SegmentPiece& piece) {
  const Digest actual = Sha256(piece.bytes);
  if (actual == piece.digest) return {};
  return Fail(ErrorCode::kCorrupt,
              "segment {} of {}: its {} bytes have digest {:.12}.., expected {:.12}..; fetch it "
              "again",
              piece.index.value(), Describe(piece.key), piece.bytes.size(), ToHex(actual),
              ToHex(piece.digest));
}

Result<Segment> Open(const SegmentPiece& piece) {
  if (Result<void> whole = CheckDigest(piece); !whole) return tl::unexpected(whole.error());
  const std::string which =
      fmt::format("segment {} of {}", piece.index.value(), Describe(piece.key));
  Result<Segment> segment = Decode(piece.bytes);
  if (!segment) return Wrap(segment.error(), which);
  if (segment->index != piece.index) {
    return Fail(ErrorCode::kCorrupt, "{}: its bytes are of segment {}", which,
                segment->index.value());
  }
  return segment;
}

}  // namespace trailcast::route
