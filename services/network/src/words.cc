#include "services/network/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "services/base/angles.h"
#include "services/base/number.h"

namespace trailcast::network {
namespace {

constexpr double kMostOffset_m = 100.0;
constexpr double kLeastFactor = 0.1;
constexpr double kMostFactor = 1000.0;
constexpr const char* kEdits =
    "'join PLACE PLACE [both] [offset AHEAD,LEFT] [heading DEGREES]', 'part PLACE PLACE', 'close "
    "ROUTE [FROM..TO]', 'open ROUTE [FROM..TO]', 'back ROUTE [FROM..TO]', 'ahead ROUTE "
    "[FROM..TO]', "
    "'limit ROUTE [FROM..TO] [speed F] [cost F]', "
    "'narrow ROUTE FROM..TO [ROUTE FROM..TO ...]', 'wide ROUTE [FROM..TO]', 'vacate ROUTE "
    "[FROM..TO]', "
    "'name NAME PLACE [home] [dock]', 'forget NAME', 'charge below PERCENT [until PERCENT]', "
    "'charge never', 'confirm PLACE PLACE', 'confirm all [above F]', 'refuse PLACE PLACE' or "
    "'refuse all [below F]'";
constexpr std::size_t kLongestName = 64;
constexpr std::string_view kRoute = "route ";
constexpr std::string_view kProposed = "proposed ";
constexpr std::string_view kConfidence = " confidence ";
constexpr std::string_view kLost = "lost ";
constexpr std::string_view kCharging = "charging ";
constexpr std::string_view kHome = "home";  // behind a name: robots are at home there
constexpr std::string_view kDock = "dock";  // likewise: robots charge there

// Writes metres to the centimetre.
std::string Metres(double metres) {
  std::string text = fmt::format("{:.2f}", metres);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

tl::unexpected<Error> Wrong(std::string_view word, std::string_view expected) {
  if (word.empty())
    return Fail(ErrorCode::kInvalidArgument, "the end comes too soon: expected {}", expected);
  return Fail(ErrorCode::kInvalidArgument, "'{}': expected {}", word, expected);
}

class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) { Skip(); }

  [[nodiscard]] bool empty() const { return rest_.empty(); }
  [[nodiscard]] std::string_view Next() const { return rest_.substr(0, rest_.find(' ')); }
  std::string_view Take() {
    const std::string_view word = Next();
    rest_.remove_prefix(word.size());
    Skip();
    return word;
  }
  bool TakeIf(std::string_view word) {
    if (empty() || Next() != word) return false;
    (void)Take();
    return true;
  }

 private:
  void Skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }
  std::string_view rest_;
};

Result<Junction> TakeJunction(Words& words) {
  auto from = ParsePlace(words.Take());
  if (!from) return tl::unexpected(from.error());
  auto to = ParsePlace(words.Take());
  if (!to) return tl::unexpected(to.error());
  if (*from == *to) return Wrong(ToText(*to), "another place than the first");
  return Junction{.from = *std::move(from), .to = *std::move(to)};
}

Result<void> TakeLie(Words& words, Junction& junction) {
  if (words.TakeIf("offset")) {
    const std::string_view word = words.Take();
    const std::size_t comma = std::min(word.find(','), word.size());
    const auto ahead = ParseNumberWithin(word.substr(0, comma), -kMostOffset_m, kMostOffset_m);
    const auto left = comma < word.size()
                          ? ParseNumberWithin(word.substr(comma + 1), -kMostOffset_m, kMostOffset_m)
                          : std::nullopt;
    if (!ahead || !left) return Wrong(word, "AHEAD,LEFT in metres, as 0.1,-0.25");
    if (!junction.lie) junction.lie.emplace();
    junction.lie->ahead_m = *ahead;
    junction.lie->left_m = *left;
  } else if (words.TakeIf("heading")) {
    const std::string_view word = words.Take();
    const auto degrees = ParseNumberWithin(word, -180.0, 180.0);
    if (!degrees) return Wrong(word, "degrees to the left, -180 to 180");
    if (!junction.lie) junction.lie.emplace();
    junction.lie->turn_rad = Radians(*degrees);
  } else {
    return Wrong(words.Next(), "'both', 'offset AHEAD,LEFT', 'heading DEGREES' or nothing more");
  }
  return {};
}

Result<Edit> TakeJoin(Words& words) {
  auto junction = TakeJunction(words);
  if (!junction) return tl::unexpected(junction.error());
  while (!words.empty()) {
    if (words.TakeIf("both")) {
      junction->both = true;
    } else if (auto taken = TakeLie(words, *junction); !taken) {
      return tl::unexpected(taken.error());
    }
  }
  return Edit{.kind = Edit::Kind::kJoin, .junction = *std::move(junction)};
}

Result<Edit> TakeName(Words& words, Edit::Kind kind) {
  const std::string_view name = words.Take();
  auto called = ParseGoal(name);
  if (!called) return tl::unexpected(called.error());
  if (called->name.empty()) return Wrong(name, "what the place is called, without '@'");
  Edit edit{.kind = kind, .named = {.name = std::move(called->name)}};
  if (kind == Edit::Kind::kName) {
    auto place = ParsePlace(words.Take());
    if (!place) return tl::unexpected(place.error());
    edit.named.place = *std::move(place);
    edit.named.home = words.TakeIf(kHome);
    edit.named.dock = words.TakeIf(kDock);
  }
  if (words.empty()) return edit;
  if (kind == Edit::Kind::kForget || edit.named.dock) return Wrong(words.Next(), "nothing more");
  return Wrong(words.Next(),
               edit.named.home ? "'dock' or nothing more" : "'home', 'dock' or nothing more");
}

Result<int> TakePercent(Words& words, int least, int most) {
  const std::string_view word = words.Take();
  const auto percent = ParseNumber<int>(word);
  if (percent && *percent >= least && *percent <= most) return *percent;
  return Wrong(word, fmt::format("per cent of a battery, {} to {}", least, most));
}

// Parses below PERCENT [until PERCENT], or never.
Result<Edit> TakeCharge(Words& words) {
  Edit edit{.kind = Edit::Kind::kCharge};
  if (words.TakeIf("below")) {
    auto below = TakePercent(words, 1, 99);
    if (!below) return tl::unexpected(below.error());
    edit.charge =
        ChargeLimits{.below_percent = *below,
                     .until_percent = std::max(*below + 1, ChargeLimits::kUsualUntil_percent)};
    if (words.TakeIf("until")) {
      auto until = TakePercent(words, *below + 1, 100);
      if (!until) return tl::unexpected(until.error());
      edit.charge->until_percent = *until;
    }
  } else if (!words.TakeIf("never")) {
    return Wrong(words.Next(), "'below PERCENT [until PERCENT]' or 'never'");
  }
  if (!words.empty()) return Wrong(words.Next(), "nothing more");
  return edit;
}

// Parses PLACE PLACE.
Result<Edit> TakePlaces(Words& words, Edit::Kind kind) {
  auto junction = TakeJunction(words);
  if (!junction) return tl::unexpected(junction.error());
  if (!words.empty()) return Wrong(words.Next(), "nothing more");
  return Edit{.kind = kind, .junction = *std::move(junction)};
}

// Parses PLACE PLACE, or "all" with a bound.
Result<Edit> TakeVerdict(Words& words, Edit::Kind kind) {
  if (!words.TakeIf("all")) return TakePlaces(words, kind);
  Edit edit{.kind = kind, .all = Edit::Sure{}};
  if (words.empty()) return edit;
  const bool confirms = kind == Edit::Kind::kConfirm;
  const char* const bound = confirms ? "above" : "below";
  if (!words.TakeIf(bound)) {
    return Wrong(words.Next(), fmt::format("'{} F' or nothing more", bound));
  }
  const std::string_view word = words.Take();
  const auto confidence = ParseNumberWithin(word, 0.0, 1.0);
  if (!confidence) return Wrong(word, "how sure it is, 0 to 1");
  if (!words.empty()) return Wrong(words.Next(), "nothing more");
  (confirms ? edit.all->least : edit.all->most) = *confidence;
  return edit;
}

// Parses ROUTE [FROM..TO].
Result<Condition> TakeSection(Words& words) {
  Condition section{.route = std::string(words.Take()), .to_m = kToTheEnd_m};
  if (section.route.empty()) return Wrong("", "a route, by its name or id");
  const std::string_view word = words.Next();
  if (word.find("..") == std::string_view::npos) return section;
  (void)words.Take();
  const auto part = ParseRange(word, 0.0, kToTheEnd_m);
  if (part) {
    section.from_m = part->from.value_or(0.0);
    section.to_m = part->to.value_or(kToTheEnd_m);
  }
  if (!part || section.to_m <= section.from_m) {
    return Wrong(word, "FROM..TO in metres along the route, as 3..10, 3.. or ..10");
  }
  return section;
}

// Parses ROUTE FROM..TO [ROUTE FROM..TO ...].
Result<Lane> TakeLane(Words& words) {
  Lane lane;
  do {
    auto part = TakeSection(words);
    if (!part) return tl::unexpected(part.error());
    if (part->to_m >= kToTheEnd_m) {
      return Wrong(part->route, "a route and FROM..TO, both in metres along it, as hall 3..7");
    }
    lane.parts.push_back({std::move(part->route), part->from_m, part->to_m});
  } while (!words.empty());
  return lane;
}

Result<void> TakeLimits(Words& words, Condition& limit) {
  while (!words.empty()) {
    const bool is_speed = words.Next() == "speed";
    if (!is_speed && words.Next() != "cost") {
      return Wrong(words.Next(), "'speed F', 'cost F' or nothing more");
    }
    (void)words.Take();
    const std::string_view word = words.Take();
    const auto factor = ParseNumberWithin(word, kLeastFactor, is_speed ? 1.0 : kMostFactor);
    if (!factor) {
      return Wrong(word, is_speed ? "times the taught speed, 0.1 to 1"
                                  : "how many metres one counts as, 0.1 to 1000");
    }
    (is_speed ? limit.speed : limit.cost) = *factor;
  }
  return {};
}

}  // namespace

Result<Edit> ParseEdit(std::string_view text) {
  Words words(text);
  if (words.TakeIf("join")) return TakeJoin(words);
  if (words.TakeIf("part")) return TakePlaces(words, Edit::Kind::kPart);
  if (words.TakeIf("confirm")) return TakeVerdict(words, Edit::Kind::kConfirm);
  if (words.TakeIf("refuse")) return TakeVerdict(words, Edit::Kind::kRefuse);
  if (words.TakeIf("name")) return TakeName(words, Edit::Kind::kName);
  if (words.TakeIf("forget")) return TakeName(words, Edit::Kind::kForget);
  if (words.TakeIf("charge")) return TakeCharge(words);
  if (words.TakeIf("narrow")) {
    auto lane = TakeLane(words);
    if (!lane) return tl::unexpected(lane.error());
    return Edit{.kind = Edit::Kind::kNarrow, .lane = *std::move(lane)};
  }
  const std::string_view first = words.Take();
  Edit edit;
  if (first == "wide") {
    edit.kind = Edit::Kind::kWide;
  } else if (first == "vacate") {
    edit.kind = Edit::Kind::kVacate;
  } else if (first == "close") {
    edit.kind = Edit::Kind::kClose;
  } else if (first == "open") {
    edit.kind = Edit::Kind::kOpen;
  } else if (first == "back") {
    edit.kind = Edit::Kind::kBack;
  } else if (first == "ahead") {
    edit.kind = Edit::Kind::kAhead;
  } else if (first == "limit") {
    edit.kind = Edit::Kind::kLimit;
  } else {
    return Wrong(first, kEdits);
  }
  auto section = TakeSection(words);
  if (!section) return tl::unexpected(section.error());
  edit.condition = *std::move(section);
  edit.condition.closed = edit.kind == Edit::Kind::kClose;
  edit.condition.backed = edit.kind == Edit::Kind::kBack;
  if (edit.kind == Edit::Kind::kLimit) {
    if (auto taken = TakeLimits(words, edit.condition); !taken) {
      return tl::unexpected(taken.error());
    }
  }
  if (!words.empty()) return Wrong(words.Next(), "FROM..TO or nothing more");
  return edit;
}

namespace {

std::optional<Proposal> ParseProposal(std::string_view text) {
  const std::size_t at = text.rfind(kConfidence);
  if (at == std::string_view::npos) return std::nullopt;
  const auto confidence = ParseNumberWithin(text.substr(at + kConfidence.size()), 0.0, 1.0);
  auto edit = ParseEdit(text.substr(0, at));
  if (!confidence || !edit || edit->kind != Edit::Kind::kJoin) return std::nullopt;
  return Proposal{std::move(edit->junction), *confidence};
}

// Parses ROUTE FROM..TO N of M cost F.
std::optional<LostSection> ParseLost(std::string_view text) {
  Words words(text);
  auto section = TakeSection(words);
  const auto lost = ParseNumber<double>(words.Take());
  const bool of = words.TakeIf("of");
  const auto passed = ParseNumber<double>(words.Take());
  const bool costs = words.TakeIf("cost");
  const auto cost = ParseNumberWithin(words.Take(), 1.0, kMostFactor);
  if (!section || !lost || !of || !passed || !costs || !cost || !words.empty()) return std::nullopt;
  return LostSection{
      std::move(section->route), section->from_m, section->to_m, *passed, *lost, *cost};
}

}  // namespace

Listed ParseListed(std::string_view line) {
  Listed listed;
  if (line.starts_with(kRoute)) {
    line.remove_prefix(kRoute.size());
    const std::size_t blank = std::min(line.rfind(' '), line.size());
    const auto length_m = ParseNumber<double>(line.substr(std::min(blank + 1, line.size())));
    if (length_m) {
      listed.route = {.name = std::string(line.substr(0, blank)), .length_m = *length_m};
    }
    return listed;
  }
  if (line.starts_with(kProposed)) {
    listed.proposal = ParseProposal(line.substr(kProposed.size()));
    return listed;
  }
  if (line.starts_with(kLost)) {
    listed.lost = ParseLost(line.substr(kLost.size()));
    return listed;
  }
  if (line.starts_with(kCharging)) {
    line.remove_prefix(kCharging.size());
    const std::size_t blank = line.find(' ');
    if (blank == std::string_view::npos) return listed;
    listed.charging = {std::string(line.substr(0, blank)), std::string(line.substr(blank + 1))};
    return listed;
  }
  listed.used = !line.starts_with(kUnused);
  if (!listed.used) line.remove_prefix(kUnused.size());
  if (const std::size_t at = line.find(kTakenBy); at != std::string_view::npos) {
    Words names(line.substr(at + kTakenBy.size()));
    while (!names.empty()) listed.taken_by.emplace_back(names.Take());
    line = line.substr(0, at);
  }
  if (auto edit = ParseEdit(line)) listed.edit = *std::move(edit);
  return listed;
}

Result<Question> ParseQuestion(std::string_view text) {
  Words words(text);
  if (!words.TakeIf("way")) return Wrong(words.Next(), "'way FROM TO' or 'passing PLACE'");
  auto from = ParseGoal(words.Take());
  if (!from) return tl::unexpected(from.error());
  auto to = ParseGoal(words.Take());
  if (!to) return tl::unexpected(to.error());
  if (!words.empty()) return Wrong(words.Next(), "nothing more");
  return Question{.from = *std::move(from), .to = *std::move(to)};
}

Result<Goal> ParseGoal(std::string_view word) {
  if (word.find('@') == std::string_view::npos) {
    if (word.empty() || word.size() > kLongestName) {
      return Wrong(word, "ROUTE@METRES, as hall@2.5, or a name of up to 64 letters");
    }
    return Goal{.name = std::string(word)};
  }
  auto place = ParsePlace(word);
  if (!place) return tl::unexpected(place.error());
  return Goal{.place = *std::move(place)};
}

Result<Place> ParsePlace(std::string_view word) {
  const std::size_t at = word.rfind('@');
  const auto along_m = at == std::string_view::npos || at == 0
                           ? std::nullopt
                           : ParseNumberWithin(word.substr(at + 1), 0.0, kToTheEnd_m);
  if (!along_m) return Wrong(word, "ROUTE@METRES, as hall@2.5");
  return Place{std::string(word.substr(0, at)), *along_m};
}

std::string ToText(const Place& place) { return place.route + "@" + Metres(place.along_m); }

std::string ToText(const Route& route) {
  return fmt::format("{}{} {:.2f}", kRoute, route.name, route.length_m);
}

std::string ToText(const NamedPlace& named) {
  std::string text = fmt::format("name {} {}", named.name, ToText(named.place));
  for (const auto& [is, kind] : {std::pair(named.home, kHome), std::pair(named.dock, kDock)}) {
    if (is) text += fmt::format(" {}", kind);
  }
  return text;
}

std::string ToText(const std::optional<ChargeLimits>& charge) {
  if (!charge) return "charge never";
  return fmt::format("charge below {} until {}", charge->below_percent, charge->until_percent);
}

std::string ToText(const Charging& charging) {
  return fmt::format("{}{} {}", kCharging, charging.robot, charging.text);
}

std::string ToText(const Junction& junction) {
  std::string text = "join " + ToText(junction.from) + " " + ToText(junction.to);
  if (junction.both) text += " both";
  if (!junction.lie) return text;
  const std::string offset = Metres(junction.lie->ahead_m) + "," + Metres(junction.lie->left_m);
  if (offset != "0,0") text += " offset " + offset;
  return text + fmt::format(" heading {:.1f}", Degrees(junction.lie->turn_rad));
}

std::string ToText(const Condition& condition) {
  const char* const verb = condition.closed ? "close " : condition.backed ? "back " : "limit ";
  std::string text = verb + condition.route;
  const bool to_the_end = condition.to_m >= kToTheEnd_m;
  if (condition.from_m > 0.0 || !to_the_end) {
    text +=
        fmt::format(" {}..{}", Metres(condition.from_m), to_the_end ? "" : Metres(condition.to_m));
  }
  if (condition.speed != 1.0) text += fmt::format(" speed {:g}", condition.speed);
  if (condition.cost != 1.0) text += fmt::format(" cost {:g}", condition.cost);
  return text;
}

std::string ToText(const Lane& lane) {
  std::string text = "narrow";
  for (const Part& part : lane.parts) {
    text += fmt::format(" {} {}..{}", part.route, Metres(part.from_m), Metres(part.to_m));
  }
  return text;
}

namespace {

std::string LostTimes(const LostSection& lost) {
  return fmt::format("{}{} {}..{} {:g} of {:g}", kLost, lost.route, Metres(lost.from_m),
                     Metres(lost.to_m), lost.lost, lost.passed);
}

}  // namespace

std::string ToText(const LostSection& lost) {
  return fmt::format("{} cost {:g}", LostTimes(lost), lost.cost);
}

std::string Describe(const LostSection& lost) {
  return fmt::format("{} times lately, a metre counts as {:g}", LostTimes(lost), lost.cost);
}

std::string ToText(const Proposal& proposal) {
  // The text must not claim more confidence than there is.
  constexpr double kRounding = 1e-6;
  const double confidence = std::floor(100.0 * proposal.confidence + kRounding) / 100.0;
  return fmt::format("{}{}{}{:.2f}", kProposed, ToText(proposal.junction), kConfidence, confidence);
}

std::vector<Condition> Amended(std::vector<Condition> conditions, const Edit& edit) {
  const Condition& now = edit.condition;
  const bool of_backed = edit.kind == Edit::Kind::kBack || edit.kind == Edit::Kind::kAhead;
  const bool of_closed = edit.kind != Edit::Kind::kLimit && !of_backed;
  std::vector<Condition> after;
  for (const Condition& before : conditions) {
    const bool stays = before.route != now.route || before.closed != of_closed ||
                       before.backed != of_backed || before.to_m <= now.from_m ||
                       before.from_m >= now.to_m;
    if (stays) {
      after.push_back(before);
      continue;
    }
    for (const auto& [from_m, to_m] : {std::pair(before.from_m, std::min(before.to_m, now.from_m)),
                                       std::pair(std::max(before.from_m, now.to_m), before.to_m)}) {
      if (!(from_m < to_m)) continue;
      after.push_back(before);
      after.back().from_m = from_m;
      after.back().to_m = to_m;
    }
  }
  if (now.closed || now.backed || now.speed != 1.0 || now.cost != 1.0) after.push_back(now);
  return after;
}

}  // namespace trailcast::network
