#include "route_server/status/metrics.h"

#include <fmt/format.h>

#include "services/http/metrics_text.h"

namespace trailcast::server {

void LatencyHistogram::Note(double seconds) {
  for (std::size_t i = 0; i < kBounds_s.size(); ++i) {
    within_[i] += seconds <= kBounds_s[i] ? 1U : 0U;
  }
  ++count_;
  sum_s_ += seconds;
}

std::string LatencyHistogram::Text(const std::string& metric, const std::string& labels) const {
  std::string text;
  for (std::size_t i = 0; i < kBounds_s.size(); ++i) {
    text += fmt::format("{}_bucket{{{},le=\"{}\"}} {}\n", metric, labels, kBounds_s[i], within_[i]);
  }
  text +=
      fmt::format("{0}_bucket{{{1},le=\"+Inf\"}} {2}\n{0}_sum{{{1}}} {3}\n{0}_count{{{1}}} {2}\n",
                  metric, labels, count_, sum_s_);
  return text;
}

const char* KindOf(const route::RouteQuery& query) {
  if (!query.view.empty()) return "view";
  if (!query.name.empty()) return "name";
  if (query.near) return "place";
  return query.tags.empty() ? "other" : "tag";
}

std::string Metrics::Text() const {
  constexpr const char* kCounter = "counter";
  constexpr const char* kGauge = "gauge";
  http::MetricsText lines;
  lines.Add("routes", kGauge, "Routes in the store, all revisions.", routes);
  lines.Add("agents", kGauge, "Agents present: the server's DDS peers.", agents);
  lines.Add("store_reachable", kGauge, "1 while the store can be read and written, else 0.",
            store_reachable ? 1 : 0);
  lines.Add("on_network", kGauge, "1 while the server is on its network, else 0.",
            on_network ? 1 : 0);
  lines.Add("network_joins_total", kCounter,
            "How often it has joined, more than once where the network changed.", network_joins);
  lines.Add("mirror_servers", kGauge, "Other servers, also those that went without a word.",
            mirror.servers);
  lines.Add("mirror_servers_in_step", kGauge, "Of these, those that hold the same routes.",
            mirror.same);
  lines.Add("mirror_routes_under_way", kGauge, "Routes that are asked of them at present.",
            mirror.under_way);
  lines.Add("mirror_routes_asked_total", kCounter,
            "Routes that were asked of other servers since the start.", mirror.asked);
  lines.Add("routes_partial", kGauge, "Complete routes of which segments are lacking or damaged.",
            partial_routes);
  lines.Add("segments_lacking", kGauge, "Segments of these that are asked for.", lacking_segments);
  lines.Add("backlog_segments", kGauge, "Segments announced and not durable yet.", backlog);
  lines.Add("segments_stored_total", kCounter, "Segments made durable.", keeper.appended);
  lines.Add("segment_bytes_stored_total", kCounter, "Bytes of these.", keeper.appended_bytes);
  lines.Add("segments_sent_total", kCounter, "Segments sent to whoever asked.", keeper.answered);
  lines.Add("segment_bytes_sent_total", kCounter, "Bytes of these.", keeper.answered_bytes);
  lines.Add("receipts_total", kCounter, "Receipts sent.", keeper.receipts);
  lines.Add("segments_duplicate_total", kCounter, "Segments received again.", keeper.duplicates);
  lines.Add("segments_corrupt_total", kCounter, "Segments that failed their digest.",
            keeper.corrupt);
  lines.Add("conflicts_total", kCounter, "Segments and announcements that contradict what is held.",
            keeper.conflicting);
  lines.Add("store_failures_total", kCounter, "Writes and reads that the store refused.",
            keeper.store_failures);
  lines.Add("segments_damaged_total", kCounter, "Segments found damaged in the store.",
            keeper.damaged);
  lines.Add("segments_repaired_total", kCounter, "Damaged segments replaced by what a holder had.",
            keeper.repaired);
  lines.Add("requests_refused_total", kCounter,
            "Requests of the catalog and edits that were refused, as too many waited.",
            requests_refused);
  lines.Add("over_quota_segments_total", kCounter, "Segments not taken, or not sent, for a quota.",
            over_quota.segments);
  lines.Add("over_quota_routes_total", kCounter, "Announcements of new routes beyond a quota.",
            over_quota.routes);
  lines.Add("over_quota_requests_total", kCounter, "Requests refused for a quota.",
            over_quota.requests);
  lines.Add("segments_stray_dropped_total", kCounter,
            "Stored segments dropped because nobody announced their teaching for a day.",
            dropped_orphans);
  lines.Add("routes_searched_total", kCounter,
            "Routes for which it was looked where others meet them.", junctions.routes_searched);
  lines.Add("junctions_proposed_total", kCounter, "Junctions found and proposed.",
            junctions.proposed);
  lines.Add("junctions_taken_total", kCounter, "Junctions found and made without asking.",
            junctions.taken);
  lines.Add("junctions_open", kGauge, "Proposed junctions that nobody has confirmed or refused.",
            junctions.open);
  lines.Add("crossings_total", kCounter, "Known routes that scouts were told they cross.",
            junctions.crossings);
  lines.Add("messages_dropped_total", kCounter, "Messages out of bounds or unreadable.", dropped);
  constexpr const char* kQueries = "trailcast_catalog_query_seconds";
  std::string text = lines.text();
  text += fmt::format(
      "# HELP {0} Time to answer a catalog query, by what it asks for.\n"
      "# TYPE {0} histogram\n",
      kQueries);
  for (const auto& [kind, histogram] : queries) {
    text += histogram.Text(kQueries, fmt::format("kind=\"{}\"", kind));
  }
  return text;
}

}  // namespace trailcast::server
