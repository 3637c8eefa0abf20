// Words of the network of routes, a line each: understood, told, understood again; and ways over
// what they make.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "services/network/words.h"
#include "tests/fuzz/fuzz.h"

namespace network = trailcast::network;
using trailcast::fuzz::Require;

namespace {

constexpr std::size_t kMostEdits = 200;

const std::vector<network::Route>& Routes() {
  static const std::vector<network::Route> routes{
      {"a", "hall", 20.0}, {"b", "office", 10.0}, {"c", "point", 0.0}};
  return routes;
}

// One of these, whatever was said.
std::string RouteFor(const std::string& name) {
  return Routes()[name.empty() ? 0 : static_cast<unsigned char>(name.back()) % 3].id;
}

struct Made {
  std::vector<network::Junction> junctions;
  std::vector<network::Condition> conditions;
};

bool IsOfACondition(const network::Edit& edit) {
  using Kind = network::Edit::Kind;
  return edit.kind == Kind::kClose || edit.kind == Kind::kOpen || edit.kind == Kind::kLimit;
}

void Take(network::Edit edit, Made& made) {
  if (edit.kind == network::Edit::Kind::kJoin) {
    for (network::Place* place : {&edit.junction.from, &edit.junction.to}) {
      place->route = RouteFor(place->route);
      if (place->along_m > 20.0) place->along_m = std::fmod(place->along_m, 10.0);
    }
    made.junctions.push_back(edit.junction);
  } else if (IsOfACondition(edit)) {
    edit.condition.route = RouteFor(edit.condition.route);
    made.conditions = network::Amended(std::move(made.conditions), edit);
  }
}

void Understand(const std::string& line, Made& made) {
  if (const auto edit = network::ParseEdit(line)) {
    const bool is_told = edit->condition.closed || edit->kind == network::Edit::Kind::kLimit;
    // To the centimetre.
    if (is_told && edit->condition.to_m - edit->condition.from_m > 0.02) {
      const std::string told = network::ToText(edit->condition);
      const auto again = network::ParseEdit(told);
      Require(again.has_value(), "what was told is understood");
      Require(network::ToText(again->condition) == told, "and is told likewise");
    }
    if (edit->kind == network::Edit::Kind::kName) {
      const std::string told = network::ToText(edit->named);
      const auto again = network::ParseEdit(told);
      Require(again && network::ToText(again->named) == told, "a name is understood again");
    }
    Take(*edit, made);
  }
  (void)network::ParseQuestion(line);
  if (const auto proposal = network::ParseListed(line).proposal) {
    const std::string told = network::ToText(*proposal);
    const auto& junction = proposal->junction;
    // To the centimetre.
    if (network::ToText(junction.from) == network::ToText(junction.to)) return;
    const auto again = network::ParseListed(told).proposal;
    Require(again && network::ToText(*again) == told, "a proposal is understood again");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  Made made;
  std::size_t edits = 0;
  for (std::size_t at = 0; at < text.size() && edits < kMostEdits; ++edits) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    Understand(text.substr(at, end - at), made);
    at = end + 1;
  }
  const auto built = network::Network::Build(Routes(), made.junctions, made.conditions);
  if (!built) return 0;
  for (const network::Route& from : Routes()) {
    for (const network::Route& to : Routes()) {
      const auto way =
          built->ShortestWay({from.id, from.length_m / 3.0}, {to.id, to.length_m / 2.0});
      if (!way) continue;
      Require(way->length_m >= 0.0, "a way is no less than nothing");
      for (const network::Section& section : way->sections) {
        Require(section.from_m < section.to_m && section.speed > 0.0, "a section leads ahead");
      }
    }
  }
  return 0;
}
