#include <algorithm>
#include <cstring>
#include <optional>
#include <span>

#include "services/dds/src/wire.h"
#include "services/exchange/bounds.h"
#include "trailcast.h"

namespace trailcast::dds {
namespace {

using namespace exchange;  // every message type is used here
using route::Digest;
using route::RouteInfo;
using route::RouteKey;
using route::RouteState;

constexpr float kSubpixels = 16.0F;

// Values are copied as they are, even with sizes that CheckBounds will refuse afterwards.

// Cuts a text that is too long just above the longest allowed one.
std::string Text(const char* text) {
  constexpr std::size_t kAboveAnyBound = kMaxLineBytes + 1;
  return text == nullptr ? std::string() : std::string(text, strnlen(text, kAboveAnyBound));
}

template <typename Sequence>
auto Elements(const Sequence& sequence) {
  return std::span(sequence._buffer, sequence._length);
}

template <typename Sequence>
std::vector<SegmentIndex> Indices(const Sequence& sequence) {
  std::vector<SegmentIndex> indices;
  indices.reserve(sequence._length);
  for (const std::uint32_t value : Elements(sequence)) indices.emplace_back(value);
  return indices;
}

Digest ToDigest(const trailcast_wire_Sha256& wire) {
  Digest digest{};
  std::copy(std::begin(wire), std::end(wire), digest.begin());
  return digest;
}

template <typename Sequence>
std::vector<NamedSegment> Named(const Sequence& sequence) {
  std::vector<NamedSegment> segments;
  segments.reserve(sequence._length);
  for (const auto& wire : Elements(sequence)) {
    segments.push_back({SegmentIndex(wire.index), ToDigest(wire.digest)});
  }
  return segments;
}

template <typename Sequence>
std::vector<std::string> Texts(const Sequence& sequence) {
  std::vector<std::string> texts;
  for (const char* text : Elements(sequence)) texts.push_back(Text(text));
  return texts;
}

std::optional<route::Place> From(const trailcast_wire_RoutePlace& wire) {
  if (wire.frame == 0) return std::nullopt;
  return route::Place{static_cast<route::Place::Frame>(wire.frame), wire.x, wire.y};
}

RouteKey From(const trailcast_wire_RouteKey& wire) {
  return {.route = RouteId(Text(wire.route)), .teaching = TeachingId(wire.teaching)};
}

RouteInfo From(const trailcast_wire_RouteKey& key, const trailcast_wire_RouteInfo& wire) {
  return {.key = From(key),
          .name = Text(wire.name),
          .revision = RevisionNumber(wire.revision),
          .scout = AgentId(Text(wire.scout)),
          .camera = Text(wire.camera),
          .image_width_px = static_cast<int>(wire.image_width_px),
          .image_height_px = static_cast<int>(wire.image_height_px),
          .taught_unix_ms = wire.taught_unix_ms,
          .state = static_cast<RouteState>(wire.state),
          .segment_count = wire.segment_count,
          .length_m = wire.length_m,
          .bytes = wire.bytes,
          .manifest_digest = ToDigest(wire.manifest_digest),
          .cut_off = wire.cut_off != 0,
          .tags = Texts(wire.tags),
          .place = From(wire.place),
          .description = Text(wire.description),
          .standing = static_cast<route::Standing>(wire.standing),
          .to_review = wire.to_review != 0,
          .edition = wire.edition,
          .refreshes = RevisionNumber(wire.refreshes)};
}

Message From(const trailcast_wire_RouteAnnouncement& wire) {
  return RouteAnnouncement{.holder = AgentId(Text(wire.holder)), .info = From(wire.key, wire.info)};
}

Message From(const trailcast_wire_SegmentBatch& wire) {
  SegmentBatch batch{.sender = AgentId(Text(wire.sender)), .pieces = {}};
  batch.pieces.reserve(wire.pieces._length);
  for (const trailcast_wire_SegmentPiece& piece : Elements(wire.pieces)) {
    const auto bytes = Elements(piece.bytes);
    batch.pieces.push_back({.key = From(piece.key),
                            .index = SegmentIndex(piece.index),
                            .digest = ToDigest(piece.digest),
                            .bytes = route::Bytes(bytes.begin(), bytes.end())});
  }
  return batch;
}

Message From(const trailcast_wire_SegmentRequest& wire) {
  return SegmentRequest{.requester = AgentId(Text(wire.requester)),
                        .key = From(wire.key),
                        .lacking = Indices(wire.lacking),
                        .digests_only = wire.digests_only != 0};
}

Message From(const trailcast_wire_Receipt& wire) {
  return Receipt{.server = AgentId(Text(wire.server)),
                 .key = From(wire.key),
                 .durable_prefix = wire.durable_prefix,
                 .prefix_digest = ToDigest(wire.prefix_digest),
                 .durable_beyond = Named(wire.durable_beyond),
                 .durable_state = static_cast<RouteState>(wire.durable_state),
                 .revision = RevisionNumber(wire.revision),
                 .standing = static_cast<route::Standing>(wire.standing),
                 .followed = RevisionNumber(wire.followed),
                 .refusal = static_cast<Refusal>(wire.refusal),
                 .reason = Text(wire.reason)};
}

template <typename Sequence>
route::View ViewFrom(const Sequence& wire) {
  route::View view;
  float size_px = 0.0F;
  for (const trailcast_wire_ViewFeature& seen : Elements(wire)) {
    route::ViewFeature feature;
    std::copy(std::begin(seen.descriptor), std::end(seen.descriptor), feature.descriptor.begin());
    feature.u_px = static_cast<float>(seen.u_sixteenth_px) / kSubpixels;
    feature.v_px = static_cast<float>(seen.v_sixteenth_px) / kSubpixels;
    if (route::IsDescribed(feature.descriptor)) {
      feature.size_px = size_px;
      view.push_back(feature);
    } else {
      size_px = feature.u_px;
    }
  }
  return view;
}

route::RouteQuery From(const trailcast_wire_CatalogQuery& wire) {
  route::RouteQuery query{.name = Text(wire.name),
                          .name_prefix = Text(wire.name_prefix),
                          .tags = Texts(wire.tags),
                          .scout = Text(wire.scout),
                          .camera_prefix = Text(wire.camera_prefix),
                          .min_length_m = wire.min_length_m,
                          .max_length_m = wire.max_length_m,
                          .taught_from_unix_ms = wire.taught_from_unix_ms,
                          .taught_until_unix_ms = wire.taught_until_unix_ms,
                          .order = static_cast<route::RouteOrder>(wire.order),
                          .page_size = wire.page_size,
                          .cursor = Text(wire.cursor)};
  if (wire.state != 0) query.state = static_cast<RouteState>(wire.state - 1);
  if (wire.standing != 0) query.standing = static_cast<route::Standing>(wire.standing - 1);
  if (const auto middle = From(wire.near)) query.near = {*middle, wire.radius_m};
  query.view = ViewFrom(wire.view);
  return query;
}

Message From(const trailcast_wire_CatalogRequest& wire) {
  return CatalogRequest{
      .client = AgentId(Text(wire.client)), .request = wire.request, .query = From(wire.query)};
}

Message From(const trailcast_wire_CatalogReply& wire) {
  CatalogReply reply{.server = AgentId(Text(wire.server)),
                     .client = AgentId(Text(wire.client)),
                     .request = wire.request,
                     .page = {.routes = {}, .total = wire.total, .next = Text(wire.next)},
                     .similar_names = Texts(wire.similar_names),
                     .error = Text(wire.error)};
  for (const trailcast_wire_CatalogRoute& route : Elements(wire.routes)) {
    reply.page.routes.push_back(From(route.key, route.info));
  }
  for (const trailcast_wire_FoundPlace& place : Elements(wire.places)) {
    reply.places.push_back({From(place.key), SegmentIndex(place.segment), place.score});
  }
  for (const trailcast_wire_Holding& holding : Elements(wire.holdings)) {
    reply.holdings.push_back({From(holding.key), AgentId(Text(holding.agent))});
  }
  for (const trailcast_wire_LackingSegments& lacking : Elements(wire.lacking)) {
    reply.lacking.push_back({From(lacking.key), lacking.segments});
  }
  reply.coverage = {wire.coverage.segments_indexed, wire.coverage.segments_stored,
                    wire.coverage.routes_unseen};
  return reply;
}

std::optional<std::uint8_t> PercentFrom(std::uint8_t wire) {
  return wire == kUnknownPercent ? std::nullopt : std::optional(wire);
}

std::optional<Following> FollowingFrom(const trailcast_wire_AgentStatus& wire) {
  if (wire.carried_by == kDoesNotFollow) return std::nullopt;
  Following following{static_cast<CarriedBy>(wire.carried_by), std::nullopt};
  if (const auto percent = PercentFrom(wire.odometry_percent)) {
    following.odometry = OdometryTrust{*percent, wire.odometry_scale};
  }
  return following;
}

Message From(const trailcast_wire_AgentStatus& wire) {
  AgentStatus status{.agent = AgentId(Text(wire.agent)),
                     .instance = wire.instance,
                     .role = static_cast<AgentRole>(wire.role),
                     .mode = static_cast<AgentMode>(wire.mode),
                     .route = Text(wire.route),
                     .segment = wire.segment,
                     .segments = wire.segments,
                     .progress = wire.progress,
                     .speed_mps = wire.speed_mps,
                     .features = wire.features,
                     .found_share = wire.found_share,
                     .backlog = wire.backlog,
                     .detail = Text(wire.detail)};
  for (const trailcast_wire_RouteKey& key : Elements(wire.held)) status.held.push_back(From(key));
  if (!Text(wire.on.route).empty()) {
    status.place = PlaceOnRoute{From(wire.on), wire.along_m, wire.left_m, wire.left_sigma_m};
  }
  status.hold = static_cast<AgentHold>(wire.hold);
  status.on_duty = wire.on_duty != 0;
  status.battery_percent = PercentFrom(wire.battery_percent);
  status.link_percent = PercentFrom(wire.link_percent);
  status.software = Text(wire.software);
  status.following = FollowingFrom(wire);
  return status;
}

Message From(const trailcast_wire_RouteEditRequest& wire) {
  return RouteEditRequest{.client = AgentId(Text(wire.client)),
                          .request = wire.request,
                          .edit = {.action = static_cast<route::EditAction>(wire.action),
                                   .route = Text(wire.route),
                                   .revision = wire.revision,
                                   .text = Text(wire.text),
                                   .tags = Texts(wire.tags)}};
}

Message From(const trailcast_wire_Fleet& wire) {
  Fleet fleet{.server = AgentId(Text(wire.server)), .agents = wire.agents, .claimed = {}};
  for (const trailcast_wire_ClaimedName& claimed : Elements(wire.claimed)) {
    fleet.claimed.push_back({AgentId(Text(claimed.agent)), claimed.claims, claimed.keeps});
  }
  return fleet;
}

NowCommand From(const trailcast_wire_NowCommand& wire) {
  return {.client = AgentId(Text(wire.client)),
          .number = wire.number,
          .order = static_cast<NowOrder>(wire.order),
          .whom = static_cast<NowWhom>(wire.whom),
          .name = Text(wire.name),
          .reason = Text(wire.reason),
          .relayed = wire.relayed != 0};
}

NowAnswer From(const trailcast_wire_NowAnswer& wire) {
  return {.agent = AgentId(Text(wire.agent)),
          .client = AgentId(Text(wire.client)),
          .number = wire.number,
          .refused = wire.refused != 0,
          .detail = Text(wire.detail),
          .relayed = wire.relayed != 0};
}

mission::Mission From(const trailcast_wire_Mission& wire) {
  return {.agent = AgentId(Text(wire.agent)),
          .id = Text(wire.id),
          .client = AgentId(Text(wire.client)),
          .orders = Text(wire.orders),
          .valid_for_s = wire.valid_for_s,
          .goes_on = wire.goes_on != 0,
          .relayed = wire.relayed != 0};
}

mission::Report From(const trailcast_wire_MissionReport& wire) {
  return {.agent = AgentId(Text(wire.agent)),
          .mission = Text(wire.id),
          .change = wire.change,
          .state = static_cast<mission::State>(wire.state),
          .task = wire.task,
          .way = wire.way,
          .waits_for = static_cast<mission::WaitsFor>(wire.waits_for),
          .detail = Text(wire.detail),
          .relayed = wire.relayed != 0};
}

Message From(const trailcast_wire_MissionRequest& wire) {
  const trailcast_wire_MissionQuery& query = wire.query;
  return MissionRequest{.client = AgentId(Text(wire.client)),
                        .request = wire.request,
                        .commands = wire.commands != 0,
                        .query = {.agent = Text(query.agent),
                                  .route = Text(query.route),
                                  .id = Text(query.id),
                                  .client = Text(query.client),
                                  .states = query.states,
                                  .from_unix_ms = query.from_unix_ms,
                                  .until_unix_ms = query.until_unix_ms,
                                  .page_size = query.page_size,
                                  .before = query.before}};
}

Message From(const trailcast_wire_MissionReply& wire) {
  MissionReply reply{.server = AgentId(Text(wire.server)),
                     .client = AgentId(Text(wire.client)),
                     .request = wire.request,
                     .missions = {},
                     .commands = {},
                     .robots = Texts(wire.robots),
                     .next = wire.next,
                     .error = Text(wire.error)};
  for (const trailcast_wire_MissionRecord& record : Elements(wire.missions)) {
    reply.missions.push_back({.mission = From(record.sent),
                              .last = From(record.last),
                              .sent_unix_ms = record.sent_unix_ms,
                              .changed_unix_ms = record.changed_unix_ms});
  }
  for (const trailcast_wire_GivenCommand& wire_given : Elements(wire.commands)) {
    mission::GivenCommand& given = reply.commands.emplace_back();
    given.command = From(wire_given.given);
    for (const trailcast_wire_NowAnswer& answer : Elements(wire_given.answers)) {
      given.answers.push_back(From(answer));
    }
    given.given_unix_ms = wire_given.given_unix_ms;
  }
  return reply;
}

Message From(const trailcast_wire_DriveCommand& wire) {
  return DriveCommand{.agent = AgentId(Text(wire.agent)),
                      .client = AgentId(Text(wire.client)),
                      .linear_mps = wire.linear_mps,
                      .turn_radps = wire.turn_radps,
                      .sent_ms = wire.sent_ms};
}

Message From(const trailcast_wire_SnapshotRequest& wire) {
  return SnapshotRequest{.agent = AgentId(Text(wire.agent)),
                         .client = AgentId(Text(wire.client)),
                         .request = wire.request};
}

Message From(const trailcast_wire_Snapshot& wire) {
  const auto picture = Elements(wire.picture);
  return Snapshot{.agent = AgentId(Text(wire.agent)),
                  .client = AgentId(Text(wire.client)),
                  .request = wire.request,
                  .picture = {picture.begin(), picture.end()},
                  .marked = wire.marked != 0,
                  .detail = Text(wire.detail)};
}

Message From(const trailcast_wire_NetworkEdit& wire) {
  return NetworkEdit{
      .client = AgentId(Text(wire.client)), .request = wire.request, .words = Text(wire.words)};
}

Message From(const trailcast_wire_NetworkRequest& wire) {
  return NetworkRequest{.client = AgentId(Text(wire.client)),
                        .request = wire.request,
                        .words = Text(wire.words),
                        .first = wire.first};
}

Message From(const trailcast_wire_NetworkReply& wire) {
  return NetworkReply{.server = AgentId(Text(wire.server)),
                      .client = AgentId(Text(wire.client)),
                      .request = wire.request,
                      .lines = Texts(wire.lines),
                      .next = wire.next,
                      .error = Text(wire.error)};
}

Message From(const trailcast_wire_FollowedSections& wire) {
  FollowedSections all{.agent = AgentId(Text(wire.agent)), .key = From(wire.on)};
  for (const trailcast_wire_FollowedSection& each : Elements(wire.sections)) {
    all.sections.push_back({.number = each.number, .passed = each.passed, .lost = each.lost});
  }
  return all;
}

Message From(const trailcast_wire_RouteFollowers& wire) {
  RouteFollowers all{.server = AgentId(Text(wire.server)), .key = From(wire.key), .followers = {}};
  for (const trailcast_wire_RouteFollower& follower : Elements(wire.followers)) {
    all.followers.push_back({.agent = AgentId(Text(follower.agent)),
                             .along_m = follower.along_m,
                             .speed_mps = follower.speed_mps,
                             .heard = follower.heard != 0,
                             .age = std::chrono::milliseconds(follower.age_ms)});
  }
  return all;
}

Message From(const trailcast_wire_ReachRequest& wire) {
  return ReachRequest{.client = AgentId(Text(wire.client)),
                      .request = wire.request,
                      .relayed = wire.relayed != 0,
                      .server = AgentId(Text(wire.server))};
}

Message From(const trailcast_wire_ReachReport& wire) {
  ReachReport report{.agent = AgentId(Text(wire.agent)),
                     .client = AgentId(Text(wire.client)),
                     .request = wire.request,
                     .server = AgentId(Text(wire.server)),
                     .role = static_cast<AgentRole>(wire.role),
                     .star = wire.star != 0,
                     .heard = {},
                     .before = wire.before,
                     .relayed = wire.relayed != 0};
  for (const trailcast_wire_HeardAgent& heard : Elements(wire.heard)) {
    const bool measured = !(heard.round_trip_ms < 0.0);
    report.heard.push_back(
        {.agent = AgentId(Text(heard.agent)),
         .role = static_cast<AgentRole>(heard.role),
         .heard_for = std::chrono::milliseconds(heard.heard_for_ms),
         .age = std::chrono::milliseconds(heard.age_ms),
         .late_ms = heard.late_ms,
         .round_trip_ms = measured ? std::optional(heard.round_trip_ms) : std::nullopt,
         .address = Text(heard.address),
         .network = Text(heard.network)});
  }
  return report;
}

Message From(const trailcast_wire_StoreSummary& wire) {
  StoreSummary summary{.server = AgentId(Text(wire.server)), .prefix = Text(wire.prefix)};
  const auto parts = Elements(wire.parts);
  summary.parts.assign(parts.begin(), parts.end());
  for (const trailcast_wire_StoreEntry& entry : Elements(wire.entries)) {
    summary.entries.push_back({From(entry.of), entry.digest});
  }
  return summary;
}

Message From(const trailcast_wire_PhotoPiece& wire) {
  const auto bytes = Elements(wire.bytes);
  return PhotoPiece{.holder = AgentId(Text(wire.holder)),
                    .client = AgentId(Text(wire.client)),
                    .photo = Text(wire.photo),
                    .words = Text(wire.words),
                    .offset = wire.offset,
                    .bytes = {bytes.begin(), bytes.end()},
                    .error = Text(wire.error)};
}

Message From(const trailcast_wire_PhotoRequest& wire) {
  return PhotoRequest{.client = AgentId(Text(wire.client)),
                      .holder = AgentId(Text(wire.holder)),
                      .photo = Text(wire.photo),
                      .offset = wire.offset,
                      .kept = wire.kept != 0,
                      .refusal = Text(wire.refusal)};
}

Message Copy(Topic topic, const void* sample) {
  switch (topic) {
    case Topic::kRoutes:
      return From(*static_cast<const trailcast_wire_RouteAnnouncement*>(sample));
    case Topic::kSegments:
      return From(*static_cast<const trailcast_wire_SegmentBatch*>(sample));
    case Topic::kSegmentRequests:
      return From(*static_cast<const trailcast_wire_SegmentRequest*>(sample));
    case Topic::kReceipts:
      return From(*static_cast<const trailcast_wire_Receipt*>(sample));
    case Topic::kCatalogRequests:
      return From(*static_cast<const trailcast_wire_CatalogRequest*>(sample));
    case Topic::kCatalogReplies:
      return From(*static_cast<const trailcast_wire_CatalogReply*>(sample));
    case Topic::kRouteEdits:
      return From(*static_cast<const trailcast_wire_RouteEditRequest*>(sample));
    case Topic::kFleet:
      return From(*static_cast<const trailcast_wire_Fleet*>(sample));
    case Topic::kNeighbours:
      return From(*static_cast<const trailcast_wire_RouteFollowers*>(sample));
    case Topic::kNow:
      return From(*static_cast<const trailcast_wire_NowCommand*>(sample));
    case Topic::kNowAnswers:
      return From(*static_cast<const trailcast_wire_NowAnswer*>(sample));
    case Topic::kMissions:
      return From(*static_cast<const trailcast_wire_Mission*>(sample));
    case Topic::kMissionStates:
      return From(*static_cast<const trailcast_wire_MissionReport*>(sample));
    case Topic::kMissionRequests:
      return From(*static_cast<const trailcast_wire_MissionRequest*>(sample));
    case Topic::kMissionReplies:
      return From(*static_cast<const trailcast_wire_MissionReply*>(sample));
    case Topic::kDrives:
      return From(*static_cast<const trailcast_wire_DriveCommand*>(sample));
    case Topic::kSnapshotRequests:
      return From(*static_cast<const trailcast_wire_SnapshotRequest*>(sample));
    case Topic::kSnapshots:
      return From(*static_cast<const trailcast_wire_Snapshot*>(sample));
    case Topic::kNetworkEdits:
      return From(*static_cast<const trailcast_wire_NetworkEdit*>(sample));
    case Topic::kNetworkRequests:
      return From(*static_cast<const trailcast_wire_NetworkRequest*>(sample));
    case Topic::kNetworkReplies:
      return From(*static_cast<const trailcast_wire_NetworkReply*>(sample));
    case Topic::kFollowed:
      return From(*static_cast<const trailcast_wire_FollowedSections*>(sample));
    case Topic::kReachRequests:
      return From(*static_cast<const trailcast_wire_ReachRequest*>(sample));
    case Topic::kReachReports:
      return From(*static_cast<const trailcast_wire_ReachReport*>(sample));
    case Topic::kStores:
      return From(*static_cast<const trailcast_wire_StoreSummary*>(sample));
    case Topic::kPhotos:
      return From(*static_cast<const trailcast_wire_PhotoPiece*>(sample));
    case Topic::kPhotoRequests:
      return From(*static_cast<const trailcast_wire_PhotoRequest*>(sample));
    case Topic::kAgents:
      break;
  }
  return From(*static_cast<const trailcast_wire_AgentStatus*>(sample));
}

}  // namespace

Result<Message> FromWire(Topic topic, const void* sample) {
  Message message = Copy(topic, sample);
  if (auto ok = CheckBounds(message); !ok) return tl::unexpected(ok.error());
  return message;
}

Result<AgentGone> GoneFromWire(const void* sample) {
  const auto& wire = *static_cast<const trailcast_wire_AgentStatus*>(sample);
  const AgentGone gone{.agent = AgentId(Text(wire.agent)), .instance = wire.instance};
  if (auto ok = CheckBounds(gone); !ok) return tl::unexpected(ok.error());
  return gone;
}

}  // namespace trailcast::dds
