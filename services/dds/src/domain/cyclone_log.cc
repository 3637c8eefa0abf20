#include "services/dds/src/domain/cyclone_log.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdio>
#include <map>
#include <mutex>
#include <utility>

namespace trailcast::dds {
namespace {

constexpr std::size_t kMostLines = 1000;

struct Sink {
  std::mutex mutex;
  std::map<dds_domainid_t, std::vector<std::string>> lines;  // of domains with a listener
};

Sink& TheSink() {
  static Sink sink;
  return sink;
}

void Receive(void* /*argument*/, const dds_log_data_t* data) {
  std::string line(data->message, data->size);
  while (!line.empty() && line.back() == '\n') line.pop_back();
  Sink& sink = TheSink();
  const std::lock_guard lock(sink.mutex);
  // Cyclone's security plug-ins give no domain, or any number. Lines of a domain without a listener
  // go to all listeners.
  const bool addressed = sink.lines.contains(data->domid);
  for (auto& [domain, lines] : sink.lines) {
    if ((domain == data->domid || !addressed) && lines.size() < kMostLines) lines.push_back(line);
  }
  if (sink.lines.empty()) std::fprintf(stderr, "%s\n", line.c_str());
}

}  // namespace

CycloneLog::CycloneLog(dds_domainid_t domain) : domain_(domain) {
  Sink& sink = TheSink();
  {
    const std::lock_guard lock(sink.mutex);
    sink.lines[domain_].clear();
  }
  dds_set_log_sink(&Receive, nullptr);
}

CycloneLog::~CycloneLog() {
  Sink& sink = TheSink();
  const std::lock_guard lock(sink.mutex);
  sink.lines.erase(domain_);
}

std::vector<std::string> CycloneLog::Take() {
  Sink& sink = TheSink();
  const std::lock_guard lock(sink.mutex);
  return std::exchange(sink.lines[domain_], {});
}

std::string CycloneWarnings::Note(const std::string& line, Time now) {
  std::string alike;
  for (const char c : line) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit || alike.empty() || alike.back() != '0') alike += digit ? '0' : c;
  }
  if (!told_.IsDue(alike, now)) {
    if (untold_.size() < ToldLately::kMost || untold_.contains(alike)) ++untold_[alike];
    return "";
  }
  const auto counted = untold_.extract(alike);
  if (counted.empty()) return line;
  return fmt::format("{} (and {} alike since that was last told)", line, counted.mapped());
}

}  // namespace trailcast::dds
