#include "services/store/salvage.h"

#include "services/store/src/salvage/replacement.h"
#include "services/store/src/salvage/salvaging.h"
#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

Result<StoreFile> AcquireDamaged(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    return Fail(ErrorCode::kNotFound, "there is no route store {}", file.string());
  }
  return StoreFile::Acquire(file, StoreFile::Condition::kDamaged);
}

void Remove(const fs::path& store) {
  std::error_code ignored;
  for (const char* part : {"", "-wal", "-journal"}) fs::remove(store.string() + part, ignored);
}

}  // namespace

Result<Salvaged> Salvage(const fs::path& from, const fs::path& to, const SqliteOptions& options) {
  std::error_code ignored;
  if (fs::exists(to, ignored)) {
    return Fail(ErrorCode::kConflict, "{} exists already; move it away first", to.string());
  }
  const auto locked = AcquireDamaged(from);
  if (!locked) return tl::unexpected(locked.error());
  auto salvaged = SaveWhole(from, to, options);
  if (!salvaged) Remove(to);
  return salvaged;
}

Result<Repaired> Repair(const fs::path& file) {
  const auto locked = AcquireDamaged(file);
  if (!locked) return tl::unexpected(locked.error());
  const Replacement replacement(file);
  Remove(replacement.made());  // left by an interrupted repair
  auto salvaged = SaveWhole(file, replacement.made(), {});
  if (!salvaged) {
    Remove(replacement.made());
    return tl::unexpected(salvaged.error());
  }
  for (const auto& step : replacement.steps()) {
    if (auto done = step(); !done) return tl::unexpected(done.error());
  }
  return Repaired{std::move(*salvaged), replacement.kept()};
}

}  // namespace trailcast::store
