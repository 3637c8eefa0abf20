#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>

#include "services/base/result.h"

namespace trailcast::store {

// This is in SQLite's header, so that `file` and we can tell a route store from any other database:
// "TRCT".
inline constexpr std::uint32_t kApplicationId = 0x54524354;
// The version of the tables, in SQLite's user_version; stores of another version are not opened.
inline constexpr std::uint32_t kSchemaVersion = 7;

// The file of a store, locked for this process and checked before SQLite touches it (which would
// create files beside it, or roll back a stranger's journal). The lock is the kernel's, so it ends
// with the process, however that dies.
class StoreFile {
 public:
  enum class Condition : std::uint8_t {
    kWhole,    // a store that is cut short, or of another version, is refused
    kDamaged,  // for saving what is left of it
  };
  // Creates the file if there is none. Errors are those of OpenSqliteStore; a refused file is left
  // as it was. An interrupted repair is finished first.
  [[nodiscard]] static Result<StoreFile> Acquire(const std::filesystem::path& path,
                                                 Condition condition = Condition::kWhole);

  ~StoreFile();
  StoreFile(StoreFile&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  StoreFile& operator=(StoreFile&&) = delete;
  StoreFile(const StoreFile&) = delete;
  StoreFile& operator=(const StoreFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  StoreFile(std::filesystem::path path, int descriptor)
      : path_(std::move(path)), descriptor_(descriptor) {}
  [[nodiscard]] static Result<StoreFile> OpenLocked(const std::filesystem::path& path);
  [[nodiscard]] Result<void> Lock() const;
  [[nodiscard]] bool IsStillThere() const;  // under its name
  [[nodiscard]] Result<void> Inspect() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace trailcast::store
