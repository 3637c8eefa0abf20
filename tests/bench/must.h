#pragma once

#include <cstdlib>
#include <iostream>
#include <utility>

#include "services/base/result.h"

namespace trailcast::bench {

// What there is nothing to measure without.
template <typename Value>
Value Must(Result<Value> result) {
  if (result) return std::move(*result);
  std::cerr << result.error().message << '\n';
  std::abort();
}

}  // namespace trailcast::bench
