#include "route_server/metrics.h"

#include <fmt/format.h>

namespace trailcast::server {
namespace {

std::string Line(const char* name, const char* type, const char* help, std::uint64_t value) {
  return fmt::format("# HELP trailcast_{0} {2}\n# TYPE trailcast_{0} {1}\ntrailcast_{0} {3}\n",
                     name, type, help, value);
}

}  // namespace

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
  std::string text =
      Line("routes", kGauge, "Routes in the store, all revisions.", routes) +
      Line("agents", kGauge, "Agents present: the server's DDS peers.", agents) +
      Line("store_reachable", kGauge, "1 while the store can be read and written, else 0.",
           store_reachable ? 1 : 0) +
      Line("routes_partial", kGauge, "Complete routes of which segments are lacking or damaged.",
           partial_routes) +
      Line("segments_lacking", kGauge, "Segments of these that are asked for.", lacking_segments) +
      Line("backlog_segments", kGauge, "Segments announced and not durable yet.", backlog) +
      Line("segments_stored_total", kCounter, "Segments made durable.", keeper.appended) +
      Line("segment_bytes_stored_total", kCounter, "Bytes of these.", keeper.appended_bytes) +
      Line("segments_sent_total", kCounter, "Segments sent to whoever asked.", keeper.answered) +
      Line("segment_bytes_sent_total", kCounter, "Bytes of these.", keeper.answered_bytes) +
      Line("receipts_total", kCounter, "Receipts sent.", keeper.receipts) +
      Line("segments_duplicate_total", kCounter, "Segments received again.", keeper.duplicates) +
      Line("segments_corrupt_total", kCounter, "Segments that failed their digest.",
           keeper.corrupt) +
      Line("conflicts_total", kCounter, "Segments and announcements that contradict what is held.",
           keeper.conflicting) +
      Line("store_failures_total", kCounter, "Writes and reads that the store refused.",
           keeper.store_failures) +
      Line("segments_damaged_total", kCounter, "Segments found damaged in the store.",
           keeper.damaged) +
      Line("segments_repaired_total", kCounter, "Damaged segments replaced by what a holder had.",
           keeper.repaired) +
      Line("requests_refused_total", kCounter,
           "Requests of the catalog and edits that were refused, as too many waited.",
           requests_refused) +
      Line("over_quota_segments_total", kCounter, "Segments not taken, or not sent, for a quota.",
           over_quota.segments) +
      Line("over_quota_routes_total", kCounter, "Announcements of new routes beyond a quota.",
           over_quota.routes) +
      Line("over_quota_requests_total", kCounter, "Requests refused for a quota.",
           over_quota.requests) +
      Line("segments_stray_dropped_total", kCounter,
           "Stored segments dropped because nobody announced their teaching for a day.",
           dropped_strays) +
      Line("messages_dropped_total", kCounter, "Messages out of bounds or unreadable.", dropped);
  constexpr const char* kQueries = "trailcast_catalog_query_seconds";
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
