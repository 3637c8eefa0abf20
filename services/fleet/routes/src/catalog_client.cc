#include "services/fleet/routes/catalog_client.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "services/base/hex.h"
#include "services/base/unix_time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/ask.h"
#include "services/fleet/draw.h"
#include "services/program/json.h"
#include "services/route/digest.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::fleet {
namespace {

double BytesPerMeter(const route::RouteInfo& info) {
  return info.length_m > 0.0 ? static_cast<double>(info.bytes) / info.length_m : 0.0;
}

std::vector<std::string> HoldersOf(const route::RouteKey& key,
                                   const exchange::CatalogReply& reply) {
  std::vector<std::string> holders;
  for (const exchange::Holding& holding : reply.holdings) {
    if (holding.key == key) holders.push_back(holding.agent.value());
  }
  return holders;
}

std::uint32_t LackingOf(const route::RouteKey& key, const exchange::CatalogReply& reply) {
  const auto found = std::find_if(reply.lacking.begin(), reply.lacking.end(),
                                  [&](const auto& lacking) { return lacking.key == key; });
  return found == reply.lacking.end() ? 0 : found->segments;
}

std::string Remarks(const route::RouteInfo& info, const exchange::CatalogReply& reply) {
  const std::vector<std::string> holders = HoldersOf(info.key, reply);
  std::string remarks = holders.empty() ? "-" : fmt::format("{}", fmt::join(holders, ", "));
  if (const std::uint32_t lacking = LackingOf(info.key, reply); lacking > 0) {
    remarks += fmt::format("; served in part: {} of {} segments {} lost", lacking,
                           info.segment_count, lacking == 1 ? "is" : "are");
  }
  if (!info.tags.empty()) remarks += fmt::format("; {}", fmt::join(info.tags, " "));
  if (!info.description.empty()) remarks += fmt::format("; \"{}\"", info.description);
  return remarks;
}

program::Json JsonPlace(const std::optional<route::Place>& place) {
  if (!place) return nullptr;
  if (place->frame == route::Place::Frame::kWgs84) {
    return {{"latitude", place->y}, {"longitude", place->x}};
  }
  return {{"site_x_m", place->x}, {"site_y_m", place->y}};
}

}  // namespace

Result<exchange::CatalogReply> AskCatalog(exchange::RouteExchange& exchange, const AgentId& client,
                                          const route::RouteQuery& query,
                                          std::chrono::milliseconds timeout) {
  const std::uint64_t request = DrawNumber();
  return Ask<exchange::CatalogReply>(exchange, client, request,
                                     exchange::CatalogRequest{client, request, query}, timeout);
}

Result<exchange::CatalogReply> AskToEdit(exchange::RouteExchange& exchange, const AgentId& client,
                                         const route::RouteEdit& edit,
                                         std::chrono::milliseconds timeout) {
  const std::uint64_t request = DrawNumber();
  return Ask<exchange::CatalogReply>(exchange, client, request,
                                     exchange::RouteEditRequest{client, request, edit}, timeout);
}

Result<exchange::CatalogReply> AskForRoutes(exchange::RouteExchange& exchange,
                                            const AgentId& client, route::RouteQuery query,
                                            std::size_t limit, std::chrono::milliseconds timeout) {
  std::vector<route::RouteInfo> routes;
  std::vector<exchange::Holding> holdings;
  std::vector<exchange::LackingSegments> lacking;
  while (true) {
    query.page_size = static_cast<std::uint32_t>(
        std::min<std::size_t>(limit - routes.size(), exchange::kMaxRoutesPerReply));
    auto reply = AskCatalog(exchange, client, query, timeout);
    if (!reply) return reply;
    routes.insert(routes.end(), reply->page.routes.begin(), reply->page.routes.end());
    holdings.insert(holdings.end(), reply->holdings.begin(), reply->holdings.end());
    lacking.insert(lacking.end(), reply->lacking.begin(), reply->lacking.end());
    query.cursor = reply->page.next;
    if (query.cursor.empty() || routes.size() >= limit) {
      reply->page.routes = std::move(routes);
      reply->holdings = std::move(holdings);
      reply->lacking = std::move(lacking);
      return reply;
    }
  }
}

std::string RoutesTable(const exchange::CatalogReply& reply, std::int64_t now_unix_ms) {
  const std::vector<route::RouteInfo>& routes = reply.page.routes;
  if (routes.empty()) return "no routes\n";
  const route::ShortIds ids(routes);
  std::size_t name_width = 5;
  std::size_t id_width = 0;
  std::size_t state_width = 8;
  std::size_t scout_width = 5;
  std::size_t camera_width = 6;
  for (const route::RouteInfo& info : routes) {
    name_width = std::max(name_width, info.name.size());
    id_width = std::max(id_width, ids.Of(info).size());
    state_width = std::max(state_width, std::string_view(route::StateText(info)).size());
    scout_width = std::max(scout_width, info.scout.value().size());
    camera_width = std::max(camera_width, info.camera.size());
  }
  std::string text = fmt::format(
      "{:<{}}  {:<{}}  {:<{}}  {:>8}  {:>8}  {:>8}  {:>6}  {:<{}}  {:<{}}  {:>6}  {}\n", "route",
      name_width, "id", id_width, "state", state_width, "segments", "metres", "kB", "B/m", "scout",
      scout_width, "camera", camera_width, "age", "held by; tags, description");
  for (const route::RouteInfo& info : routes) {
    const bool taught_metres = info.length_m > 0.0;  // false without odometry
    text += fmt::format(
        "{:<{}}  {:<{}}  {:<{}}  {:>8}  {:>8}  {:>8.1f}  {:>6}  {:<{}}  {:<{}}  {:>6}  {}\n",
        info.name, name_width, ids.Of(info), id_width, route::StateText(info), state_width,
        info.segment_count, taught_metres ? fmt::format("{:.1f}", info.length_m) : "-",
        static_cast<double>(info.bytes) / 1000.0,
        taught_metres ? fmt::format("{:.0f}", BytesPerMeter(info)) : "-", info.scout.value(),
        scout_width, info.camera, camera_width, Age(now_unix_ms - info.taught_unix_ms),
        Remarks(info, reply));
  }
  return text;
}

program::Json RouteJson(const route::RouteInfo& info) {
  return {{"name", info.name},
          {"route", info.key.route.value()},
          {"revision", info.revision.value()},
          {"state", route::StateText(info)},
          {"segments", info.segment_count},
          {"length_m", program::Rounded(info.length_m, 1000.0)},
          {"bytes", info.bytes},
          {"bytes_per_m", program::Rounded(BytesPerMeter(info), 10.0)},
          {"scout", info.scout.value()},
          {"camera", info.camera},
          {"taught_unix_ms", info.taught_unix_ms},
          {"manifest_sha256", ToHex(info.manifest_digest)},
          {"tags", info.tags},
          {"place", JsonPlace(info.place)},
          {"description", info.description},
          {"edition", info.edition},
          {"teaching", fmt::format("{:x}", info.key.teaching.value())}};
}

program::Json RouteJson(const route::RouteInfo& info, const exchange::CatalogReply& reply) {
  program::Json route = RouteJson(info);
  route["held_by"] = HoldersOf(info.key, reply);
  route["segments_lost"] = LackingOf(info.key, reply);
  return route;
}

program::Json RoutesJson(const exchange::CatalogReply& reply, const RouteStudies& studies) {
  auto routes = program::Json::array();
  for (const route::RouteInfo& info : reply.page.routes) {
    program::Json route = RouteJson(info, reply);
    if (const auto study = studies.find(info.key); study != studies.end()) {
      route["weak"] = WeakPlacesJson(info, study->second);
      route["terrain"] = GroundJson(info, study->second);
    }
    routes.push_back(std::move(route));
  }
  return routes;
}

}  // namespace trailcast::fleet
