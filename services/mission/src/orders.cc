#include "services/mission/orders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "services/base/angles.h"
#include "services/base/ids.h"
#include "services/base/number.h"
#include "services/base/text.h"
#include "services/mission/mission.h"
#include "services/route/bounds.h"

namespace trailcast::mission {
namespace {

constexpr const char* kGrammar =
    "'follow ROUTE[@REVISION] [backwards] [FROM..TO] [laps N] [speed F]', 'teach ROUTE [TAG "
    "...]', 'turn DEGREES' or 'wait SECONDS', one after the other, and before the first of them "
    "'photo [every METRES] [at PLACE ...]'";
constexpr const char* kWay =
    "after 'goto PLACE [way N]' 'follow ROUTE FROM..TO' alone, and 'turn DEGREES' before one";
constexpr const char* kQueued = "queued";
constexpr const char* kAdmitted = "admitted";
constexpr std::size_t kLongestPlace = 96;
constexpr std::uint32_t kMostWays = 1'000'000'000;
constexpr std::uint32_t kMostLaps = 10'000;
constexpr double kMostTurn_deg = 360.0;
constexpr double kLongestWait_s = 7.0 * 24.0 * 3600.0;
constexpr double kLeastSpeed = 0.1;
constexpr double kMostSpeed = 3.0;
constexpr double kLeastPhotoEvery_m = 0.2;
constexpr std::string_view kPhoto = "photo";

std::string RefText(const route::RouteRef& route) {
  return route.revision > 0 ? fmt::format("{}@{}", route.route, route.revision) : route.route;
}

bool BeginsAnOrder(const std::string& word) {
  return word == "follow" || word == "wait" || word == "teach" || word == "turn";
}

class Parser {
 public:
  explicit Parser(std::string_view orders) : words_(WordsIn(orders)) {}

  [[nodiscard]] Result<std::vector<Task>> All() {
    if (Next() == "goto") {
      if (auto taken = Goto(); !taken) return tl::unexpected(taken.error());
    }
    if (Next() == kPhoto) {
      if (auto taken = Photos(); !taken) return tl::unexpected(taken.error());
    }
    if (going_) going_->photos = photos_;
    std::vector<Task> tasks;
    while (!rest().empty() && !TakeReason()) {
      auto task = Next() == "wait"    ? Wait()
                  : Next() == "teach" ? Teach()
                  : Next() == "turn"  ? Turn()
                                      : Follow();
      if (!task) return tl::unexpected(task.error());
      if (auto fits = CheckOnWay(*task, tasks); !fits) return tl::unexpected(fits.error());
      tasks.push_back(*std::move(task));
    }
    if (tasks.empty()) return Fail(ErrorCode::kInvalidArgument, "no orders: say {}", kGrammar);
    return tasks;
  }
  // This is valid after All.
  [[nodiscard]] const std::optional<Going>& going() const { return going_; }
  [[nodiscard]] const PhotoWish& photos() const { return photos_; }

 private:
  [[nodiscard]] Result<void> Goto() {
    (void)Take();
    going_.emplace().to = Take();
    if (going_->to.empty() || going_->to.size() > kLongestPlace) {
      return Wrong(going_->to, "a place to go to");
    }
    if (Next() != "way") return {};
    (void)Take();
    const std::string word = Take();
    const auto way = ParseNumber<std::uint32_t>(word);
    if (!way || *way < 2 || *way > kMostWays) return Wrong(word, "which way it is, 2 or more");
    going_->way = *way;
    if (Next() == kQueued || Next() == kAdmitted) {
      going_->why = Take() == kQueued ? Going::Why::kQueued : Going::Why::kAdmitted;
    }
    return {};
  }

  [[nodiscard]] Result<void> Photos() {
    (void)Take();
    if (Next() == "every") {
      (void)Take();
      const std::string word = Take();
      const auto every_m = ParseNumberWithin(word, kLeastPhotoEvery_m, route::kMaxLength_m);
      if (!every_m) return Wrong(word, "metres from photo to photo, 0.2 or more");
      photos_.every_m = *every_m;
    }
    while (Next() == "at") {
      (void)Take();
      auto place = ParsePhotoPlace(Take());
      if (!place) return tl::unexpected(place.error());
      if (photos_.at.size() == kMostPhotoPlaces) {
        return Wrong(ToText(*place), "16 places for photos at most");
      }
      photos_.at.push_back(*std::move(place));
    }
    return photos_.any() ? Result<void>() : Wrong(Next(), "'every METRES' or 'at PLACE'");
  }

  // Takes the rest of the words as the reason.
  [[nodiscard]] bool TakeReason() {
    if (!going_ || Next() != "because") return false;
    (void)Take();
    going_->because = fmt::format("{}", fmt::join(rest(), " "));
    at_ = words_.size();
    return true;
  }

  // Checks that a path consists of sections, turns and waits, with 'wait way' at most at its end.
  [[nodiscard]] Result<void> CheckOnWay(const Task& task, const std::vector<Task>& before) const {
    if (!going_) return {};
    const bool ends = !before.empty() && before.back().kind == Task::Kind::kWaitWay;
    const bool is_section = task.kind == Task::Kind::kFollow && task.laps == 1 &&
                            (task.backwards ? task.from_m : task.to_m) > 0.0;
    const bool is_turn = task.kind == Task::Kind::kTurn;
    const bool waits = task.kind == Task::Kind::kWaitWay || task.kind == Task::Kind::kWaitLane;
    if (!ends && (is_section || is_turn || waits)) return {};
    return Wrong(ToText(task), kWay);
  }

  [[nodiscard]] std::span<const std::string> rest() const { return std::span(words_).subspan(at_); }
  [[nodiscard]] std::string Next() const { return rest().empty() ? "" : rest().front(); }
  std::string Take() { return rest().empty() ? "" : words_[at_++]; }

  [[nodiscard]] Result<Task> Wait() {
    (void)Take();
    const std::string word = Take();
    if (going_ && word == "way") return Task{.kind = Task::Kind::kWaitWay};
    if (going_ && word == "lane") return Task{.kind = Task::Kind::kWaitLane};
    const auto seconds = ParseNumberWithin(word, 0.0, kLongestWait_s);
    if (!seconds) return Wrong(word, "seconds, a week at most");
    return Task{.kind = Task::Kind::kWait, .wait_s = *seconds};
  }

  [[nodiscard]] Result<Task> Turn() {
    (void)Take();
    const std::string word = Take();
    const auto degrees = ParseNumberWithin(word, -kMostTurn_deg, kMostTurn_deg);
    if (!degrees) return Wrong(word, "degrees to the left, -360 to 360");
    return Task{.kind = Task::Kind::kTurn, .turn_rad = Radians(*degrees)};
  }

  [[nodiscard]] Result<Task> Teach() {
    (void)Take();
    Task task{.kind = Task::Kind::kTeach, .route = {.route = Take()}};
    if (auto named = route::CheckName("route to teach", task.route.route); !named) {
      return tl::unexpected(named.error());
    }
    while (!rest().empty() && !BeginsAnOrder(Next())) {
      if (!IsValidName(Next())) return Wrong(Next(), "a tag, of letters, digits, '_', '.', '-'");
      task.tags.push_back(Take());
    }
    if (auto few = route::CheckTags(task.tags); !few) return Wrap(few.error(), "orders");
    return task;
  }

  [[nodiscard]] Result<Task> Follow() {
    if (const std::string word = Take(); word != "follow") return Wrong(word, kGrammar);
    auto route = route::ParseRouteRef(Take());
    if (!route) return Wrap(route.error(), "orders");
    Task task{.route = *std::move(route)};
    if (Next() == "backwards") {
      (void)Take();
      task.backwards = true;
    }
    while (true) {
      const std::string word = Next();
      Result<void> taken;
      if (word == "laps" && !task.backwards) {
        taken = Laps(task);
      } else if (word == "speed") {
        taken = Speed(task);
      } else if (word.find("..") != std::string::npos) {
        taken = Part(task);
      } else {
        return task;
      }
      if (!taken) return tl::unexpected(taken.error());
    }
  }

  [[nodiscard]] Result<void> Laps(Task& task) {
    (void)Take();
    const std::string word = Take();
    const auto laps = ParseNumber<std::uint32_t>(word);
    if (!laps || *laps == 0 || *laps > kMostLaps) return Wrong(word, "laps, 1 to 10000");
    task.laps = *laps;
    return {};
  }

  [[nodiscard]] Result<void> Speed(Task& task) {
    (void)Take();
    const std::string word = Take();
    const auto factor = ParseNumberWithin(word, kLeastSpeed, kMostSpeed);
    if (!factor) return Wrong(word, "times the taught speed, 0.1 to 3");
    task.speed_factor = *factor;
    return {};
  }

  [[nodiscard]] Result<void> Part(Task& task) {
    const std::string word = Take();
    const auto part = ParseRange(word, 0.0, route::kMaxLength_m);
    const double from_m = part ? part->from.value_or(0.0) : 0.0;
    const double to_m = part ? part->to.value_or(0.0) : 0.0;
    if (!part || (!task.backwards && to_m > 0.0 && to_m <= from_m)) {
      return Wrong(word, "FROM..TO in metres along the route, as 3..10, 3.. or ..10");
    }
    if (task.backwards && from_m > 0.0 && to_m >= from_m) {
      return Wrong(word, "FROM..TO in metres along the route, backwards, as 10..3, 10.. or ..3");
    }
    task.from_m = from_m;
    task.to_m = to_m;
    return {};
  }

  [[nodiscard]] static tl::unexpected<Error> Wrong(const std::string& word, const char* expected) {
    return Fail(ErrorCode::kInvalidArgument, "orders: '{}' was not understood: expected {}", word,
                expected);
  }

  std::vector<std::string> words_;
  std::size_t at_ = 0;
  std::optional<Going> going_;
  PhotoWish photos_;
};

}  // namespace

Result<std::vector<Task>> ParseOrders(std::string_view orders) { return Parser(orders).All(); }

double TurnBefore(std::span<const Task> tasks, std::size_t task) {
  const bool turns = task > 0 && tasks[task - 1].kind == Task::Kind::kTurn;
  return turns ? tasks[task - 1].turn_rad : 0.0;
}

std::optional<Going> GoingIn(std::string_view orders) {
  Parser parser(orders);
  return parser.All() ? parser.going() : std::nullopt;
}

PhotoWish PhotosIn(std::string_view orders) {
  Parser parser(orders);
  return parser.All() ? parser.photos() : PhotoWish();
}

Result<PhotoPlace> ParsePhotoPlace(std::string_view word) {
  const std::size_t is = word.find('=');
  const std::string_view of = is == std::string_view::npos ? word : word.substr(is + 1);
  const std::size_t at = of.rfind('@');
  PhotoPlace place;
  if (is != std::string_view::npos) place.name = word.substr(0, is);
  const bool named = is == std::string_view::npos || IsValidName(place.name);
  auto route = route::ParseRouteRef(std::string(of.substr(0, at)));
  const auto along_m = at == std::string_view::npos
                           ? std::nullopt
                           : ParseNumberWithin(of.substr(at + 1), 0.0, route::kMaxLength_m);
  if (!named || !route || !along_m) {
    return Fail(ErrorCode::kInvalidArgument,
                "orders: '{}' was not understood: expected a place for a photo, as hall@12.5 or "
                "dock=hall@12.5",
                word);
  }
  place.route = *std::move(route);
  place.along_m = *along_m;
  return place;
}

std::set<std::string> RoutesIn(std::string_view orders) {
  std::set<std::string> routes;
  const auto tasks = ParseOrders(orders);
  if (!tasks) return routes;
  for (const Task& task : *tasks) {
    if (!task.route.route.empty()) routes.insert(task.route.route);
  }
  return routes;
}

std::string ToText(const Task& task) {
  if (task.kind == Task::Kind::kWaitWay) return "wait way";
  if (task.kind == Task::Kind::kWaitLane) return "wait lane";
  if (task.kind == Task::Kind::kWait) return fmt::format("wait {:g}", task.wait_s);
  if (task.kind == Task::Kind::kTurn) {
    return fmt::format("turn {:g}", std::round(10.0 * Degrees(task.turn_rad)) / 10.0);
  }
  if (task.kind == Task::Kind::kTeach) {
    return fmt::format("teach {}{}{}", task.route.route, task.tags.empty() ? "" : " ",
                       fmt::join(task.tags, " "));
  }
  std::string text = "follow " + RefText(task.route);
  if (task.backwards) text += " backwards";
  if (task.from_m > 0.0 || task.to_m > 0.0) {
    const bool from_end = task.backwards && task.from_m == 0.0;
    text += fmt::format(" {}..{}", from_end ? "" : fmt::format("{:g}", task.from_m),
                        task.to_m > 0.0 ? fmt::format("{:g}", task.to_m) : "");
  }
  if (task.laps > 1) text += fmt::format(" laps {}", task.laps);
  if (task.speed_factor != 1.0) text += fmt::format(" speed {:g}", task.speed_factor);
  return text;
}

std::string ToText(std::span<const Task> tasks) {
  std::string text;
  for (const Task& task : tasks) {
    if (!text.empty()) text += ' ';
    text += ToText(task);
  }
  return text;
}

std::string ToText(const Going& going, std::span<const Task> tasks) {
  std::string text = "goto " + going.to;
  if (going.way > 1) text += fmt::format(" way {}", going.way);
  if (going.why == Going::Why::kQueued) text += fmt::format(" {}", kQueued);
  if (going.why == Going::Why::kAdmitted) text += fmt::format(" {}", kAdmitted);
  if (going.photos.any()) text += fmt::format(" {}", ToText(going.photos));
  text += fmt::format(" {}", ToText(tasks));
  if (!going.because.empty()) text += " because " + going.because;
  return text;
}

std::string ToText(const PhotoPlace& place) {
  return fmt::format("{}{}{}@{:g}", place.name, place.name.empty() ? "" : "=", RefText(place.route),
                     place.along_m);
}

std::string ToText(const PhotoWish& wish) {
  std::string text(kPhoto);
  if (wish.every_m > 0.0) text += fmt::format(" every {:g}", wish.every_m);
  for (const PhotoPlace& place : wish.at) text += fmt::format(" at {}", ToText(place));
  return text;
}

const char* ToString(State state) {
  switch (state) {
    case State::kSent:
      return "sent";
    case State::kAccepted:
      return "accepted";
    case State::kRefused:
      return "refused";
    case State::kFetching:
      return "fetching";
    case State::kUnderWay:
      return "under way";
    case State::kPaused:
      return "paused";
    case State::kArrived:
      return "arrived";
    case State::kFailed:
      return "failed";
    case State::kCancelled:
      return "cancelled";
    case State::kExpired:
      return "expired";
    case State::kPutOff:
      return "put off";
  }
  return "unknown";
}

const char* ToString(WaitsFor waits_for) {
  switch (waits_for) {
    case WaitsFor::kNothing:
      return "nothing";
    case WaitsFor::kWay:
      return "path";
    case WaitsFor::kLane:
      return "admission";
    case WaitsFor::kTurn:
      return "turn";
    case WaitsFor::kPlace:
      return "place";
  }
  return "unknown";
}

bool IsNewer(const Report& report, const Report& last) {
  if (report.change != last.change) return report.change > last.change;
  if (report.change != 0 || last.state != State::kSent) return false;
  return report.state != State::kSent || report.waits_for != last.waits_for ||
         report.detail != last.detail;
}

bool HasEnded(State state) {
  switch (state) {
    case State::kRefused:
    case State::kArrived:
    case State::kFailed:
    case State::kCancelled:
    case State::kExpired:
      return true;
    default:
      return false;
  }
}

}  // namespace trailcast::mission
