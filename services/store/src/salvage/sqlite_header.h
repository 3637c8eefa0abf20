#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "services/store/src/salvage/big_endian.h"

namespace trailcast::store {

// The first bytes of an SQLite file, https://www.sqlite.org/fileformat.html, "The Database Header",
// as big-endian numbers. Nothing of it is trusted here.
struct SqliteHeader {
  static constexpr std::size_t kBytes = 100;
  std::array<std::uint8_t, kBytes> bytes{};

  [[nodiscard]] bool IsSqlite() const {
    constexpr std::string_view kMagic("SQLite format 3\0", 16);
    return std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
  }
  [[nodiscard]] std::uint32_t page_bytes() const {
    const std::uint32_t raw = Number(16, 2);
    return raw == 1 ? 65536 : raw;
  }
  [[nodiscard]] std::uint32_t reserved_bytes() const { return Number(20, 1); }  // of each page
  [[nodiscard]] std::uint32_t page_count() const { return Number(28, 4); }
  // Says that the count is of the file's last change, and not from before one by a program that
  // keeps no count.
  [[nodiscard]] bool page_count_is_current() const { return Number(24, 4) == Number(92, 4); }
  [[nodiscard]] std::uint32_t first_free_page() const { return Number(32, 4); }
  [[nodiscard]] std::uint32_t user_version() const { return Number(60, 4); }
  [[nodiscard]] std::uint32_t application_id() const { return Number(68, 4); }

 private:
  [[nodiscard]] std::uint32_t Number(std::size_t at, std::size_t count) const {
    return static_cast<std::uint32_t>(BigEndian(bytes, at, count));
  }
};

}  // namespace trailcast::store
