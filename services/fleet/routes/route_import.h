#pragma once

#include <string>

#include "services/archive/route_file.h"
#include "services/base/result.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/transfer.h"
#include "services/store/route_store.h"

namespace trailcast::fleet {

struct Imported {
  bool was_there = false;  // all of it, before
  std::string holder;      // for people: "server 'barn'", "route store routes.db"
};

// What an importer takes part in: a scout's topics, those of the catalog, and to ask who has what.
[[nodiscard]] exchange::TopicUse ImporterTopics();

// On the store's disk when this returns; no route is in it without all of its segments. kConflict
// when the store has other segments under the same id and revision. `name` is the store's, for
// messages.
[[nodiscard]] Result<Imported> ImportIntoStore(const archive::RouteFile& file,
                                               store::RouteStore& store, const std::string& name);

// On a server's disk when this returns: it has confirmed every segment, and announced the whole
// route with this manifest. kConflict as above, or when an operator deleted the revision there;
// kUnavailable when no server answers, or the one that did is full, or has confirmed nothing new
// for the watch's timeout.
[[nodiscard]] Result<Imported> ImportToServer(const archive::RouteFile& file, OperatorPeer& peer,
                                              const TransferWatch& watch);

}  // namespace trailcast::fleet
