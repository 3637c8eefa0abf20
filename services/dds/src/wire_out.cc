#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

#include "services/dds/src/wire.h"
#include "trailcast.h"

namespace trailcast::dds {
namespace {

using namespace exchange;  // every message type is used here
using route::RouteInfo;
using route::RouteKey;

// The C types have no const, but dds_write only reads.
char* Lend(const std::string& text) { return const_cast<char*>(text.c_str()); }

template <typename Sequence, typename Element>
void Lend(std::vector<Element>& elements, Sequence& sequence) {
  sequence._buffer = elements.data();
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(elements.size());
  sequence._release = false;
}

template <typename Sequence>
void LendBytes(const std::vector<std::uint8_t>& bytes, Sequence& sequence) {
  sequence._buffer = const_cast<std::uint8_t*>(bytes.data());
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(bytes.size());
}

// Keeps the arrays of texts that a sample points to until it was written.
class TextArrays {
 public:
  template <typename Sequence>
  void Lend(const std::vector<std::string>& texts, Sequence& sequence) {
    std::vector<char*>& pointers = arrays_.emplace_back();
    for (const std::string& text : texts) pointers.push_back(dds::Lend(text));
    dds::Lend(pointers, sequence);
  }

 private:
  std::deque<std::vector<char*>> arrays_;
};

std::uint32_t Milliseconds32(std::chrono::milliseconds span) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(span.count(), 0, kMost));
}

std::vector<std::uint32_t> Values(const std::vector<SegmentIndex>& indices) {
  std::vector<std::uint32_t> values;
  values.reserve(indices.size());
  for (const SegmentIndex index : indices) values.push_back(index.value());
  return values;
}

trailcast_wire_RouteKey ToWire(const RouteKey& key) {
  return {.route = Lend(key.route.value()), .teaching = key.teaching.value()};
}

trailcast_wire_RoutePlace ToWire(const std::optional<route::Place>& place) {
  if (!place) return {};
  return {.frame = static_cast<std::uint8_t>(place->frame), .x = place->x, .y = place->y};
}

trailcast_wire_RouteInfo ToWire(const RouteInfo& info, TextArrays& arrays) {
  trailcast_wire_RouteInfo wire{};
  wire.name = Lend(info.name);
  wire.scout = Lend(info.scout.value());
  wire.camera = Lend(info.camera);
  wire.image_width_px = static_cast<std::uint32_t>(info.image_width_px);
  wire.image_height_px = static_cast<std::uint32_t>(info.image_height_px);
  wire.taught_unix_ms = info.taught_unix_ms;
  wire.state = static_cast<std::uint8_t>(info.state);
  wire.segment_count = info.segment_count;
  wire.length_m = info.length_m;
  wire.bytes = info.bytes;
  std::copy(info.manifest_digest.begin(), info.manifest_digest.end(), wire.manifest_digest);
  arrays.Lend(info.tags, wire.tags);
  wire.place = ToWire(info.place);
  wire.description = Lend(info.description);
  wire.standing = static_cast<std::uint8_t>(info.standing);
  wire.to_review = info.to_review ? 1 : 0;
  wire.cut_off = info.cut_off ? 1 : 0;
  wire.revision = info.revision.value();
  wire.edition = info.edition;
  wire.refreshes = info.refreshes.value();
  return wire;
}

std::vector<trailcast_wire_ViewFeature> ToWire(const route::View& view) {
  const auto subpixels = [](float px) {
    constexpr float kSubpixels = 16.0F;
    return static_cast<std::int32_t>(std::lround(kSubpixels * px));
  };
  std::vector<trailcast_wire_ViewFeature> features;
  features.reserve(view.size());
  std::int32_t size = 0;
  for (const route::ViewFeature& feature : view) {
    if (!route::IsDescribed(feature.descriptor)) continue;
    if (subpixels(feature.size_px) != size) {
      size = subpixels(feature.size_px);
      features.push_back({{}, size, 0});
    }
    trailcast_wire_ViewFeature& wire = features.emplace_back();
    std::copy(feature.descriptor.begin(), feature.descriptor.end(), wire.descriptor);
    wire.u_sixteenth_px = subpixels(feature.u_px);
    wire.v_sixteenth_px = subpixels(feature.v_px);
  }
  return features;
}

trailcast_wire_CatalogQuery ToWire(const route::RouteQuery& query, TextArrays& arrays) {
  trailcast_wire_CatalogQuery wire{};
  wire.name = Lend(query.name);
  wire.name_prefix = Lend(query.name_prefix);
  arrays.Lend(query.tags, wire.tags);
  wire.scout = Lend(query.scout);
  wire.camera_prefix = Lend(query.camera_prefix);
  wire.min_length_m = query.min_length_m;
  wire.max_length_m = query.max_length_m;
  wire.taught_from_unix_ms = query.taught_from_unix_ms;
  wire.taught_until_unix_ms = query.taught_until_unix_ms;
  wire.state = query.state ? static_cast<std::uint8_t>(static_cast<int>(*query.state) + 1) : 0;
  wire.standing =
      query.standing ? static_cast<std::uint8_t>(static_cast<int>(*query.standing) + 1) : 0;
  if (query.near) {
    wire.near = ToWire(query.near->middle);
    wire.radius_m = query.near->radius_m;
  }
  wire.order = static_cast<std::uint8_t>(query.order);
  wire.page_size = query.page_size;
  wire.cursor = Lend(query.cursor);
  return wire;
}

Result<void> With(const RouteAnnouncement& message, const UseSample& use) {
  TextArrays arrays;
  const trailcast_wire_RouteAnnouncement sample{.holder = Lend(message.holder.value()),
                                                .key = ToWire(message.info.key),
                                                .info = ToWire(message.info, arrays)};
  return use(&sample);
}

Result<void> With(const SegmentBatch& message, const UseSample& use) {
  std::vector<trailcast_wire_SegmentPiece> pieces;
  for (const route::SegmentPiece& piece : message.pieces) {
    trailcast_wire_SegmentPiece wire{};
    wire.key = ToWire(piece.key);
    wire.index = piece.index.value();
    std::copy(piece.digest.begin(), piece.digest.end(), wire.digest);
    wire.bytes._buffer = const_cast<std::uint8_t*>(piece.bytes.data());
    wire.bytes._length = wire.bytes._maximum = static_cast<std::uint32_t>(piece.bytes.size());
    pieces.push_back(wire);
  }
  trailcast_wire_SegmentBatch sample{};
  sample.sender = Lend(message.sender.value());
  Lend(pieces, sample.pieces);
  return use(&sample);
}

Result<void> With(const SegmentRequest& message, const UseSample& use) {
  std::vector<std::uint32_t> lacking = Values(message.lacking);
  trailcast_wire_SegmentRequest sample{};
  sample.requester = Lend(message.requester.value());
  sample.key = ToWire(message.key);
  Lend(lacking, sample.lacking);
  sample.digests_only = message.digests_only ? 1 : 0;
  return use(&sample);
}

Result<void> With(const Receipt& message, const UseSample& use) {
  std::vector<trailcast_wire_NamedSegment> beyond;
  beyond.reserve(message.durable_beyond.size());
  for (const NamedSegment& segment : message.durable_beyond) {
    trailcast_wire_NamedSegment& wire = beyond.emplace_back();
    wire.index = segment.index.value();
    std::copy(segment.digest.begin(), segment.digest.end(), wire.digest);
  }
  trailcast_wire_Receipt sample{};
  sample.server = Lend(message.server.value());
  sample.key = ToWire(message.key);
  sample.durable_prefix = message.durable_prefix;
  std::copy(message.prefix_digest.begin(), message.prefix_digest.end(), sample.prefix_digest);
  Lend(beyond, sample.durable_beyond);
  sample.durable_state = static_cast<std::uint8_t>(message.durable_state);
  sample.revision = message.revision.value();
  sample.standing = static_cast<std::uint8_t>(message.standing);
  sample.followed = message.followed.value();
  sample.refusal = static_cast<std::uint8_t>(message.refusal);
  sample.reason = Lend(message.reason);
  return use(&sample);
}

Result<void> With(const CatalogRequest& message, const UseSample& use) {
  TextArrays arrays;
  std::vector<trailcast_wire_ViewFeature> view = ToWire(message.query.view);
  trailcast_wire_CatalogRequest sample{.client = Lend(message.client.value()),
                                       .request = message.request,
                                       .query = ToWire(message.query, arrays)};
  Lend(view, sample.query.view);
  return use(&sample);
}

Result<void> With(const CatalogReply& message, const UseSample& use) {
  TextArrays arrays;
  std::vector<trailcast_wire_CatalogRoute> routes;
  for (const RouteInfo& info : message.page.routes) {
    routes.push_back({.key = ToWire(info.key), .info = ToWire(info, arrays)});
  }
  trailcast_wire_CatalogReply sample{};
  sample.server = Lend(message.server.value());
  sample.client = Lend(message.client.value());
  sample.request = message.request;
  Lend(routes, sample.routes);
  sample.total = message.page.total;
  sample.next = Lend(message.page.next);
  arrays.Lend(message.similar_names, sample.similar_names);
  sample.error = Lend(message.error);
  std::vector<trailcast_wire_FoundPlace> places;
  for (const route::FoundPlace& place : message.places) {
    places.push_back({ToWire(place.key), place.segment.value(), place.score});
  }
  Lend(places, sample.places);
  std::vector<trailcast_wire_Holding> holdings;
  for (const Holding& holding : message.holdings) {
    holdings.push_back({.key = ToWire(holding.key), .agent = Lend(holding.agent.value())});
  }
  Lend(holdings, sample.holdings);
  std::vector<trailcast_wire_LackingSegments> lacking;
  for (const LackingSegments& one : message.lacking) {
    lacking.push_back({.key = ToWire(one.key), .segments = one.segments});
  }
  Lend(lacking, sample.lacking);
  sample.coverage = {message.coverage.segments_indexed, message.coverage.segments_stored,
                     message.coverage.routes_unseen};
  return use(&sample);
}

Result<void> With(const AgentStatus& message, const UseSample& use) {
  trailcast_wire_AgentStatus sample{};
  sample.agent = Lend(message.agent.value());
  sample.instance = message.instance;
  sample.role = static_cast<std::uint8_t>(message.role);
  sample.mode = static_cast<std::uint8_t>(message.mode);
  sample.route = Lend(message.route);
  sample.segment = message.segment;
  sample.segments = message.segments;
  sample.progress = message.progress;
  sample.speed_mps = message.speed_mps;
  sample.features = message.features;
  sample.found_share = message.found_share;
  sample.backlog = message.backlog;
  sample.detail = Lend(message.detail);
  std::vector<trailcast_wire_RouteKey> held;
  for (const RouteKey& key : message.held) held.push_back(ToWire(key));
  Lend(held, sample.held);
  const PlaceOnRoute place = message.place.value_or(PlaceOnRoute{});
  sample.on = ToWire(place.key);
  sample.along_m = place.along_m;
  sample.left_m = place.left_m;
  sample.left_sigma_m = place.left_sigma_m;
  sample.hold = static_cast<std::uint8_t>(message.hold);
  sample.on_duty = static_cast<std::uint8_t>(message.on_duty ? 1 : 0);
  sample.battery_percent = message.battery_percent.value_or(kUnknownPercent);
  sample.link_percent = message.link_percent.value_or(kUnknownPercent);
  sample.software = Lend(message.software);
  sample.carried_by = kDoesNotFollow;
  sample.odometry_percent = kUnknownPercent;
  if (message.following) {
    sample.carried_by = static_cast<std::uint8_t>(message.following->carried_by);
  }
  if (message.following && message.following->odometry) {
    sample.odometry_percent = message.following->odometry->percent;
    sample.odometry_scale = message.following->odometry->scale;
  }
  return use(&sample);
}

Result<void> With(const RouteEditRequest& message, const UseSample& use) {
  TextArrays arrays;
  trailcast_wire_RouteEditRequest sample{};
  sample.client = Lend(message.client.value());
  sample.request = message.request;
  sample.action = static_cast<std::uint8_t>(message.edit.action);
  sample.route = Lend(message.edit.route);
  sample.revision = message.edit.revision;
  sample.text = Lend(message.edit.text);
  arrays.Lend(message.edit.tags, sample.tags);
  return use(&sample);
}

Result<void> With(const Fleet& message, const UseSample& use) {
  std::vector<trailcast_wire_ClaimedName> claimed;
  for (const ClaimedName& name : message.claimed) {
    claimed.push_back({Lend(name.agent.value()), name.claims, name.keeps});
  }
  trailcast_wire_Fleet sample{};
  sample.server = Lend(message.server.value());
  sample.agents = message.agents;
  Lend(claimed, sample.claimed);
  return use(&sample);
}

Result<void> With(const RouteFollowers& message, const UseSample& use) {
  std::vector<trailcast_wire_RouteFollower> followers;
  followers.reserve(message.followers.size());
  for (const RouteFollower& one : message.followers) {
    followers.push_back({.agent = Lend(one.agent.value()),
                         .along_m = one.along_m,
                         .speed_mps = one.speed_mps,
                         .heard = static_cast<std::uint8_t>(one.heard ? 1 : 0),
                         .age_ms = static_cast<std::uint32_t>(one.age.count())});
  }
  trailcast_wire_RouteFollowers sample{};
  sample.server = Lend(message.server.value());
  sample.key = ToWire(message.key);
  Lend(followers, sample.followers);
  return use(&sample);
}

trailcast_wire_NowCommand ToWire(const NowCommand& message) {
  return {.client = Lend(message.client.value()),
          .number = message.number,
          .order = static_cast<std::uint8_t>(message.order),
          .whom = static_cast<std::uint8_t>(message.whom),
          .name = Lend(message.name),
          .reason = Lend(message.reason),
          .relayed = static_cast<std::uint8_t>(message.relayed ? 1 : 0)};
}

trailcast_wire_NowAnswer ToWire(const NowAnswer& message) {
  return {.agent = Lend(message.agent.value()),
          .client = Lend(message.client.value()),
          .number = message.number,
          .refused = static_cast<std::uint8_t>(message.refused ? 1 : 0),
          .detail = Lend(message.detail),
          .relayed = static_cast<std::uint8_t>(message.relayed ? 1 : 0)};
}

Result<void> With(const NowCommand& message, const UseSample& use) {
  const trailcast_wire_NowCommand sample = ToWire(message);
  return use(&sample);
}

Result<void> With(const NowAnswer& message, const UseSample& use) {
  const trailcast_wire_NowAnswer sample = ToWire(message);
  return use(&sample);
}

trailcast_wire_Mission ToWire(const mission::Mission& message) {
  return {.agent = Lend(message.agent.value()),
          .id = Lend(message.id),
          .client = Lend(message.client.value()),
          .orders = Lend(message.orders),
          .valid_for_s = message.valid_for_s,
          .goes_on = static_cast<std::uint8_t>(message.goes_on ? 1 : 0),
          .relayed = static_cast<std::uint8_t>(message.relayed ? 1 : 0)};
}

trailcast_wire_MissionReport ToWire(const mission::Report& message) {
  return {.agent = Lend(message.agent.value()),
          .id = Lend(message.mission),
          .change = message.change,
          .state = static_cast<std::uint8_t>(message.state),
          .task = message.task,
          .way = message.way,
          .waits_for = static_cast<std::uint8_t>(message.waits_for),
          .detail = Lend(message.detail),
          .relayed = static_cast<std::uint8_t>(message.relayed ? 1 : 0)};
}

Result<void> With(const mission::Mission& message, const UseSample& use) {
  const trailcast_wire_Mission sample = ToWire(message);
  return use(&sample);
}

Result<void> With(const mission::Report& message, const UseSample& use) {
  const trailcast_wire_MissionReport sample = ToWire(message);
  return use(&sample);
}

Result<void> With(const MissionRequest& message, const UseSample& use) {
  const mission::Query& query = message.query;
  const trailcast_wire_MissionRequest sample{
      .client = Lend(message.client.value()),
      .request = message.request,
      .commands = static_cast<std::uint8_t>(message.commands ? 1 : 0),
      .query = {.agent = Lend(query.agent),
                .route = Lend(query.route),
                .id = Lend(query.id),
                .client = Lend(query.client),
                .states = query.states,
                .from_unix_ms = query.from_unix_ms,
                .until_unix_ms = query.until_unix_ms,
                .page_size = query.page_size,
                .before = query.before}};
  return use(&sample);
}

Result<void> With(const MissionReply& message, const UseSample& use) {
  std::vector<trailcast_wire_MissionRecord> missions;
  for (const mission::Record& record : message.missions) {
    missions.push_back({.sent = ToWire(record.mission),
                        .last = ToWire(record.last),
                        .sent_unix_ms = record.sent_unix_ms,
                        .changed_unix_ms = record.changed_unix_ms});
  }
  std::vector<std::vector<trailcast_wire_NowAnswer>> answers;
  std::vector<trailcast_wire_GivenCommand> commands;
  for (const mission::GivenCommand& given : message.commands) {
    std::vector<trailcast_wire_NowAnswer>& of_this = answers.emplace_back();
    for (const NowAnswer& answer : given.answers) of_this.push_back(ToWire(answer));
    trailcast_wire_GivenCommand& wire = commands.emplace_back();
    wire.given = ToWire(given.command);
    Lend(of_this, wire.answers);
    wire.given_unix_ms = given.given_unix_ms;
  }
  TextArrays arrays;
  trailcast_wire_MissionReply sample{};
  sample.server = Lend(message.server.value());
  sample.client = Lend(message.client.value());
  sample.request = message.request;
  Lend(missions, sample.missions);
  Lend(commands, sample.commands);
  arrays.Lend(message.robots, sample.robots);
  sample.next = message.next;
  sample.error = Lend(message.error);
  return use(&sample);
}

Result<void> With(const DriveCommand& message, const UseSample& use) {
  const trailcast_wire_DriveCommand sample{.agent = Lend(message.agent.value()),
                                           .client = Lend(message.client.value()),
                                           .linear_mps = message.linear_mps,
                                           .turn_radps = message.turn_radps,
                                           .sent_ms = message.sent_ms};
  return use(&sample);
}

Result<void> With(const SnapshotRequest& message, const UseSample& use) {
  const trailcast_wire_SnapshotRequest sample{.agent = Lend(message.agent.value()),
                                              .client = Lend(message.client.value()),
                                              .request = message.request};
  return use(&sample);
}

Result<void> With(const Snapshot& message, const UseSample& use) {
  trailcast_wire_Snapshot sample{};
  sample.agent = Lend(message.agent.value());
  sample.client = Lend(message.client.value());
  sample.request = message.request;
  LendBytes(message.picture, sample.picture);
  sample.marked = message.marked ? 1 : 0;
  sample.detail = Lend(message.detail);
  return use(&sample);
}

Result<void> With(const NetworkEdit& message, const UseSample& use) {
  const trailcast_wire_NetworkEdit sample{.client = Lend(message.client.value()),
                                          .request = message.request,
                                          .words = Lend(message.words)};
  return use(&sample);
}

Result<void> With(const NetworkRequest& message, const UseSample& use) {
  const trailcast_wire_NetworkRequest sample{.client = Lend(message.client.value()),
                                             .request = message.request,
                                             .words = Lend(message.words),
                                             .first = message.first};
  return use(&sample);
}

Result<void> With(const NetworkReply& message, const UseSample& use) {
  TextArrays arrays;
  trailcast_wire_NetworkReply sample{};
  sample.server = Lend(message.server.value());
  sample.client = Lend(message.client.value());
  sample.request = message.request;
  arrays.Lend(message.lines, sample.lines);
  sample.next = message.next;
  sample.error = Lend(message.error);
  return use(&sample);
}

Result<void> With(const FollowedSections& message, const UseSample& use) {
  std::vector<trailcast_wire_FollowedSection> sections;
  sections.reserve(message.sections.size());
  for (const FollowedSections::Section& each : message.sections) {
    sections.push_back({.number = each.number, .passed = each.passed, .lost = each.lost});
  }
  trailcast_wire_FollowedSections sample{};
  sample.agent = Lend(message.agent.value());
  sample.on = ToWire(message.key);
  Lend(sections, sample.sections);
  return use(&sample);
}

Result<void> With(const ReachRequest& message, const UseSample& use) {
  const trailcast_wire_ReachRequest sample{
      .client = Lend(message.client.value()),
      .request = message.request,
      .relayed = static_cast<std::uint8_t>(message.relayed ? 1 : 0),
      .server = Lend(message.server.value())};
  return use(&sample);
}

Result<void> With(const ReachReport& message, const UseSample& use) {
  std::vector<trailcast_wire_HeardAgent> heard;
  heard.reserve(message.heard.size());
  for (const HeardAgent& each : message.heard) {
    heard.push_back({.agent = Lend(each.agent.value()),
                     .role = static_cast<std::uint8_t>(each.role),
                     .heard_for_ms = Milliseconds32(each.heard_for),
                     .age_ms = Milliseconds32(each.age),
                     .late_ms = each.late_ms,
                     .round_trip_ms = each.round_trip_ms.value_or(-1.0),
                     .address = Lend(each.address),
                     .network = Lend(each.network)});
  }
  trailcast_wire_ReachReport sample{};
  sample.agent = Lend(message.agent.value());
  sample.client = Lend(message.client.value());
  sample.request = message.request;
  sample.server = Lend(message.server.value());
  sample.role = static_cast<std::uint8_t>(message.role);
  sample.star = message.star ? 1 : 0;
  Lend(heard, sample.heard);
  sample.before = message.before;
  sample.relayed = message.relayed ? 1 : 0;
  return use(&sample);
}

Result<void> With(const PhotoPiece& message, const UseSample& use) {
  trailcast_wire_PhotoPiece sample{};
  sample.holder = Lend(message.holder.value());
  sample.client = Lend(message.client.value());
  sample.photo = Lend(message.photo);
  sample.words = Lend(message.words);
  sample.offset = message.offset;
  LendBytes(message.bytes, sample.bytes);
  sample.error = Lend(message.error);
  return use(&sample);
}

Result<void> With(const PhotoRequest& message, const UseSample& use) {
  const trailcast_wire_PhotoRequest sample{.client = Lend(message.client.value()),
                                           .holder = Lend(message.holder.value()),
                                           .photo = Lend(message.photo),
                                           .offset = message.offset,
                                           .kept = static_cast<std::uint8_t>(message.kept ? 1 : 0),
                                           .refusal = Lend(message.refusal)};
  return use(&sample);
}

Result<void> With(const StoreSummary& message, const UseSample& use) {
  std::vector<trailcast_wire_StoreEntry> entries;
  entries.reserve(message.entries.size());
  for (const StoreSummary::Entry& entry : message.entries) {
    entries.push_back({.of = ToWire(entry.key), .digest = entry.digest});
  }
  std::vector<std::uint64_t> parts = message.parts;
  trailcast_wire_StoreSummary sample{};
  sample.server = Lend(message.server.value());
  sample.prefix = Lend(message.prefix);
  Lend(parts, sample.parts);
  Lend(entries, sample.entries);
  return use(&sample);
}

Result<void> With(const AgentGone& message, const UseSample&) {
  return Fail(ErrorCode::kInvalidArgument, "AgentGone of {} is no sample of any topic",
              message.agent.value());
}

}  // namespace

const dds_topic_descriptor_t& TypeOf(Topic topic) {
  static constexpr const dds_topic_descriptor_t* kTypes[] = {&trailcast_wire_RouteAnnouncement_desc,
                                                             &trailcast_wire_SegmentBatch_desc,
                                                             &trailcast_wire_SegmentRequest_desc,
                                                             &trailcast_wire_Receipt_desc,
                                                             &trailcast_wire_CatalogRequest_desc,
                                                             &trailcast_wire_CatalogReply_desc,
                                                             &trailcast_wire_AgentStatus_desc,
                                                             &trailcast_wire_RouteEditRequest_desc,
                                                             &trailcast_wire_Fleet_desc,
                                                             &trailcast_wire_RouteFollowers_desc,
                                                             &trailcast_wire_NowCommand_desc,
                                                             &trailcast_wire_NowAnswer_desc,
                                                             &trailcast_wire_Mission_desc,
                                                             &trailcast_wire_MissionReport_desc,
                                                             &trailcast_wire_MissionRequest_desc,
                                                             &trailcast_wire_MissionReply_desc,
                                                             &trailcast_wire_DriveCommand_desc,
                                                             &trailcast_wire_SnapshotRequest_desc,
                                                             &trailcast_wire_Snapshot_desc,
                                                             &trailcast_wire_NetworkEdit_desc,
                                                             &trailcast_wire_NetworkRequest_desc,
                                                             &trailcast_wire_NetworkReply_desc,
                                                             &trailcast_wire_FollowedSections_desc,
                                                             &trailcast_wire_ReachRequest_desc,
                                                             &trailcast_wire_ReachReport_desc,
                                                             &trailcast_wire_StoreSummary_desc,
                                                             &trailcast_wire_PhotoPiece_desc,
                                                             &trailcast_wire_PhotoRequest_desc};
  return *kTypes[static_cast<std::size_t>(topic)];
}

Result<void> WithWire(const Message& message, const UseSample& use) {
  return std::visit([&](const auto& value) { return With(value, use); }, message);
}

}  // namespace trailcast::dds
