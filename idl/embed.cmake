# The bytes of the file FROM as C++, in the file TO.
file(READ "${FROM}" bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE "${TO}" "#include \"idl/run_log_description.h\"

#include <cstdint>

namespace trailcast {
namespace {
constexpr std::uint8_t kBytes[] = {${bytes}};
}  // namespace

std::span<const std::uint8_t> RunLogDescription() { return kBytes; }

}  // namespace trailcast
")
