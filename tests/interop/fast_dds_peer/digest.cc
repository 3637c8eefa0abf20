#include "digest.h"

#include <openssl/sha.h>

namespace peer {

Digest Sha256(const std::vector<std::uint8_t>& bytes) {
  Digest digest{};
  SHA256(bytes.data(), bytes.size(), digest.data());
  return digest;
}

Digest Manifest(const std::vector<Digest>& digests) {
  std::vector<std::uint8_t> bytes;
  for (const Digest& digest : digests) bytes.insert(bytes.end(), digest.begin(), digest.end());
  return Sha256(bytes);
}

std::string Hex(const Digest& digest) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

}  // namespace peer
