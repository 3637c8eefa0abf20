// This fuzzes route files: the input as it is, and with its size and checksum made right, as an
// attacker would. A file that is accepted is within bounds and complete.
#include "services/archive/route_file.h"
#include "services/archive/src/layout.h"
#include "services/route/bounds.h"
#include "services/route/digest.h"
#include "tests/fuzz/fuzz.h"

namespace trailcast::fuzz {
namespace {

void TakeIn(std::span<const std::uint8_t> bytes) {
  const auto file = archive::RouteFile::Open(bytes);
  if (!file) {
    Require(!file.error().message.empty(), "a refusal has a reason");
    return;
  }
  Require(route::CheckInfo(file->info()).has_value(), "its route could be offered to a server");
  for (std::uint32_t i = 0; i < file->info().segment_count; ++i) {
    Require(file->ReadSegment(SegmentIndex(i)).has_value(), "each of its segments can be read");
  }
}

route::Bytes MadeRight(std::span<const std::uint8_t> input) {
  route::Bytes bytes(input.begin(), input.end());
  if (bytes.size() < archive::kPreambleBytes) return bytes;
  route::Bytes size;
  archive::AppendNumber(size, bytes.size() + archive::kChecksumBytes, 8);
  std::copy(size.begin(), size.end(), bytes.begin() + archive::kFileSizeAt);
  const route::Digest checksum = route::Sha256(bytes);
  bytes.insert(bytes.end(), checksum.begin(), checksum.end());
  return bytes;
}

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast::fuzz;
  const std::span<const std::uint8_t> input(data, size);
  TakeIn(input);
  TakeIn(MadeRight(input));
  return 0;
}
