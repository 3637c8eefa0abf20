#include "services/mission/address.h"

#include <algorithm>

#include "services/base/ids.h"

namespace trailcast::mission {
namespace {

constexpr char kGroup = '@';

}  // namespace

std::string GroupOf(std::string_view robot) {
  const std::size_t digits = robot.find_last_not_of("0123456789") + 1;
  if (digits == robot.size()) return std::string(robot);
  std::string_view group = robot.substr(0, digits);
  if (!group.empty() && std::string_view("-_.").find(group.back()) != std::string_view::npos) {
    group.remove_suffix(1);
  }
  return std::string(group.empty() ? robot : group);
}

bool IsGroup(std::string_view address) { return address.starts_with(kGroup); }

bool Means(std::string_view address, std::string_view robot) {
  return IsGroup(address) ? GroupOf(robot) == address.substr(1) : address == robot;
}

Result<std::vector<std::string>> ParseAddress(std::string_view text) {
  std::vector<std::string> all;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    std::string each(text.substr(0, comma));
    if (!IsValidName(IsGroup(each) ? each.substr(1) : each)) {
      return Fail(
          ErrorCode::kInvalidArgument,
          "'{}' is no robot: expected a name of 1 to 64 letters, digits, '_', '.' and '-', "
          "'@' and the name of a group, as '@cart' for a free one of cart-1, cart-2, .., or "
          "several with commas between them",
          each);
    }
    if (std::find(all.begin(), all.end(), each) != all.end()) {
      return Fail(ErrorCode::kInvalidArgument, "'{}' is there twice", each);
    }
    all.push_back(std::move(each));
    if (all.size() > kMostAddressed) {
      return Fail(ErrorCode::kInvalidArgument, "one mission is for {} robots at most",
                  kMostAddressed);
    }
    if (comma == text.size()) break;
    text.remove_prefix(comma + 1);
  }
  for (const std::string& group : all) {
    for (const std::string& robot : all) {
      if (!IsGroup(group) || IsGroup(robot) || !Means(group, robot)) continue;
      return Fail(ErrorCode::kInvalidArgument, "'{}' is one of '{}': name one of them", robot,
                  group);
    }
  }
  return all;
}

}  // namespace trailcast::mission
