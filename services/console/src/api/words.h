#pragma once

#include <map>
#include <string>

#include "services/base/result.h"

namespace trailcast::console {

// Returns what a word stands for. Fails with kInvalidArgument, which lists all words.
template <typename Value>
[[nodiscard]] Result<Value> ReadWord(const std::map<std::string, Value>& words,
                                     const std::string& text) {
  const auto word = words.find(text);
  if (word != words.end()) return word->second;
  std::string all;
  for (const auto& [name, value] : words) all += (all.empty() ? "" : ", ") + name;
  return Fail(ErrorCode::kInvalidArgument, "is to be one of {}", all);
}

}  // namespace trailcast::console
