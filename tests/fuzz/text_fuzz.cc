// Text that strangers send and that is shown on terminals, and what the system says of radios.
#include "services/base/text.h"
#include "services/program/radio.h"
#include "tests/fuzz/fuzz.h"

using trailcast::IsPlainText;
using trailcast::PlainText;
using trailcast::fuzz::Require;
using trailcast::program::LinkPercent;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t max_bytes = data[0];
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  const std::string plain = PlainText(text, max_bytes);
  Require(IsPlainText(plain, max_bytes), "what was made plain is plain");
  Require(!IsPlainText(text, max_bytes) || plain == text, "what is plain stays as it is");
  for (const std::string_view interface : {"", "wlan0"}) {
    Require(LinkPercent(text, interface).value_or(0) <= 100, "a link is 100 % at most");
  }
  return 0;
}
