#include "services/tool/network_picture.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "services/network/words.h"

namespace trailcast::tool {
namespace {

using network::Edit;
using plot::NetworkPicture;

class Reader {
 public:
  // Takes each route once, before what is on it.
  void TakeRoute(const network::Route& route) {
    numbers_.emplace(route.name, picture_.routes.size());
    picture_.routes.push_back({.name = route.name, .length_m = route.length_m});
  }

  void TakeEdit(const Edit& edit, bool used) {
    switch (edit.kind) {
      case Edit::Kind::kJoin:
        return TakeJunction(edit.junction, used);
      case Edit::Kind::kName:
        if (const auto at = Find(edit.named.place)) {
          picture_.names.push_back({edit.named.name, *at});
        }
        return;
      case Edit::Kind::kNarrow:
        for (const network::Part& part : edit.lane.parts) {
          Mark(part.route, {NetworkPicture::Part::kNarrow, part.from_m, part.to_m});
        }
        return;
      case Edit::Kind::kCharge:
        return;
      default:
        return Mark(edit.condition.route, {edit.condition.closed   ? NetworkPicture::Part::kClosed
                                           : edit.condition.backed ? NetworkPicture::Part::kBacked
                                                                   : NetworkPicture::Part::kLimited,
                                           edit.condition.from_m, edit.condition.to_m});
    }
  }

  void TakeProposal(const network::Proposal& proposal) { TakeJunction(proposal.junction, false); }

  void TakeLost(const network::LostSection& lost) {
    Mark(lost.route, {NetworkPicture::Part::kLost, lost.from_m, lost.to_m});
  }

  [[nodiscard]] NetworkPicture picture() && { return std::move(picture_); }

 private:
  void TakeJunction(const network::Junction& junction, bool used) {
    const auto from = Find(junction.from);
    const auto to = Find(junction.to);
    if (from && to) picture_.junctions.push_back({*from, *to, junction.both, used});
  }

  void Mark(const std::string& name, NetworkPicture::Marked marked) {
    const auto at = numbers_.find(name);
    if (at == numbers_.end()) return;
    NetworkPicture::Route& route = picture_.routes[at->second];
    marked.to_m = std::min(marked.to_m, route.length_m);
    route.marked.push_back(marked);
  }

  // Finds "hall", or "hall@2" if robots follow another revision.
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
  std::vector<network::Listed> listed;
  listed.reserve(lines.size());
  for (const std::string& line : lines) listed.push_back(network::ParseListed(line));
  // Rows are sorted by name, since servers list routes by their random ids.
  std::map<std::string, network::Route> routes;
  for (const network::Listed& each : listed) {
    if (each.route) routes.emplace(each.route->name, *each.route);
  }
  Reader reader;
  for (const auto& [name, route] : routes) reader.TakeRoute(route);
  for (const network::Listed& each : listed) {
    if (each.edit) reader.TakeEdit(*each.edit, each.used);
    if (each.proposal) reader.TakeProposal(*each.proposal);
    if (each.lost) reader.TakeLost(*each.lost);
  }
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
