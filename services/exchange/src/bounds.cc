#include "services/exchange/bounds.h"

#include <cmath>

#include "services/base/hex.h"
#include "services/base/text.h"
#include "services/exchange/mirror.h"
#include "services/mission/address.h"

namespace trailcast::exchange {
namespace {

constexpr double kMaxTurn_radps = 100.0;
constexpr std::size_t kIdDigits = 32;

using route::CheckAmount;
using route::CheckCount;
using route::CheckEnum;
using route::CheckName;
using route::CheckText;
using route::kMaxLength_m;
using route::kMaxSegmentsPerRoute;
using route::RouteInfo;
using route::RouteKey;
using route::SegmentPiece;

Result<void> CheckIndex(SegmentIndex index) {
  return CheckCount("segment index", index.value(), kMaxSegmentsPerRoute - 1);
}

Result<void> CheckPercent(const char* field, std::optional<std::uint8_t> percent) {
  return percent ? CheckCount(field, *percent, 100) : Result<void>();
}

Result<void> CheckIndices(const char* field, const std::vector<SegmentIndex>& indices,
                          std::size_t max) {
  if (auto ok = CheckCount(field, indices.size(), max); !ok) return ok;
  for (const SegmentIndex index : indices) {
    if (auto ok = CheckIndex(index); !ok) return ok;
  }
  return {};
}

// Missions are also for groups, and for several robots.
Result<void> CheckAddress(const std::string& text) {
  const auto addressed = mission::ParseAddress(text);
  return addressed ? Result<void>() : tl::unexpected(addressed.error());
}

Result<void> CheckPiece(const SegmentPiece& piece) {
  if (auto ok = CheckKey(piece.key); !ok) return ok;
  if (auto ok = CheckIndex(piece.index); !ok) return ok;
  if (piece.digest == route::Digest{}) {
    return Fail(ErrorCode::kInvalidArgument, "segment {} of route {} has no digest",
                piece.index.value(), piece.key.route.value());
  }
  return CheckCount("bytes in a segment", piece.bytes.size(), kMaxPieceBytes);
}

Result<void> Check(const RouteAnnouncement& message) {
  if (auto ok = CheckName("holder", message.holder.value()); !ok) return ok;
  return CheckInfo(message.info);
}

Result<void> Check(const SegmentBatch& message) {
  if (auto ok = CheckName("sender", message.sender.value()); !ok) return ok;
  if (message.pieces.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "segment batch without segments");
  }
  if (auto ok = CheckCount("segments in a batch", message.pieces.size(), kMaxPiecesPerBatch); !ok) {
    return ok;
  }
  for (const SegmentPiece& piece : message.pieces) {
    if (auto ok = CheckPiece(piece); !ok) return ok;
  }
  return {};
}

Result<void> Check(const SegmentRequest& message) {
  if (auto ok = CheckName("requester", message.requester.value()); !ok) return ok;
  if (auto ok = CheckKey(message.key); !ok) return ok;
  return CheckIndices("lacking segments", message.lacking, kMaxIndicesPerRequest);
}

Result<void> Check(const Receipt& message) {
  if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  if (auto ok = CheckKey(message.key); !ok) return ok;
  if (auto ok = CheckState(message.durable_state); !ok) return ok;
  if (auto ok = CheckStanding(message.standing); !ok) return ok;
  if (auto ok = CheckCount("durable prefix", message.durable_prefix, kMaxSegmentsPerRoute); !ok) {
    return ok;
  }
  if (auto ok = CheckEnum("refusal", message.refusal, Refusal::kDeleted); !ok) return ok;
  if (auto ok = CheckText("reason", message.reason, kMaxLineBytes); !ok) return ok;
  if (auto ok =
          CheckCount("durable segments", message.durable_beyond.size(), kMaxSegmentsPerReceipt);
      !ok) {
    return ok;
  }
  for (const NamedSegment& segment : message.durable_beyond) {
    if (auto ok = CheckIndex(segment.index); !ok) return ok;
  }
  return {};
}

Result<void> Check(const CatalogRequest& message) {
  // The server judges the query, so that its reply can say what is wrong with it.
  return CheckName("client", message.client.value());
}

Result<void> Check(const RouteEditRequest& message) {
  return CheckName("client", message.client.value());
}

Result<void> CheckPlaces(const std::vector<route::FoundPlace>& places) {
  if (auto ok = CheckCount("places in a reply", places.size(), kMaxPlacesPerReply); !ok) return ok;
  for (const route::FoundPlace& place : places) {
    if (auto ok = CheckKey(place.key); !ok) return ok;
    if (auto ok = CheckIndex(place.segment); !ok) return ok;
    if (auto ok = CheckAmount("score", place.score, 1.0); !ok) return ok;
  }
  return {};
}

Result<void> Check(const CatalogReply& message) {
  if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  const route::RoutePage& page = message.page;
  if (auto ok = CheckCount("routes in a reply", page.routes.size(), kMaxRoutesPerReply); !ok) {
    return ok;
  }
  for (const RouteInfo& info : page.routes) {
    if (auto ok = CheckInfo(info); !ok) return ok;
  }
  if (auto ok = CheckText("cursor", page.next, kMaxCursorBytes); !ok) return ok;
  if (auto ok = CheckCount("similar names", message.similar_names.size(), kMaxSimilarNames); !ok) {
    return ok;
  }
  for (const std::string& name : message.similar_names) {
    if (auto ok = CheckName("similar name", name); !ok) return ok;
  }
  if (auto ok = CheckPlaces(message.places); !ok) return ok;
  if (auto ok = CheckCount("holdings", message.holdings.size(), kMaxHoldingsPerReply); !ok) {
    return ok;
  }
  for (const Holding& holding : message.holdings) {
    if (auto ok = CheckKey(holding.key); !ok) return ok;
    if (auto ok = CheckName("holder", holding.agent.value()); !ok) return ok;
  }
  if (auto ok = CheckCount("routes in part", message.lacking.size(), kMaxRoutesPerReply); !ok) {
    return ok;
  }
  for (const LackingSegments& lacking : message.lacking) {
    if (auto ok = CheckKey(lacking.key); !ok) return ok;
    if (auto ok = CheckCount("segments lacking", lacking.segments, kMaxSegmentsPerRoute); !ok) {
      return ok;
    }
  }
  return CheckText("error", message.error, kMaxLineBytes);
}

Result<void> CheckSpeed(double speed_mps) {
  constexpr double kMaxSpeed_mps = 1000.0;
  return CheckAmount("speed, forward or backward", std::abs(speed_mps), kMaxSpeed_mps);
}

Result<void> CheckFollowing(const Following& following) {
  if (auto ok = CheckEnum("carried by", following.carried_by, CarriedBy::kMotion); !ok) return ok;
  if (!following.odometry) return {};
  if (auto ok = CheckPercent("trust in odometry", following.odometry->percent); !ok) return ok;
  return CheckAmount("scale of odometry", following.odometry->scale, kMaxOdometryScale);
}

Result<void> Check(const AgentStatus& message) {
  if (auto ok = CheckName("agent", message.agent.value()); !ok) return ok;
  if (!message.route.empty()) {
    if (auto ok = CheckName("route name", message.route); !ok) return ok;
  }
  if (auto ok = CheckEnum("agent role", message.role, AgentRole::kOperator); !ok) return ok;
  if (auto ok = CheckEnum("agent mode", message.mode, AgentMode::kFault); !ok) return ok;
  if (auto ok = CheckAmount("progress", message.progress, 1.0); !ok) return ok;
  if (auto ok = CheckAmount("found share", message.found_share, 1.0); !ok) return ok;
  if (auto ok = CheckSpeed(message.speed_mps); !ok) return ok;
  if (auto ok = CheckEnum("hold", message.hold, AgentHold::kStopped); !ok) return ok;
  if (auto ok = CheckPercent("battery", message.battery_percent); !ok) return ok;
  if (auto ok = CheckPercent("link", message.link_percent); !ok) return ok;
  if (auto ok = CheckText("software", message.software, kMaxSoftwareBytes); !ok) return ok;
  if (auto ok = CheckCount("revisions held", message.held.size(), kMaxHeldTold); !ok) return ok;
  for (const RouteKey& key : message.held) {
    if (auto ok = CheckKey(key); !ok) return ok;
  }
  if (message.place) {
    if (auto ok = CheckKey(message.place->key); !ok) return ok;
    if (auto ok = CheckAmount("metres along the route", message.place->along_m, kMaxLength_m); !ok)
      return ok;
    const double left_m = std::abs(message.place->left_m);
    if (auto ok = CheckAmount("metres beside the route", left_m, kMaxLength_m); !ok) return ok;
    const double sigma_m = message.place->left_sigma_m;
    if (auto ok = CheckAmount("how sure of that, metres", sigma_m, kMaxLength_m); !ok) return ok;
  }
  if (message.following) {
    if (auto ok = CheckFollowing(*message.following); !ok) return ok;
  }
  return CheckText("detail", message.detail, kMaxLineBytes);
}

Result<void> Check(const Fleet& message) {
  if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  if (auto ok = CheckCount("claimed names", message.claimed.size(), kMaxClaimedNames); !ok) {
    return ok;
  }
  for (const ClaimedName& claimed : message.claimed) {
    if (auto ok = CheckName("claimed name", claimed.agent.value()); !ok) return ok;
  }
  return {};
}

Result<void> Check(const RouteFollowers& message) {
  if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  if (auto ok = CheckKey(message.key); !ok) return ok;
  if (auto ok = CheckCount("followers", message.followers.size(), kMaxFollowersTold); !ok) {
    return ok;
  }
  for (const RouteFollower& follower : message.followers) {
    if (auto ok = CheckName("follower", follower.agent.value()); !ok) return ok;
    if (auto ok = CheckAmount("metres along the route", follower.along_m, kMaxLength_m); !ok) {
      return ok;
    }
    if (auto ok = CheckSpeed(follower.speed_mps); !ok) return ok;
  }
  return {};
}

Result<void> Check(const NowCommand& message) {
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  if (auto ok = CheckEnum("order", message.order, NowOrder::kHome); !ok) return ok;
  if (auto ok = CheckEnum("whom", message.whom, NowWhom::kAll); !ok) return ok;
  if (message.whom != NowWhom::kAll) {
    if (auto ok = CheckAddress(message.name); !ok) return ok;
  } else if (!message.name.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "a command for all names '{}'", message.name);
  }
  return CheckText("reason", message.reason, kMaxLineBytes);
}

Result<void> Check(const NowAnswer& message) {
  if (auto ok = CheckAddress(message.agent.value()); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  return CheckText("detail", message.detail, kMaxLineBytes);
}

Result<void> Check(const mission::Mission& message) {
  if (auto ok = CheckAddress(message.agent.value()); !ok) return ok;
  if (auto ok = CheckName("mission", message.id); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  return CheckText("orders", message.orders, kMaxLineBytes);
}

Result<void> Check(const mission::Report& message) {
  if (auto ok = CheckAddress(message.agent.value()); !ok) return ok;
  if (auto ok = CheckName("mission", message.mission); !ok) return ok;
  // A robot takes a mission or refuses it; only servers put one off.
  const auto last = message.change == 0 ? mission::State::kPutOff : mission::State::kExpired;
  if (auto ok = CheckEnum("mission state", message.state, last); !ok) return ok;
  if (auto ok = CheckEnum("what it waits for", message.waits_for, mission::WaitsFor::kPlace); !ok) {
    return ok;
  }
  return CheckText("detail", message.detail, kMaxLineBytes);
}

Result<void> Check(const MissionRequest& message) {
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  const mission::Query& query = message.query;
  if (!query.agent.empty()) {
    if (auto ok = CheckAddress(query.agent); !ok) return ok;
  }
  for (const std::string* name : {&query.route, &query.id, &query.client}) {
    if (name->empty()) continue;
    if (auto ok = CheckName("mission query", *name); !ok) return ok;
  }
  return CheckCount("missions on a page", query.page_size, kMaxMissionsPerReply);
}

Result<void> Check(const MissionReply& message) {
  if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  if (auto ok = CheckCount("missions", message.missions.size(), kMaxMissionsPerReply); !ok) {
    return ok;
  }
  for (const mission::Record& record : message.missions) {
    if (auto ok = Check(record.mission); !ok) return ok;
    if (auto ok = Check(record.last); !ok) return ok;
  }
  if (auto ok = CheckCount("commands", message.commands.size(), kMaxMissionsPerReply); !ok) {
    return ok;
  }
  for (const mission::GivenCommand& given : message.commands) {
    if (auto ok = Check(given.command); !ok) return ok;
    if (auto ok = CheckCount("answers to a command", given.answers.size(), kMaxAnswersTold); !ok) {
      return ok;
    }
    for (const NowAnswer& answer : given.answers) {
      if (auto ok = Check(answer); !ok) return ok;
    }
  }
  if (auto ok = CheckCount("robots", message.robots.size(), kMaxRobotsTold); !ok) return ok;
  for (const std::string& robot : message.robots) {
    if (auto ok = CheckName("robot", robot); !ok) return ok;
  }
  return CheckText("error", message.error, kMaxLineBytes);
}

Result<void> Check(const DriveCommand& message) {
  if (auto ok = CheckName("agent", message.agent.value()); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  if (auto ok = CheckSpeed(message.linear_mps); !ok) return ok;
  return CheckAmount("turn in rad/s", std::abs(message.turn_radps), kMaxTurn_radps);
}

Result<void> Check(const SnapshotRequest& message) {
  if (auto ok = CheckName("agent", message.agent.value()); !ok) return ok;
  return CheckName("client", message.client.value());
}

Result<void> Check(const Snapshot& message) {
  if (auto ok = CheckName("agent", message.agent.value()); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  if (auto ok = CheckCount("bytes of a picture", message.picture.size(), kMaxSnapshotBytes); !ok) {
    return ok;
  }
  return CheckText("detail", message.detail, kMaxLineBytes);
}

Result<void> Check(const NetworkEdit& message) {
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  return CheckText("words", message.words, kMaxLineBytes);
}

Result<void> Check(const NetworkRequest& message) {
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  return CheckText("words", message.words, kMaxLineBytes);
}

Result<void> Check(const NetworkReply& message) {
  if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  if (auto ok = CheckCount("lines", message.lines.size(), kMaxNetworkLines); !ok) return ok;
  for (const std::string& line : message.lines) {
    if (auto ok = CheckText("line", line, kMaxLineBytes); !ok) return ok;
  }
  return CheckText("error", message.error, kMaxLineBytes);
}

Result<void> Check(const FollowedSections& message) {
  if (auto ok = CheckName("agent", message.agent.value()); !ok) return ok;
  if (auto ok = CheckKey(message.key); !ok) return ok;
  if (auto ok = CheckCount("sections", message.sections.size(), kMaxSectionsTold); !ok) {
    return ok;
  }
  constexpr auto kMost = static_cast<std::size_t>(kMaxLength_m / kFollowedSection_m);
  for (const FollowedSections::Section& each : message.sections) {
    if (auto ok = CheckCount("number of a section", each.number, kMost); !ok) return ok;
    if (auto ok = CheckCount("times passed", each.passed, kMaxTimesPassed); !ok) return ok;
    if (auto ok = CheckCount("times lost, of those passed", each.lost, each.passed); !ok) return ok;
  }
  return {};
}

Result<void> Check(const ReachRequest& message) {
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  return message.relayed ? CheckName("server", message.server.value()) : Result<void>();
}

Result<void> CheckHeard(const HeardAgent& heard) {
  if (auto ok = CheckName("heard agent", heard.agent.value()); !ok) return ok;
  if (auto ok = CheckEnum("agent role", heard.role, AgentRole::kOperator); !ok) return ok;
  if (auto ok = CheckAmount("ms under way", std::abs(heard.late_ms), kMaxLate_ms); !ok) return ok;
  if (auto ok = CheckAmount("ms there and back", heard.round_trip_ms.value_or(0.0), kMaxLate_ms);
      !ok) {
    return ok;
  }
  if (auto ok = CheckText("address", heard.address, kMaxAddressBytes); !ok) return ok;
  return CheckText("network interface", heard.network, kMaxNetworkBytes);
}

Result<void> Check(const ReachReport& message) {
  if (auto ok = CheckName("agent", message.agent.value()); !ok) return ok;
  if (auto ok = CheckName("client", message.client.value()); !ok) return ok;
  if (!message.server.value().empty()) {
    if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  }
  if (auto ok = CheckEnum("agent role", message.role, AgentRole::kOperator); !ok) return ok;
  if (auto ok = CheckCount("agents heard", message.heard.size(), kMaxHeardAgents); !ok) return ok;
  for (const HeardAgent& heard : message.heard) {
    if (auto ok = CheckHeard(heard); !ok) return ok;
  }
  return {};
}

Result<void> Check(const StoreSummary& message) {
  if (auto ok = CheckName("server", message.server.value()); !ok) return ok;
  const std::string& prefix = message.prefix;
  if (!IsHex(prefix) || prefix.size() % 2 != 0 || prefix.size() > kIdDigits) {
    return Fail(ErrorCode::kInvalidArgument,
                "beginning of route ids '{}' is not an even number of hexadecimal digits, {} at "
                "most",
                PlainText(prefix, kIdDigits), kIdDigits);
  }
  const bool all = message.parts.empty() || message.parts.size() == Mirror::kParts;
  if (!all || (!message.parts.empty() && !message.entries.empty())) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} parts of a store and {} revisions: either {} parts are accepted, or revisions",
                message.parts.size(), message.entries.size(), Mirror::kParts);
  }
  if (auto ok = CheckCount("revisions told", message.entries.size(), kMaxEntriesTold); !ok) {
    return ok;
  }
  for (const StoreSummary::Entry& entry : message.entries) {
    if (auto ok = CheckKey(entry.key); !ok) return ok;
  }
  return {};
}

Result<void> CheckPhoto(const AgentId& holder, const AgentId& client, const std::string& photo,
                        std::uint32_t offset) {
  if (auto ok = CheckName("holder", holder.value()); !ok) return ok;
  if (auto ok = CheckName("client", client.value()); !ok) return ok;
  if (auto ok = CheckName("photo", photo); !ok) return ok;
  return CheckCount("place in a photo", offset, kMaxPhotoBytes);
}

Result<void> Check(const PhotoPiece& message) {
  if (auto ok = CheckPhoto(message.holder, message.client, message.photo, message.offset); !ok) {
    return ok;
  }
  if (auto ok = CheckText("words", message.words, kMaxLineBytes); !ok) return ok;
  if (auto ok = CheckCount("bytes of a photo", message.bytes.size(), kMaxPhotoPieceBytes); !ok) {
    return ok;
  }
  return CheckText("error", message.error, kMaxLineBytes);
}

Result<void> Check(const PhotoRequest& message) {
  if (auto ok = CheckPhoto(message.client, message.holder, message.photo, message.offset); !ok) {
    return ok;
  }
  return CheckText("refusal", message.refusal, kMaxLineBytes);
}

Result<void> Check(const AgentGone& message) { return CheckName("agent", message.agent.value()); }

}  // namespace

Result<void> CheckBounds(const Message& message) {
  return std::visit([](const auto& value) { return Check(value); }, message);
}

}  // namespace trailcast::exchange
