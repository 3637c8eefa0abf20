#pragma once

#include <cstddef>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/route/bounds.h"

namespace trailcast::exchange {

// These bounds hold for what is accepted from a peer, and therefore for what is published, beside
// those of a route (route/bounds.h). docs/reference/protocol.md lists them too.
inline constexpr std::size_t kMaxPieceBytes = route::kMaxSegmentBytes;
inline constexpr std::size_t kMaxPiecesPerBatch = 4096;  // one Publish carries no more
inline constexpr std::size_t kMaxIndicesPerRequest = 1024;
inline constexpr std::size_t kMaxSegmentsPerReceipt = 1024;
inline constexpr std::size_t kMaxRoutesPerReply = 1000;
inline constexpr std::size_t kMaxSimilarNames = 16;
inline constexpr std::size_t kMaxHeldTold = 64;  // by one agent
inline constexpr std::size_t kMaxHoldingsPerReply = 1024;
inline constexpr std::size_t kMaxPlacesPerReply = 16;  // by view
inline constexpr std::size_t kMaxClaimedNames = 64;    // told at once
inline constexpr std::size_t kMaxFollowersTold = 1024;
inline constexpr std::size_t kMaxSectionsTold = 256;  // sections of a route, told at once
inline constexpr std::size_t kMaxTimesPassed = 1000;  // of each of these sections
inline constexpr std::size_t kMaxCursorBytes = 256;
inline constexpr std::size_t kMaxMissionsPerReply = 100;
inline constexpr std::size_t kMaxAnswersTold = 64;  // of each command
inline constexpr std::size_t kMaxRobotsTold = 256;
inline constexpr std::size_t kMaxNetworkLines = 1000;  // of a reply
inline constexpr std::size_t kMaxSoftwareBytes = 64;
inline constexpr double kMaxOdometryScale = 1000.0;
inline constexpr std::size_t kMaxSnapshotBytes = 64U << 10U;
inline constexpr std::size_t kMaxPhotoPieceBytes = 256U << 10U;
inline constexpr std::size_t kMaxPhotoBytes = 1U << 20U;
inline constexpr std::size_t kMaxHeardAgents = 256;  // told at once
inline constexpr std::size_t kMaxAddressBytes = 64;
inline constexpr std::size_t kMaxNetworkBytes = 16;   // a network interface's name
inline constexpr double kMaxLate_ms = 1e15;           // clocks may be anywhere
inline constexpr std::size_t kMaxEntriesTold = 4096;  // revisions in a summary of a store
inline constexpr std::size_t kMaxLineBytes = 512;     // details, errors, reasons

// Returns kInvalidArgument with the field, its value and what is accepted. It checks that a piece
// has a digest, but not that the digest matches the bytes (route::CheckDigest does).
[[nodiscard]] Result<void> CheckBounds(const Message& message);

// These check a catalog query and an edit, which a server judges when it answers.
[[nodiscard]] Result<void> CheckQuery(const route::RouteQuery& query);
[[nodiscard]] Result<void> CheckEdit(const route::RouteEdit& edit);

}  // namespace trailcast::exchange
