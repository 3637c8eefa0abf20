#include "services/users/secret.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "services/base/hex.h"

namespace trailcast::users {
namespace {

using Bytes32 = std::array<unsigned char, 32>;

// These follow OWASP's cheat sheet on password storage, for 32 MB.
constexpr std::uint64_t kCost = 32768;
constexpr std::uint64_t kBlock = 8;
constexpr std::uint64_t kParallel = 3;
constexpr std::uint64_t kMostMemory = 64U << 20U;
constexpr std::string_view kScrypt = "scrypt:32768:8:3:";
constexpr std::string_view kSha256 = "sha256:";
constexpr std::size_t kSaltDigits = 32;
constexpr std::size_t kHashDigits = 64;

template <std::size_t kSize>
std::array<unsigned char, kSize> Draw() {
  std::array<unsigned char, kSize> bytes{};
  if (RAND_bytes(bytes.data(), kSize) != 1) throw std::runtime_error("no random numbers");
  return bytes;
}

Bytes32 Sha256(std::string_view text) {
  Bytes32 digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("OpenSSL has no SHA-256");
  }
  return digest;
}

// Returns the hash for the salt, or an empty text if OpenSSL lacks the memory.
std::string Scrypt(const std::string& password, std::string_view salt) {
  Bytes32 hash{};
  const int done = EVP_PBE_scrypt(password.data(), password.size(),
                                  reinterpret_cast<const unsigned char*>(salt.data()), salt.size(),
                                  kCost, kBlock, kParallel, kMostMemory, hash.data(), hash.size());
  return done == 1 ? ToHex(hash) : "";
}

std::string Hashed(const std::string& password) {
  const auto salt = Draw<kSaltDigits / 2>();
  const std::string digits = ToHex(salt);
  const std::string hash = Scrypt(password, digits);
  return hash.empty() ? "" : fmt::format("{}{}:{}", kScrypt, digits, hash);
}

}  // namespace

Result<void> CheckPassword(const std::string& name, const std::string& password) {
  if (password.size() < kShortestPassword || password.size() > kLongestPassword) {
    return Fail(ErrorCode::kInvalidArgument, "a password is to have {} to {} characters",
                kShortestPassword, kLongestPassword);
  }
  const bool of_one =
      std::all_of(password.begin(), password.end(), [&](char c) { return c == password.front(); });
  if (of_one || password.find(name) != std::string::npos) {
    return Fail(ErrorCode::kInvalidArgument,
                "this password is guessed at once: it is not to contain the name, nor be of one "
                "character");
  }
  return {};
}

Result<std::string> HashPassword(const std::string& password) {
  std::string hash = Hashed(password);
  if (hash.empty()) return Fail(ErrorCode::kUnavailable, "there is no memory to hash a password");
  return hash;
}

bool IsPasswordHash(std::string_view text) {
  if (!text.starts_with(kScrypt)) return false;
  text.remove_prefix(kScrypt.size());
  return text.size() == kSaltDigits + 1 + kHashDigits && text[kSaltDigits] == ':' &&
         IsHex(text.substr(0, kSaltDigits)) && IsHex(text.substr(kSaltDigits + 1));
}

bool Matches(const std::string& password, const std::string& hash) {
  if (!IsPasswordHash(hash)) return false;
  const std::string_view salt = std::string_view(hash).substr(kScrypt.size(), kSaltDigits);
  const std::string_view kept = std::string_view(hash).substr(hash.size() - kHashDigits);
  const std::string made = Scrypt(password, salt);
  return made.size() == kept.size() && CRYPTO_memcmp(made.data(), kept.data(), kept.size()) == 0;
}

const std::string& NobodysHash() {
  static const std::string hash =
      fmt::format("{}{}:{}", kScrypt, DrawToken().substr(0, kSaltDigits), DrawToken());
  return hash;
}

std::string DrawToken() {
  const auto bytes = Draw<kHashDigits / 2>();
  return ToHex(bytes);
}

std::string DigestOf(std::string_view token) {
  const Bytes32 digest = Sha256(token);
  return std::string(kSha256) + ToHex(digest);
}

bool IsDigest(std::string_view text) {
  return text.starts_with(kSha256) && text.size() == kSha256.size() + kHashDigits &&
         IsHex(text.substr(kSha256.size()));
}

std::uint64_t KeyedHash(std::string_view key, std::string_view text) {
  const Bytes32 digest = Sha256(std::string(key) + ":" + std::string(text));
  std::uint64_t number = 0;
  std::memcpy(&number, digest.data(), sizeof(number));
  return number;
}

}  // namespace trailcast::users
