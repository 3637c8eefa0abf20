#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace fast_dds {

// Returns what Fast DDS was asked to make, and throws if it made none.
template <typename Pointer>
Pointer Made(Pointer entity, const std::string& what) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS made no " + what);
  return entity;
}

// Returns main()'s exit status: that of `run` with the command line's words, or 1, with a line of
// what it threw.
template <typename Run>
int StatusOf(const Run& run, int argc, char** argv) {
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace fast_dds
