#include "agent/tool/trial_setup.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "services/sim/load_world.h"

namespace trailcast::tool {
namespace {

struct NamedMethod {
  const char* name;
  agent::ReplayMethod method;
};
constexpr std::array<NamedMethod, 2> kMethods{
    {{"default", agent::ReplayMethod::kDefault}, {"paper", agent::ReplayMethod::kPaper}}};

Result<agent::ReplayMethod> FindMethod(const std::string& name) {
  for (const NamedMethod& each : kMethods) {
    if (name == each.name) return each.method;
  }
  return Fail(ErrorCode::kNotFound, "there is no method '{}'; there are: {}", name,
              fmt::join(MethodNames(), ", "));
}

}  // namespace
}  // namespace trailcast::tool
