#include "agent/teach/teachings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "services/base/unix_time.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::agent {
namespace {

constexpr std::size_t kColumns = 8;
using Row = std::array<std::string, kColumns>;

std::string Table(const std::vector<Row>& rows) {
  std::array<std::size_t, kColumns> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < kColumns; ++i)
      widths.at(i) = std::max(widths.at(i), row.at(i).size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i + 1 < kColumns; ++i) {
      text += fmt::format("{:<{}}  ", row.at(i), widths.at(i));
    }
    text += row.back() + "\n";
  }
  return text;
}

bool IsCutOff(const route::RouteInfo& info) {
  return info.standing != route::Standing::kRetired &&
         (info.cut_off || info.state == route::RouteState::kTeaching);
}

}  // namespace

Result<std::string> TeachingsText(store::RouteStore& store, const std::string& store_file) {
  const auto routes = store.ListRoutes();
  if (!routes) return tl::unexpected(routes.error());
  if (routes->empty()) return fmt::format("there is no teaching in {}\n", store_file);
  const route::ShortIds ids(*routes);
  std::vector<Row> rows{
      {"route", "id", "state", "segments", "metres", "not confirmed", "scout", "taught"}};
  bool cut_off = false;
  for (const route::RouteInfo& info : *routes) {
    const auto unconfirmed = store.UnreceiptedSegments(info.key);
    if (!unconfirmed) return tl::unexpected(unconfirmed.error());
    cut_off = cut_off || IsCutOff(info);
    const bool unfinished =
        info.state == route::RouteState::kTeaching && info.standing != route::Standing::kRetired;
    rows.push_back({info.name, ids.Of(info), unfinished ? "unfinished" : route::StateText(info),
                    std::to_string(info.segment_count),
                    info.length_m > 0.0 ? fmt::format("{:.1f}", info.length_m) : "-",
                    std::to_string(unconfirmed->size()), info.scout.value(),
                    DateText(info.taught_unix_ms)});
  }
  std::string text = Table(rows);
  if (cut_off) {
    text += fmt::format(
        "What is unfinished or was cut off, and the newest of its route, its scout goes on with, "
        "keeps "
        "or discards:\n  trailcast-agent teach --route ROUTE --store {} --unfinished "
        "go-on|keep|discard ..\n",
        store_file);
  }
  return text;
}

}  // namespace trailcast::agent
