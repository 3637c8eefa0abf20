#include "route_server/check.h"

#include <fmt/format.h>

#include <filesystem>

#include "services/store/lacking.h"
#include "services/store/postgres_url.h"
#include "services/store/route_store.h"
#include "services/store/salvage.h"

namespace trailcast::server {
namespace {

namespace fs = std::filesystem;

struct Findings {
  std::vector<std::string> damage;  // a line each
  std::vector<store::LackingRoute> lacking;
};

Result<Findings> Read(store::RouteStore& store) {
  auto damage = store.Verify();
  if (!damage) return tl::unexpected(damage.error());
  auto lacking = store::FindLacking(store);
  // The damage already tells of a route's damaged row.
  if (!lacking && damage->empty()) return tl::unexpected(lacking.error());
  return Findings{std::move(*damage), lacking ? std::move(*lacking) : Findings().lacking};
}

Result<Findings> ReadFile(const fs::path& file) {
  auto store = store::OpenSqliteStore(file);
  if (store) return Read(**store);
  if (store.error().code != ErrorCode::kCorrupt) return tl::unexpected(store.error());
  return Findings{{store.error().message}, {}};
}

void TellWhatBecomesOfIt() {
  fmt::print("what is lost is asked for again when somebody who holds it announces the route\n");
}

Condition Tell(const Findings& findings, const std::string& store) {
  for (const std::string& line : findings.damage) fmt::print("damaged: {}\n", line);
  for (const store::LackingRoute& route : findings.lacking) {
    fmt::print("lost: {}\n", store::Describe(route));
  }
  if (!findings.damage.empty()) return Condition::kDamaged;
  if (findings.lacking.empty()) {
    fmt::print("{} is whole\n", store);
    return Condition::kWhole;
  }
  fmt::print("{} is sound, but not all that it held is there\n", store);
  TellWhatBecomesOfIt();
  return Condition::kIncomplete;
}

Result<Condition> Repair(const fs::path& file) {
  const auto repaired = store::Repair(file);
  if (!repaired) return tl::unexpected(repaired.error());
  const store::Salvaged& saved = repaired->salvaged;
  fmt::print("repaired: {} routes and {} segments are whole; the damaged file is kept as {}\n",
             saved.routes, saved.segments, repaired->kept.string());
  for (const std::string& line : saved.lost) fmt::print("lost: {}\n", line);
  if (saved.lost.empty()) return Condition::kWhole;
  TellWhatBecomesOfIt();
  return Condition::kIncomplete;
}

Result<Condition> CheckFile(const fs::path& file, bool repair) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    return Fail(ErrorCode::kNotFound, "there is no route store {}", file.string());
  }
  const auto findings = ReadFile(file);
  if (!findings) return tl::unexpected(findings.error());
  const Condition condition = Tell(*findings, file.string());
  if (condition != Condition::kDamaged) return condition;
  if (repair) return Repair(file);
  fmt::print("'trailcast-server check --repair --store {}' saves what is whole\n", file.string());
  return condition;
}

// Servers may be using the database.
Result<Condition> CheckDatabase(const std::string& location, bool repair) {
  const auto url = store::ParsePostgresUrl(location);
  if (!url) return tl::unexpected(url.error());
  if (repair) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} is not repaired from here: use PostgreSQL's own tools (a standby, a backup)",
                url->shown);
  }
  const auto store = store::OpenPostgresStore(location, {.read_only = true});
  if (!store) return tl::unexpected(store.error());
  const auto findings = Read(**store);
  if (!findings) return tl::unexpected(findings.error());
  return Tell(*findings, url->shown);
}

}  // namespace

Result<Condition> Check(const std::string& location, bool repair) {
  return store::IsPostgresUrl(location) ? CheckDatabase(location, repair)
                                        : CheckFile(location, repair);
}

}  // namespace trailcast::server
