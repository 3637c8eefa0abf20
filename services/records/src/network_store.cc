#include "services/records/network_store.h"

#include <utility>

#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

// `shared_by_routes` has the metres that the two routes of a found junction share.
constexpr OwnFile kNetworkFile{.id = 0x5452434E,  // "TRCN"
                               .version = 1,
                               .tables = R"(
CREATE TABLE joint (
  number INTEGER PRIMARY KEY,
  from_route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_route TEXT NOT NULL,
  to_m REAL NOT NULL,
  both INTEGER NOT NULL,
  ahead_m REAL,
  left_m REAL,
  turn_rad REAL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL,
  UNIQUE (from_route, from_m, to_route, to_m)
) STRICT;
CREATE TABLE condition (
  number INTEGER PRIMARY KEY,
  route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_m REAL NOT NULL,
  closed INTEGER NOT NULL,
  speed REAL NOT NULL,
  cost REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
CREATE INDEX condition_route ON condition (route);
CREATE TABLE named_place (
  name TEXT PRIMARY KEY,
  route TEXT NOT NULL,
  along_m REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
CREATE TABLE proposed_joint (
  number INTEGER PRIMARY KEY,
  from_route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_route TEXT NOT NULL,
  to_m REAL NOT NULL,
  both INTEGER NOT NULL,
  ahead_m REAL,
  left_m REAL,
  turn_rad REAL,
  confidence REAL NOT NULL,
  verdict INTEGER NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL,
  UNIQUE (from_route, from_m, to_route, to_m)
) STRICT;
CREATE TABLE searched (revision TEXT PRIMARY KEY) STRICT;
CREATE TABLE shared_by_routes (
  from_route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_route TEXT NOT NULL,
  to_m REAL NOT NULL,
  length_m REAL NOT NULL,
  PRIMARY KEY (from_route, from_m, to_route, to_m)
) STRICT;
CREATE TABLE lane_part (
  number INTEGER PRIMARY KEY,
  lane INTEGER NOT NULL,
  route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_m REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
CREATE TABLE lane_holder (
  lane INTEGER NOT NULL,
  agent TEXT NOT NULL,
  PRIMARY KEY (lane, agent)
) STRICT;
CREATE TABLE followed_stretch (
  route TEXT NOT NULL,
  teaching INTEGER NOT NULL,
  number INTEGER NOT NULL,
  passed REAL NOT NULL,
  lost REAL NOT NULL,
  at_unix_ms INTEGER NOT NULL,
  PRIMARY KEY (route, teaching, number)
) STRICT;
CREATE TABLE backed_stretch (
  number INTEGER PRIMARY KEY,
  route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_m REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
)",
                               .holds = "junctions",
                               .called = "store of the network",
                               .added = R"(
CREATE TABLE IF NOT EXISTS home (name TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS dock (name TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS dock_holder (
  dock TEXT NOT NULL,
  agent TEXT NOT NULL,
  PRIMARY KEY (dock, agent)
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS charge (
  below_percent INTEGER NOT NULL,
  until_percent INTEGER NOT NULL
) STRICT;
)"};

}  // namespace

NetworkStore::NetworkStore(std::unique_ptr<OwnDatabase> database)
    : database_(std::move(database)) {}
NetworkStore::~NetworkStore() = default;

Result<std::unique_ptr<NetworkStore>> NetworkStore::Open(const fs::path& file) {
  using Opened = Result<std::unique_ptr<NetworkStore>>;
  return OwnDatabase::Guard(file, kNetworkFile, "opening it", [&]() -> Opened {
    return std::unique_ptr<NetworkStore>(
        new NetworkStore(std::make_unique<OwnDatabase>(file, kNetworkFile)));
  });
}

}  // namespace trailcast::store
