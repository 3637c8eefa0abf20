#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "services/base/result.h"

namespace trailcast::users {

inline constexpr std::size_t kShortestPassword = 10;
inline constexpr std::size_t kLongestPassword = 256;

// Whether it may be chosen. kInvalidArgument says what was expected.
[[nodiscard]] Result<void> CheckPassword(const std::string& name, const std::string& password);

// By scrypt (RFC 7914) with a salt of its own, "scrypt:32768:8:3:SALT:HASH": a quarter of a second
// and 32 MB, so that who steals the file tries few.
[[nodiscard]] Result<std::string> HashPassword(const std::string& password);
[[nodiscard]] bool IsPasswordHash(std::string_view text);
// Takes as long when it does not match.
[[nodiscard]] bool Matches(const std::string& password, const std::string& hash);
// Of a password that nobody knows.
[[nodiscard]] const std::string& NobodysHash();

// 256 bits from the system's random source, 64 hexadecimal digits: nobody guesses it.
[[nodiscard]] std::string DrawToken();
// What is kept of such a token, "sha256:DIGEST".
[[nodiscard]] std::string DigestOf(std::string_view token);
[[nodiscard]] bool IsDigest(std::string_view text);

// The same for the same text, and not to be told in advance by who does not know `key`.
[[nodiscard]] std::uint64_t KeyedHash(std::string_view key, std::string_view text);

}  // namespace trailcast::users
