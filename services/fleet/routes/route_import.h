#pragma once

#include <string>

#include "services/archive/route_file.h"
#include "services/base/result.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/transfer.h"
#include "services/store/route_store.h"

namespace trailcast::fleet {

struct Imported {
  bool was_there = false;  // all of it was there before
  std::string holder;      // for people: "server 'barn'", "route store routes.db"
};

// Returns an importer's topics: a scout's, those of the catalog, and those to ask which server has
// what.
[[nodiscard]] exchange::TopicUse ImporterTopics();

// Imports a route, which is on the store's disk when this returns. The store never has a route
// without all of its segments. Fails with kConflict when the store has other segments under the
// same id and revision. `name` is the store's, for messages.
[[nodiscard]] Result<Imported> ImportIntoStore(const archive::RouteFile& file,
                                               store::RouteStore& store, const std::string& name);

// Imports a route, which is on a server's disk when this returns: the server has acknowledged every
// segment, and announced the whole route with this manifest. Fails with kConflict as above, or when
// an operator deleted the revision there; fails with kUnavailable when no server answers, or the
// one that did is full or has acknowledged nothing new for the watch's timeout.
[[nodiscard]] Result<Imported> ImportToServer(const archive::RouteFile& file, OperatorPeer& peer,
                                              const TransferWatch& watch);

}  // namespace trailcast::fleet
