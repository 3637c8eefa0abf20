#pragma once

#include <cstdlib>
#include <iostream>
#include <utility>

#include "services/base/result.h"

namespace trailcast::bench {

// Returns a value without which there is nothing to measure.
template <typename Value>
Value Must(Result<Value> result) {
  if (result) return std::move(*result);
  std::cerr << result.error().message << '\n';
  std::abort();
}

}  // namespace trailcast::bench
