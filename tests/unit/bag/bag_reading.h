#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "services/bag/bag.h"
#include "services/bag/compression.h"

namespace trailcast::bag {

inline std::unique_ptr<Bag> OpenBag(const std::filesystem::path& file) {
  auto bag = Bag::Open(file, [](const std::string&) {});
  EXPECT_TRUE(bag) << bag.error().message;
  return bag ? std::move(*bag) : nullptr;
}

inline std::string ErrorOf(const std::filesystem::path& file) {
  const auto bag = Bag::Open(file, [](const std::string&) {});
  return bag ? "no error" : bag.error().message;
}

struct Read {
  std::chrono::nanoseconds logged_at{};
  Bytes bytes;
  bool operator==(const Read&) const = default;
};

// Returns all messages of a topic, by its name.
inline std::vector<Read> ReadAll(Bag& bag, const std::string& name) {
  std::vector<Read> all;
  const auto topic = std::find_if(bag.topics().begin(), bag.topics().end(),
                                  [&](const Topic& one) { return one.name == name; });
  if (topic == bag.topics().end()) return all;
  bag.Begin(*topic);
  while (true) {
    const auto message = bag.Next();
    EXPECT_TRUE(message) << message.error().message;
    if (!message || !*message) return all;
    all.push_back({(*message)->logged_at, {(*message)->bytes.begin(), (*message)->bytes.end()}});
  }
}

}  // namespace trailcast::bag
