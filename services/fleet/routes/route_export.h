#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "services/archive/route_file_writer.h"
#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"
#include "services/exchange/route_finder.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/transfer.h"
#include "services/store/route_store.h"

namespace trailcast::fleet {

// Returns which of the routes that a name or an id's beginning means is to be exported: the
// revision that followers would take, or the one that is asked for. `reply` answers the catalog's
// question for it, and `holder` is the server that answered, for messages. Fails with kNotFound,
// and what there is, when there is none; with kConflict for several routes; and with
// kInvalidArgument for one that is still being taught.
[[nodiscard]] Result<route::RouteInfo> ChooseForExport(const exchange::CatalogReply& reply,
                                                       const std::string& name_or_id,
                                                       const exchange::RevisionChoice& which,
                                                       const std::string& holder);

// Returns the topics of an operator's programs that fetch routes.
[[nodiscard]] exchange::TopicUse ExporterTopics();

// These give all the route's segments to `writer`, which was made for it, and return the file's
// size.
[[nodiscard]] Result<std::uint64_t> ExportFromStore(store::RouteStore& store,
                                                    const route::RouteInfo& info,
                                                    archive::RouteFileWriter writer);
// Passes all the route's segments, in order, to `take`, whose errors end it. `peer` has
// ExporterTopics. Fails with kUnavailable when nothing new has come for the watch's timeout, or the
// watch stopped it, and with kCorrupt when servers hold other bytes than were announced.
[[nodiscard]] Result<void> FetchInOrder(
    OperatorPeer& peer, const route::RouteInfo& info, const TransferWatch& watch,
    const std::function<Result<void>(const route::SegmentPiece&)>& take);
// Fetches the same into a file.
[[nodiscard]] Result<std::uint64_t> ExportFromServer(OperatorPeer& peer,
                                                     const route::RouteInfo& info,
                                                     archive::RouteFileWriter writer,
                                                     const TransferWatch& watch);

}  // namespace trailcast::fleet
