#pragma once

#include <cstdint>
#include <string>

#include "services/route/route.h"

namespace trailcast::store {

// A row of tables `route` and `tombstone` as they were when they kept what is known of a route
// column by column: SQLite's of version 4 and 5, PostgreSQL's of version 2.
class OldRow {
 public:
  OldRow() = default;
  virtual ~OldRow() = default;
  OldRow(const OldRow&) = delete;
  OldRow& operator=(const OldRow&) = delete;

  [[nodiscard]] virtual bool IsNull(int column) const = 0;
  [[nodiscard]] virtual std::string Text(int column) const = 0;
  [[nodiscard]] virtual std::int64_t Number(int column) const = 0;
  [[nodiscard]] virtual double Real(int column) const = 0;
  [[nodiscard]] virtual route::Bytes Bytes(int column) const = 0;
};

// In the order in which ReadOldRow reads them; version 4 had no column for two of them.
[[nodiscard]] std::string OldColumns(const char* teaching = "teaching",
                                     const char* cut_off = "cut_off");
inline constexpr int kOldColumnCount = 23;

// What the seals of rows were made of: version 4 left the labels out.
enum class OldSeal : std::uint8_t { kWithoutLabels, kOfAll };

struct OldRoute {
  route::RouteInfo info;
  bool whole = false;  // it fits its seal
};
[[nodiscard]] OldRoute ReadOldRow(const OldRow& row, OldSeal seal);

}  // namespace trailcast::store
