#include "services/exchange/bounds.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "services/exchange/text.h"

namespace trailcast::exchange {
namespace {

using route::RouteInfo;
using route::RouteKey;
using route::SegmentPiece;

Result<void> CheckName(const char* field, const std::string& name) {
  if (IsValidName(name)) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "{} \"{}\" is not a name: 1 to 64 of letters, digits, '_', '.', '-'", field,
              PlainText(name, 80));
}

Result<void> CheckText(const char* field, const std::string& text, std::size_t max_bytes) {
  if (IsPlainText(text, max_bytes)) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "{} is not one line of UTF-8 of at most {} bytes without control characters", field,
              max_bytes);
}

Result<void> CheckCount(const char* field, std::uint64_t count, std::uint64_t max) {
  if (count <= max) return {};
  return Fail(ErrorCode::kInvalidArgument, "{} is {}, at most {} is accepted", field, count, max);
}

Result<void> CheckAmount(const char* field, double value, double max) {
  if (value >= 0.0 && value <= max) return {};  // false for NaN
  return Fail(ErrorCode::kInvalidArgument, "{} is {}, expected 0 to {}", field, value, max);
}

Result<void> CheckIndices(const char* field, const std::vector<SegmentIndex>& indices,
                          std::size_t max) {
  if (auto ok = CheckCount(field, indices.size(), max); !ok) return ok;
  for (const SegmentIndex index : indices) {
    if (auto ok = CheckCount(field, index.value(), kMaxSegmentsPerRoute - 1); !ok) return ok;
  }
  return {};
}

Result<void> CheckState(route::RouteState state) {
  return CheckCount("route state", static_cast<std::uint8_t>(state),
                    static_cast<std::uint8_t>(route::RouteState::kComplete));
}

Result<void> CheckStanding(route::Standing standing) {
  return CheckCount("standing", static_cast<std::uint8_t>(standing),
                    static_cast<std::uint8_t>(route::Standing::kDeleted));
}

Result<void> CheckKey(const RouteKey& key) {
  const std::string& id = key.route.value();
  const bool hex = std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
  });
  if (id.size() != 32 || !hex) {
    return Fail(ErrorCode::kInvalidArgument,
                "route id \"{}\" is not 32 lower-case hexadecimal digits", PlainText(id, 80));
  }
  if (key.revision.value() == 0) {
    return Fail(ErrorCode::kInvalidArgument, "revision of route {} is 0, they start at 1", id);
  }
  return {};
}

Result<void> CheckTags(const std::vector<std::string>& tags) {
  if (auto ok = CheckCount("tags", tags.size(), route::kMaxTags); !ok) return ok;
  for (const std::string& tag : tags) {
    if (auto ok = CheckName("tag", tag); !ok) return ok;
  }
  return {};
}

Result<void> CheckOrdered(const std::vector<std::string>& tags) {
  if (std::adjacent_find(tags.begin(), tags.end(), std::greater_equal<>()) == tags.end()) return {};
  return Fail(ErrorCode::kInvalidArgument, "tags are not sorted, or one is there twice");
}

Result<void> CheckInfo(const RouteInfo& info) {
  constexpr double kMaxLength_m = 1e7;
  if (auto ok = CheckKey(info.key); !ok) return ok;
  if (auto ok = CheckName("route name", info.name); !ok) return ok;
  if (auto ok = CheckName("scout", info.scout.value()); !ok) return ok;
  if (auto ok = CheckText("camera", info.camera, kMaxCameraBytes); !ok) return ok;
  if (auto ok = CheckAmount("image width", info.image_width_px, kMaxImageSide_px); !ok) return ok;
  if (auto ok = CheckAmount("image height", info.image_height_px, kMaxImageSide_px); !ok) {
    return ok;
  }
  if (auto ok = CheckState(info.state); !ok) return ok;
  if (auto ok = CheckCount("segment count", info.segment_count, kMaxSegmentsPerRoute); !ok) {
    return ok;
  }
  if (auto ok = CheckStanding(info.standing); !ok) return ok;
  if (auto ok = CheckText("description", info.description, route::kMaxDescriptionBytes); !ok)
    return ok;
  if (auto ok = CheckCount("bytes in a route", info.bytes, kMaxRouteBytes); !ok) return ok;
  if (auto ok = CheckTags(info.tags); !ok) return ok;
  if (auto ok = CheckOrdered(info.tags); !ok) return ok;
  if (info.place) {
    if (auto ok = CheckPlace(*info.place); !ok) return ok;
  }
  return CheckAmount("route length in metres", info.length_m, kMaxLength_m);
}

Result<void> CheckPiece(const SegmentPiece& piece) {
  if (auto ok = CheckKey(piece.key); !ok) return ok;
  if (auto ok = CheckCount("segment index", piece.index.value(), kMaxSegmentsPerRoute - 1); !ok) {
    return ok;
  }
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
  if (auto ok = CheckCount("durable prefix", message.durable_prefix, kMaxSegmentsPerRoute); !ok) {
    return ok;
  }
  if (auto ok = CheckCount("refusal", static_cast<std::uint8_t>(message.refusal),
                           static_cast<std::uint8_t>(Refusal::kDeleted));
      !ok) {
    return ok;
  }
  if (auto ok = CheckText("reason", message.reason, kMaxLineBytes); !ok) return ok;
  return CheckIndices("durable segments", message.durable_beyond, kMaxIndicesPerReceipt);
}

Result<void> Check(const CatalogRequest& message) {
  // The query is for the server to judge: whoever asked wrongly is told so in the reply.
  return CheckName("client", message.client.value());
}

Result<void> Check(const RouteEditRequest& message) {
  return CheckName("client", message.client.value());
}

Result<void> CheckPlaces(const std::vector<route::FoundPlace>& places) {
  if (auto ok = CheckCount("places in a reply", places.size(), kMaxPlacesPerReply); !ok) return ok;
  for (const route::FoundPlace& place : places) {
    if (auto ok = CheckKey(place.key); !ok) return ok;
    if (auto ok = CheckCount("segment index", place.segment.value(), kMaxSegmentsPerRoute - 1);
        !ok) {
      return ok;
    }
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
  return CheckText("error", message.error, kMaxLineBytes);
}

Result<void> Check(const AgentStatus& message) {
  constexpr double kMaxSpeed_mps = 1000.0;
  if (auto ok = CheckName("agent", message.agent.value()); !ok) return ok;
  if (!message.route.empty()) {
    if (auto ok = CheckName("route name", message.route); !ok) return ok;
  }
  if (auto ok = CheckCount("agent role", static_cast<std::uint8_t>(message.role),
                           static_cast<std::uint8_t>(AgentRole::kOperator));
      !ok) {
    return ok;
  }
  if (auto ok = CheckCount("agent mode", static_cast<std::uint8_t>(message.mode),
                           static_cast<std::uint8_t>(AgentMode::kFault));
      !ok) {
    return ok;
  }
  if (auto ok = CheckAmount("progress", message.progress, 1.0); !ok) return ok;
  if (auto ok = CheckAmount("found share", message.found_share, 1.0); !ok) return ok;
  if (auto ok =
          CheckAmount("speed, forward or backward", std::abs(message.speed_mps), kMaxSpeed_mps);
      !ok) {
    return ok;
  }
  if (auto ok = CheckCount("revisions held", message.held.size(), kMaxHeldTold); !ok) return ok;
  for (const RouteKey& key : message.held) {
    if (auto ok = CheckKey(key); !ok) return ok;
  }
  return CheckText("detail", message.detail, kMaxLineBytes);
}

// A view is asked for alone.
Result<void> CheckAlone(const route::RouteQuery& query) {
  for (const auto& [field, asked] : {std::pair{"name", !query.name.empty()},
                                     {"name prefix", !query.name_prefix.empty()},
                                     {"tags", !query.tags.empty()},
                                     {"scout", !query.scout.empty()},
                                     {"camera prefix", !query.camera_prefix.empty()},
                                     {"least length", query.min_length_m != 0.0},
                                     {"largest length", query.max_length_m != 0.0},
                                     {"taught from", query.taught_from_unix_ms != 0},
                                     {"taught until", query.taught_until_unix_ms != 0},
                                     {"state", query.state.has_value()},
                                     {"standing", query.standing.has_value()},
                                     {"near", query.near.has_value()},
                                     {"order", query.order != route::RouteOrder::kNewest},
                                     {"cursor", !query.cursor.empty()}}) {
    if (!asked) continue;
    return Fail(ErrorCode::kInvalidArgument, "{} is given together with a view: leave it out",
                field);
  }
  return {};
}

Result<void> CheckView(const route::View& view) {
  if (auto ok = CheckCount("features in a view", view.size(), route::kMaxViewFeatures); !ok) {
    return ok;
  }
  for (const route::ViewFeature& feature : view) {
    if (auto ok = CheckAmount("u in a view, to either side, in pixels", std::abs(feature.u_px),
                              kMaxImageSide_px);
        !ok) {
      return ok;
    }
    if (auto ok = CheckAmount("v in a view, to either side, in pixels", std::abs(feature.v_px),
                              kMaxImageSide_px);
        !ok) {
      return ok;
    }
  }
  return {};
}

Result<void> Check(const AgentGone& message) { return CheckName("agent", message.agent.value()); }

}  // namespace

Result<void> CheckPlace(const route::Place& place) {
  constexpr double kMaxSite_m = 1e7;
  const bool globe = place.frame == route::Place::Frame::kWgs84;
  if (!globe && place.frame != route::Place::Frame::kSite) {
    return Fail(ErrorCode::kInvalidArgument, "place frame is {}, expected 1 (site) or 2 (WGS 84)",
                static_cast<int>(place.frame));
  }
  if (auto ok = CheckAmount(globe ? "longitude, east or west, in degrees" : "site x in metres",
                            std::abs(place.x), globe ? 180.0 : kMaxSite_m);
      !ok) {
    return ok;
  }
  return CheckAmount(globe ? "latitude, north or south, in degrees" : "site y in metres",
                     std::abs(place.y), globe ? 90.0 : kMaxSite_m);
}

Result<void> CheckQuery(const route::RouteQuery& query) {
  constexpr double kMaxMetres = 1e7;
  for (const auto& [field, name] : {std::pair{"name", &query.name},
                                    {"name prefix", &query.name_prefix},
                                    {"scout", &query.scout}}) {
    if (name->empty()) continue;
    if (auto ok = CheckName(field, *name); !ok) return ok;
  }
  if (auto ok = CheckTags(query.tags); !ok) return ok;
  if (auto ok = CheckText("camera prefix", query.camera_prefix, kMaxCameraBytes); !ok) return ok;
  if (auto ok = CheckAmount("least length in metres", query.min_length_m, kMaxMetres); !ok) {
    return ok;
  }
  if (auto ok = CheckAmount("largest length in metres", query.max_length_m, kMaxMetres); !ok) {
    return ok;
  }
  if (query.state) {
    if (auto ok = CheckState(*query.state); !ok) return ok;
  }
  if (query.standing) {
    if (auto ok = CheckStanding(*query.standing); !ok) return ok;
  }
  if (query.near) {
    if (auto ok = CheckPlace(query.near->middle); !ok) return ok;
    if (!(query.near->radius_m > 0.0) || query.near->radius_m > kMaxMetres) {
      return Fail(ErrorCode::kInvalidArgument, "radius in metres is {}, expected above 0, to {}",
                  query.near->radius_m, kMaxMetres);
    }
  }
  if (auto ok = CheckCount("order", static_cast<std::uint8_t>(query.order),
                           static_cast<std::uint8_t>(route::RouteOrder::kShortest));
      !ok) {
    return ok;
  }
  if (auto ok = CheckText("cursor", query.cursor, kMaxCursorBytes); !ok) return ok;
  if (query.view.empty()) return {};
  if (auto ok = CheckView(query.view); !ok) return ok;
  return CheckAlone(query);
}

Result<void> CheckEdit(const route::RouteEdit& edit) {
  using route::EditAction;
  if (auto ok = CheckCount("action", static_cast<std::uint8_t>(edit.action),
                           static_cast<std::uint8_t>(EditAction::kDelete));
      !ok) {
    return ok;
  }
  if (auto ok = CheckName("route", edit.route); !ok) return ok;
  if (auto ok = CheckTags(edit.tags); !ok) return ok;
  if (edit.action == EditAction::kRename) return CheckName("new name", edit.text);
  return CheckText("description", edit.text, route::kMaxDescriptionBytes);
}

Result<void> CheckBounds(const Message& message) {
  return std::visit([](const auto& value) { return Check(value); }, message);
}

}  // namespace trailcast::exchange
