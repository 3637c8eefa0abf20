#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "services/base/result.h"

namespace trailcast::users {

inline constexpr std::size_t kShortestPassword = 10;
inline constexpr std::size_t kLongestPassword = 256;

// Checks that a password may be chosen. kInvalidArgument says what was expected.
[[nodiscard]] Result<void> CheckPassword(const std::string& name, const std::string& password);

// Hashes by scrypt (RFC 7914) with a fresh salt, "scrypt:32768:8:3:SALT:HASH". It takes a quarter
// of a second and 32 MB, so that a thief of the file can try few passwords.
[[nodiscard]] Result<std::string> HashPassword(const std::string& password);
[[nodiscard]] bool IsPasswordHash(std::string_view text);
// Takes equally long if the password does not match.
[[nodiscard]] bool Matches(const std::string& password, const std::string& hash);
// Returns the hash of a password that nobody knows.
[[nodiscard]] const std::string& NobodysHash();

// Draws 256 bits from the system's random source as 64 hexadecimal digits.
[[nodiscard]] std::string DrawToken();
// Returns what is stored of such a token, "sha256:DIGEST".
[[nodiscard]] std::string DigestOf(std::string_view token);
[[nodiscard]] bool IsDigest(std::string_view text);

// Hashes a text so that only an owner of `key` can predict the result.
[[nodiscard]] std::uint64_t KeyedHash(std::string_view key, std::string_view text);

}  // namespace trailcast::users
