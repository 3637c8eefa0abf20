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

// Which of the routes that a name or an id's beginning means to export: the revision that followers
// would take, or the one that is asked for. `reply` answers the catalog's question for it; `holder`
// is who answered, for messages. kNotFound, with what there is, when there is none; kConflict for
// several routes; kInvalidArgument for one that is still being taught.
[[nodiscard]] Result<route::RouteInfo> ChooseForExport(const exchange::CatalogReply& reply,
                                                       const std::string& name_or_id,
                                                       const exchange::RevisionChoice& which,
                                                       const std::string& holder);

// What an operator's programs use who fetch routes.
[[nodiscard]] exchange::TopicUse ExporterTopics();

// Give all the route's segments to `writer`, which was made for it. Return the file's size.
[[nodiscard]] Result<std::uint64_t> ExportFromStore(store::RouteStore& store,
                                                    const route::RouteInfo& info,
                                                    archive::RouteFileWriter writer);
// All the route's segments, in order, each to `take`, whose errors end it. `peer` has
// ExporterTopics. kUnavailable when nothing new has come for the watch's timeout, or it was
// stopped; kCorrupt when what servers hold is not what was announced.
[[nodiscard]] Result<void> FetchInOrder(
    OperatorPeer& peer, const route::RouteInfo& info, const TransferWatch& watch,
    const std::function<Result<void>(const route::SegmentPiece&)>& take);
// The same into a file.
[[nodiscard]] Result<std::uint64_t> ExportFromServer(OperatorPeer& peer,
                                                     const route::RouteInfo& info,
                                                     archive::RouteFileWriter writer,
                                                     const TransferWatch& watch);

}  // namespace trailcast::fleet
