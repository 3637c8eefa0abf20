#include "agent/diagnosis/summary.h"

#include <algorithm>

#include "services/base/text_file.h"

namespace trailcast::agent {

void Summary::Add(std::string key, std::string value) {
  std::replace(value.begin(), value.end(), '\n', ' ');
  lines_.emplace_back(std::move(key), std::move(value));
}

void Summary::AddRoute(const route::RouteInfo& route) {
  Add("route", route.name);
  Add("id", route.key.route.value());
  Add("revision", std::to_string(route.revision.value()));
  Add("segments", std::to_string(route.segment_count));
  Add("metres", fmt::format("{:.2f}", route.length_m));
  Add("bytes", std::to_string(route.bytes));
}

const std::string* Summary::Find(const std::string& key) const {
  const auto line = std::find_if(lines_.begin(), lines_.end(),
                                 [&](const auto& entry) { return entry.first == key; });
  return line == lines_.end() ? nullptr : &line->second;
}

std::string Summary::Text() const {
  std::string text;
  for (const auto& [key, value] : lines_) text += fmt::format("{}={}\n", key, value);
  return text;
}

Result<void> Summary::Write(const std::filesystem::path& file) const {
  return WriteTextFile(file, Text());
}

}  // namespace trailcast::agent
