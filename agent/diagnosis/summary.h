#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// How a run ended, as names and values in order: a line each for people, and key=value lines in a
// file for tools.
class Summary {
 public:
  void Add(std::string key, std::string value);
  // Adds its name, id, revision, segments, metres and bytes.
  void AddRoute(const route::RouteInfo& route);

  [[nodiscard]] const std::string* Find(const std::string& key) const;
  [[nodiscard]] std::string Text() const;
  [[nodiscard]] Result<void> Write(const std::filesystem::path& file) const;

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

}  // namespace trailcast::agent
