// These are the bounds of what operators and clients may ask for.
#include <cmath>
#include <utility>

#include "services/exchange/bounds.h"

namespace trailcast::exchange {
namespace {

using route::CheckAmount;
using route::CheckCount;
using route::CheckEnum;
using route::CheckName;
using route::CheckTags;
using route::CheckText;

// A query by view has no other condition.
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
                              route::kMaxImageSide_px);
        !ok) {
      return ok;
    }
    if (auto ok = CheckAmount("v in a view, to either side, in pixels", std::abs(feature.v_px),
                              route::kMaxImageSide_px);
        !ok) {
      return ok;
    }
  }
  return {};
}

}  // namespace

Result<void> CheckQuery(const route::RouteQuery& query) {
  constexpr double kMaxMetres = 1e7;
  for (const auto& [field, name] : {std::pair{"name", &query.name},
                                    {"name prefix", &query.name_prefix},
                                    {"scout", &query.scout}}) {
    if (name->empty()) continue;
    if (auto ok = CheckName(field, *name); !ok) return ok;
  }
  if (auto ok = CheckTags(query.tags); !ok) return ok;
  if (auto ok = CheckText("camera prefix", query.camera_prefix, route::kMaxCameraBytes); !ok)
    return ok;
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
  if (auto ok = CheckEnum("order", query.order, route::RouteOrder::kShortest); !ok) return ok;
  if (auto ok = CheckText("cursor", query.cursor, kMaxCursorBytes); !ok) return ok;
  if (query.view.empty()) return {};
  if (auto ok = CheckView(query.view); !ok) return ok;
  return CheckAlone(query);
}

Result<void> CheckEdit(const route::RouteEdit& edit) {
  using route::EditAction;
  if (auto ok = CheckEnum("action", edit.action, EditAction::kDelete); !ok) return ok;
  if (auto ok = CheckName("route", edit.route); !ok) return ok;
  if (auto ok = CheckTags(edit.tags); !ok) return ok;
  if (edit.action == EditAction::kRename) return CheckName("new name", edit.text);
  return CheckText("description", edit.text, route::kMaxDescriptionBytes);
}

}  // namespace trailcast::exchange
