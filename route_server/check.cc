#include "route_server/check.h"

#include <fmt/format.h>

#include <filesystem>

#include "services/store/postgres_url.h"
#include "services/store/route_store.h"
#include "services/store/salvage.h"

namespace trailcast::server {
namespace {

namespace fs = std::filesystem;

// What is damaged, a line each; nothing if all is whole.
Result<std::vector<std::string>> FindDamage(const fs::path& file) {
  auto store = store::OpenSqliteStore(file);
  if (store) return (*store)->Verify();
  if (store.error().code != ErrorCode::kCorrupt) return tl::unexpected(store.error());
  return std::vector{store.error().message};
}

fs::path Unused(const fs::path& file, const std::string& suffix) {
  fs::path path = file.string() + suffix;
  for (int n = 2; fs::exists(path); ++n) path = fmt::format("{}{}-{}", file.string(), suffix, n);
  return path;
}

Result<void> Repair(const fs::path& file) {
  const fs::path repaired = Unused(file, ".repaired");
  const auto salvaged = store::Salvage(file, repaired);
  if (!salvaged) return tl::unexpected(salvaged.error());
  const fs::path kept = Unused(file, ".damaged");
  std::error_code error;
  // The log belongs to the damaged file; without it the new one is whole by itself.
  if (fs::exists(file.string() + "-wal")) {
    fs::rename(file.string() + "-wal", kept.string() + "-wal", error);
  }
  if (!error) fs::rename(file, kept, error);
  if (!error) fs::rename(repaired, file, error);
  if (error) {
    return Fail(ErrorCode::kUnavailable, "cannot put {} in the place of {}: {}", repaired.string(),
                file.string(), error.message());
  }
  fmt::print("repaired: {} routes and {} segments are whole; the damaged file is kept as {}\n",
             salvaged->routes, salvaged->segments, kept.string());
  for (const std::string& line : salvaged->lost) fmt::print("lost: {}\n", line);
  if (!salvaged->lost.empty()) {
    fmt::print("what is lost is asked for again when somebody who holds it announces the route\n");
  }
  return {};
}

// True if there is no damage to tell.
bool Tell(const std::vector<std::string>& damage, const std::string& store) {
  if (damage.empty()) fmt::print("{} is whole\n", store);
  for (const std::string& line : damage) fmt::print("damaged: {}\n", line);
  return damage.empty();
}

Result<bool> CheckFile(const fs::path& file, bool repair) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    return Fail(ErrorCode::kNotFound, "there is no route store {}", file.string());
  }
  const auto damage = FindDamage(file);
  if (!damage) return tl::unexpected(damage.error());
  if (Tell(*damage, file.string())) return true;
  if (!repair) {
    fmt::print("'trailcast-server check --repair --store {}' saves what is whole\n", file.string());
    return false;
  }
  if (auto repaired = Repair(file); !repaired) return tl::unexpected(repaired.error());
  return true;
}

// Servers may be using it.
Result<bool> CheckDatabase(const std::string& location, bool repair) {
  const auto url = store::ParsePostgresUrl(location);
  if (!url) return tl::unexpected(url.error());
  if (repair) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} is not repaired from here: use PostgreSQL's own tools (a standby, a backup)",
                url->shown);
  }
  const auto store = store::OpenPostgresStore(location, {.read_only = true});
  if (!store) return tl::unexpected(store.error());
  const auto damage = (*store)->Verify();
  if (!damage) return tl::unexpected(damage.error());
  return Tell(*damage, url->shown);
}

}  // namespace

Result<bool> Check(const std::string& location, bool repair) {
  return store::IsPostgresUrl(location) ? CheckDatabase(location, repair)
                                        : CheckFile(location, repair);
}

}  // namespace trailcast::server
