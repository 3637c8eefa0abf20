#include "services/store/src/salvage/replacement.h"

#include <system_error>

#include "services/base/durable_file.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

// Gives the file another name as well, or copies it if the file system has no links.
std::error_code Link(const fs::path& file, const fs::path& name) {
  std::error_code error;
  fs::remove(name, error);
  fs::create_hard_link(file, name, error);
  if (!error) return {};
  fs::copy_file(file, name, error);
  return error ? error : SyncToDisk(name);
}

// Returns the first name that is free, or that an interrupted replacement gave to this very file.
fs::path NameToKeep(const fs::path& store) {
  std::error_code ignored;
  fs::path name = store.string() + ".damaged";
  for (int n = 2; fs::exists(name, ignored) && !fs::equivalent(name, store, ignored); ++n) {
    name = fmt::format("{}.damaged-{}", store.string(), n);
  }
  return name;
}

}  // namespace

Replacement::Replacement(const fs::path& store)
    : store_(store),
      made_(store.string() + ".repairing"),
      begun_(store.string() + ".repaired"),
      kept_(NameToKeep(store)) {}

std::vector<Replacement::Step> Replacement::steps() const {
  return {[this] { return Keep(); }, [this] { return Begin(); }, [this] { return DropLog(); },
          [this] { return Put(); }};
}

bool Replacement::IsBegun() const {
  std::error_code ignored;
  return fs::exists(begun_, ignored);
}

Result<void> Replacement::Finish() const {
  if (auto dropped = DropLog(); !dropped) return dropped;
  return Put();
}

Result<void> Replacement::Keep() const {
  std::error_code error;
  for (const char* part : {"", "-wal"}) {
    if (error || !fs::exists(store_.string() + part, error)) continue;
    error = Link(store_.string() + part, kept_.string() + part);
  }
  return Ended(error);
}

Result<void> Replacement::Begin() const {
  std::error_code error = SyncToDisk(made_);
  if (!error) fs::rename(made_, begun_, error);
  return Ended(error);
}

Result<void> Replacement::DropLog() const {
  std::error_code error;
  for (const char* part : {"-wal", "-journal"}) {
    if (!error) fs::remove(store_.string() + part, error);
  }
  return Ended(error);
}

Result<void> Replacement::Put() const {
  std::error_code error;
  fs::rename(begun_, store_, error);
  return Ended(error);
}

Result<void> Replacement::Ended(const std::error_code& error) const {
  const std::error_code result = error ? error : SyncToDisk(FolderOf(store_));
  if (!result) return {};
  return Fail(ErrorCode::kUnavailable, "cannot put the repaired store in the place of {}: {}",
              store_.string(), result.message());
}

}  // namespace trailcast::store
