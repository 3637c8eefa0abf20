#include "services/tool/network_picture.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "services/base/number.h"
#include "services/network/words.h"

namespace trailcast::tool {
namespace {

using network::Edit;
using plot::NetworkPicture;

constexpr std::string_view kRoute = "route ";
constexpr std::string_view kUnused = "unused ";

class Reader {
 public:
  void Take(std::string_view line) {
    if (line.starts_with(kRoute)) return TakeRoute(line.substr(kRoute.size()));
    const bool used = !line.starts_with(kUnused);
    if (!used) line.remove_prefix(kUnused.size());
    const auto edit = network::ParseEdit(line);
    if (!edit) return;
    switch (edit->kind) {
      case Edit::Kind::kJoin:
        return TakeJoint(edit->joint, used);
      case Edit::Kind::kName:
        if (const auto at = Find(edit->named.place)) {
          picture_.names.push_back({edit->named.name, *at});
        }
        return;
      default:
        return TakeCondition(edit->condition);
    }
  }

  [[nodiscard]] NetworkPicture picture() && { return std::move(picture_); }

 private:
  void TakeRoute(std::string_view text) {
    const std::size_t blank = std::min(text.rfind(' '), text.size());
    const auto length_m = ParseNumber<double>(text.substr(std::min(blank + 1, text.size())));
    if (!length_m) return;
    const std::string name(text.substr(0, blank));
    if (!numbers_.emplace(name, picture_.routes.size()).second) return;
    picture_.routes.push_back({.name = name, .length_m = *length_m});
  }

  void TakeJoint(const network::Joint& joint, bool used) {
    const auto from = Find(joint.from);
    const auto to = Find(joint.to);
    if (from && to) picture_.joints.push_back({*from, *to, joint.both, used});
  }

  void TakeCondition(const network::Condition& condition) {
    const auto at = numbers_.find(condition.route);
    if (at == numbers_.end()) return;
    NetworkPicture::Route& route = picture_.routes[at->second];
    route.marked.push_back(
        {condition.closed ? NetworkPicture::Part::kClosed : NetworkPicture::Part::kLimited,
         condition.from_m, std::min(condition.to_m, route.length_m)});
  }

  // "hall", or "hall@2" of another revision than is followed.
  [[nodiscard]] std::optional<NetworkPicture::Place> Find(const network::Place& place) const {
    auto at = numbers_.find(place.route);
    if (at == numbers_.end()) at = numbers_.find(place.route.substr(0, place.route.rfind('@')));
    if (at == numbers_.end()) return std::nullopt;
    return NetworkPicture::Place{at->second,
                                 std::min(place.along_m, picture_.routes[at->second].length_m)};
  }

  NetworkPicture picture_;
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

Result<NetworkPicture> PictureOf(const std::vector<std::string>& lines) {
  // Rows by name: servers list routes by their ids, which are drawn at random.
  std::vector<std::string> rows_first = lines;
  const auto others =
      std::stable_partition(rows_first.begin(), rows_first.end(),
                            [](const std::string& line) { return line.starts_with(kRoute); });
  std::sort(rows_first.begin(), others);
  Reader reader;
  for (const std::string& line : rows_first) reader.Take(line);
  NetworkPicture picture = std::move(reader).picture();
  if (picture.routes.empty()) {
    return Fail(ErrorCode::kNotFound, "no routes are joined: there is nothing to draw");
  }
  if (picture.routes.size() > kMostRoutesInPicture) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} routes are joined, {} at most are drawn: --json has them all",
                picture.routes.size(), kMostRoutesInPicture);
  }
  return picture;
}

}  // namespace trailcast::tool
