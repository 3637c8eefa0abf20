#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>

#include "tests/support/temp_dir.h"

// libFuzzer calls this with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace trailcast::fuzz {

// This must hold for any input. libFuzzer keeps the input of a process that aborts.
inline void Require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

// Returns the input as a file, for readers that take a path. The next input replaces it.
inline std::filesystem::path AsFile(std::span<const std::uint8_t> input, const char* name) {
  static const test::TempDir folder;
  std::filesystem::path path = folder / name;
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(input.data()),
               static_cast<std::streamsize>(input.size()));
  stream.close();
  Require(!stream.fail(), "the input was written");
  return path;
}

}  // namespace trailcast::fuzz
