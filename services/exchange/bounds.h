#pragma once

#include <cstddef>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/route/bounds.h"

namespace trailcast::exchange {

// What is accepted from a peer, and therefore published, beyond what a route is (route/bounds.h).
// Also in docs/reference/protocol.md.
inline constexpr std::size_t kMaxPieceBytes = route::kMaxSegmentBytes;
inline constexpr std::size_t kMaxPiecesPerBatch = 4096;  // what one Publish may carry
inline constexpr std::size_t kMaxIndicesPerRequest = 1024;
inline constexpr std::size_t kMaxSegmentsPerReceipt = 1024;
inline constexpr std::size_t kMaxRoutesPerReply = 1000;
inline constexpr std::size_t kMaxSimilarNames = 16;
inline constexpr std::size_t kMaxHeldTold = 64;  // by one agent
inline constexpr std::size_t kMaxHoldingsPerReply = 1024;
inline constexpr std::size_t kMaxPlacesPerReply = 16;  // by view
inline constexpr std::size_t kMaxClaimedNames = 64;    // told at once
inline constexpr std::size_t kMaxFollowersTold = 1024;
inline constexpr std::size_t kMaxStretchesTold = 256;  // how they were followed, at once
inline constexpr std::size_t kMaxTimesPassed = 1000;   // each of those
inline constexpr std::size_t kMaxCursorBytes = 256;
inline constexpr std::size_t kMaxMissionsPerReply = 100;
inline constexpr std::size_t kMaxAnswersTold = 64;     // of each command
inline constexpr std::size_t kMaxNetworkLines = 1000;  // of a reply
inline constexpr std::size_t kMaxSoftwareBytes = 64;
inline constexpr double kMaxOdometryScale = 1000.0;
inline constexpr std::size_t kMaxGlanceBytes = 64U << 10U;
inline constexpr std::size_t kMaxHeardAgents = 256;  // told at once
inline constexpr std::size_t kMaxAddressBytes = 64;
inline constexpr std::size_t kMaxNetworkBytes = 16;   // a network interface's name
inline constexpr double kMaxLate_ms = 1e15;           // clocks may be anywhere
inline constexpr std::size_t kMaxEntriesTold = 4096;  // revisions in a summary of a store
inline constexpr std::size_t kMaxLineBytes = 512;     // details, errors, reasons

// kInvalidArgument naming the field, what it holds and what is accepted. The digest of a piece is
// not checked against its bytes here (route::CheckDigest), only that there is one.
[[nodiscard]] Result<void> CheckBounds(const Message& message);

// The same of a catalog query and of an edit, which a server judges when it answers.
[[nodiscard]] Result<void> CheckQuery(const route::RouteQuery& query);
[[nodiscard]] Result<void> CheckEdit(const route::RouteEdit& edit);

}  // namespace trailcast::exchange
