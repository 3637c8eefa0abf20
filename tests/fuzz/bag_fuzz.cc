// Recorded drives: files of either format, all that is in them. Twice read is twice the same.
#include <algorithm>
#include <string>
#include <vector>

#include "services/bag/bag.h"
#include "services/bag/ros_messages.h"
#include "tests/fuzz/fuzz.h"

namespace trailcast::fuzz {
namespace {

std::size_t CountMessages(bag::Bag& bag, const bag::Topic& topic) {
  bag.Begin(topic);
  std::size_t count = 0;
  while (true) {
    const auto message = bag.Next();
    if (!message || !*message) return count;
    ++count;
    const auto bytes = (*message)->bytes;
    const auto image = bag::ReadImage(bytes);
    Require(!image || image->picture.bytes.size() <= bytes.size(), "a picture is in its message");
  }
}

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast;
  const auto bag = bag::Bag::Open(fuzz::AsFile({data, size}, "drive"), [](const std::string&) {});
  if (!bag) return 0;
  for (const bag::Topic& topic : (*bag)->topics()) {
    const std::size_t once = fuzz::CountMessages(**bag, topic);
    fuzz::Require(fuzz::CountMessages(**bag, topic) == once, "what was read is read again");
  }
  fuzz::Require((*bag)->damage().size() <= bag::Bag::kMostDamage, "damage is bounded");
  return 0;
}
