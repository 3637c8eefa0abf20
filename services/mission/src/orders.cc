#include "services/mission/orders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "services/base/ids.h"
#include "services/base/number.h"
#include "services/mission/mission.h"
#include "services/route/bounds.h"

namespace trailcast::mission {
namespace {

constexpr const char* kGrammar =
    "'follow ROUTE[@REVISION] [FROM..TO] [laps N] [speed F]', 'teach ROUTE [TAG ...]' or 'wait "
    "SECONDS', one after the other";
constexpr std::uint32_t kMostLaps = 10'000;
constexpr double kLongestWait_s = 7.0 * 24.0 * 3600.0;
constexpr double kLeastSpeed = 0.1;
constexpr double kMostSpeed = 3.0;

std::vector<std::string> Words(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(' ', at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

bool BeginsAnOrder(const std::string& word) {
  return word == "follow" || word == "wait" || word == "teach";
}

class Parser {
 public:
  explicit Parser(std::string_view orders) : words_(Words(orders)) {}

  [[nodiscard]] Result<std::vector<Task>> All() {
    std::vector<Task> tasks;
    while (!rest().empty()) {
      auto task = Next() == "wait" ? Wait() : Next() == "teach" ? Teach() : Follow();
      if (!task) return tl::unexpected(task.error());
      tasks.push_back(*std::move(task));
    }
    if (tasks.empty()) return Fail(ErrorCode::kInvalidArgument, "no orders: say {}", kGrammar);
    return tasks;
  }

 private:
  [[nodiscard]] std::span<const std::string> rest() const { return std::span(words_).subspan(at_); }
  [[nodiscard]] std::string Next() const { return rest().empty() ? "" : rest().front(); }
  std::string Take() { return rest().empty() ? "" : words_[at_++]; }

  [[nodiscard]] Result<Task> Wait() {
    (void)Take();
    const std::string word = Take();
    const auto seconds = ParseNumberWithin(word, 0.0, kLongestWait_s);
    if (!seconds) return Wrong(word, "seconds, a week at most");
    return Task{.kind = Task::Kind::kWait, .wait_s = *seconds};
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
    while (true) {
      const std::string word = Next();
      Result<void> taken;
      if (word == "laps") {
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
    if (!part || (to_m > 0.0 && to_m <= from_m)) {
      return Wrong(word, "FROM..TO in metres along the route, as 3..10, 3.. or ..10");
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
};

}  // namespace

Result<std::vector<Task>> ParseOrders(std::string_view orders) { return Parser(orders).All(); }

std::set<std::string> RoutesIn(std::string_view orders) {
  std::set<std::string> routes;
  const auto tasks = ParseOrders(orders);
  if (!tasks) return routes;
  for (const Task& task : *tasks) {
    if (task.kind != Task::Kind::kWait) routes.insert(task.route.route);
  }
  return routes;
}

std::string ToText(const Task& task) {
  if (task.kind == Task::Kind::kWait) return fmt::format("wait {:g}", task.wait_s);
  if (task.kind == Task::Kind::kTeach) {
    return fmt::format("teach {}{}{}", task.route.route, task.tags.empty() ? "" : " ",
                       fmt::join(task.tags, " "));
  }
  std::string text = "follow " + task.route.route;
  if (task.route.revision > 0) text += fmt::format("@{}", task.route.revision);
  if (task.from_m > 0.0 || task.to_m > 0.0) {
    text += task.to_m > 0.0 ? fmt::format(" {:g}..{:g}", task.from_m, task.to_m)
                            : fmt::format(" {:g}..", task.from_m);
  }
  if (task.laps > 1) text += fmt::format(" laps {}", task.laps);
  if (task.speed_factor != 1.0) text += fmt::format(" speed {:g}", task.speed_factor);
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
  }
  return "unknown";
}

bool IsNewer(const Report& report, const Report& last) {
  if (report.change != last.change) return report.change > last.change;
  return report.change == 0 && last.state == State::kSent && report.state != State::kSent;
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
