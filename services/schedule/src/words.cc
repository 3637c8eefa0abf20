// This reads and writes schedules in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "services/base/ids.h"
#include "services/base/number.h"
#include "services/base/text.h"
#include "services/mission/mission.h"
#include "services/mission/orders.h"
#include "services/schedule/schedule.h"

namespace trailcast::schedule {
namespace {

constexpr std::array<std::string_view, 7> kDays{"mon", "tue", "wed", "thu", "fri", "sat", "sun"};
constexpr std::string_view kGoto = "goto ";
constexpr std::string_view kWaitWay = " wait way";  // its path is found when it is about to begin
constexpr const char* kTimeExpected = "a time from 00:00 to 23:59, as 08:30";
constexpr const char* kDaysExpected = "days, as mon-fri or mon,wed,sat";
constexpr const char* kDateExpected = "a day, as 2026-12-24";
constexpr std::size_t kMostShown = 64;  // bytes of a word that is not understood

std::vector<std::string> Split(std::string_view text, char at) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = std::min(text.find(at), text.size());
    parts.emplace_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

tl::unexpected<Error> NotA(std::string_view word, const std::string& expected) {
  return Fail(ErrorCode::kInvalidArgument, "'{}' in a schedule: expected {}",
              PlainText(word, kMostShown), expected);
}

bool IsRobots(std::string_view word) {
  const bool is_pattern = IsPattern(word);
  return IsValidName(std::string(is_pattern ? word.substr(0, word.size() - 1) : word));
}

// Returns minutes after midnight.
std::optional<int> ReadTime(const std::string& word) {
  const auto parts = Split(word, ':');
  if (parts.size() != 2 || parts[0].size() != 2 || parts[1].size() != 2) return std::nullopt;
  const auto hours = ParseNumber<std::uint32_t>(parts[0]);
  const auto minutes = ParseNumber<std::uint32_t>(parts[1]);
  if (!hours || !minutes || *hours > 23 || *minutes > 59) return std::nullopt;
  return static_cast<int>(60 * *hours + *minutes);
}

std::optional<Date> ReadDate(const std::string& word) {
  const auto parts = Split(word, '-');
  if (parts.size() != 3 || parts[0].size() != 4 || parts[1].size() != 2 || parts[2].size() != 2) {
    return std::nullopt;
  }
  std::array<int, 3> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = ParseNumber<std::uint32_t>(parts[i]);
    if (!number) return std::nullopt;
    numbers[i] = static_cast<int>(*number);
  }
  return Date{numbers[0], numbers[1], numbers[2]};
}

std::optional<int> ReadDay(std::string_view word) {
  const auto* day = std::find(kDays.begin(), kDays.end(), word);
  if (day == kDays.end()) return std::nullopt;
  return static_cast<int>(day - kDays.begin());
}

std::optional<std::set<int>> ReadDays(const std::string& word) {
  std::set<int> days;
  for (const std::string& part : Split(word, ',')) {
    const auto ends = Split(part, '-');
    const auto first = ReadDay(ends.front());
    const auto last = ReadDay(ends.back());
    if (!first || !last || ends.size() > 2) return std::nullopt;
    for (int day = *first;; day = (day + 1) % 7) {
      days.insert(day);
      if (day == *last) break;
    }
  }
  return days.size() == 7 ? std::set<int>{} : days;
}

std::string DaysText(const std::set<int>& days) {
  std::vector<std::string> parts;
  for (auto day = days.begin(); day != days.end();) {
    const int first = *day;
    int last = first;
    for (++day; day != days.end() && *day == last + 1; ++day) last = *day;
    const auto name = [](int number) { return kDays[static_cast<std::size_t>(number)]; };
    if (last - first >= 2) {
      parts.push_back(fmt::format("{}-{}", name(first), name(last)));
    } else {
      for (int each = first; each <= last; ++each) parts.emplace_back(name(each));
    }
  }
  return fmt::format("{}", fmt::join(parts, ","));
}

Result<void> CheckOrders(const std::string& orders) {
  const std::string of_mission = MissionOrders({.orders = orders});
  const auto tasks = mission::ParseOrders(of_mission);
  if (orders.starts_with(kGoto)) {
    const auto going = mission::GoingIn(of_mission);
    const bool is_one_place =
        tasks && going && going->way == 1 && going->because.empty() && tasks->size() == 1;
    if (is_one_place) return {};
    return NotA(orders,
                "'goto' followed by one place and nothing else but photos: goto office@8, or goto "
                "office@8 photo every 5");
  }
  if (!tasks) return tl::unexpected(tasks.error());
  for (const mission::Task& task : *tasks) {
    if (task.kind == mission::Task::Kind::kTeach) {
      return NotA(orders, "no 'teach', because a person has to be there to drive");
    }
  }
  return {};
}

class Parser {
 public:
  explicit Parser(std::string_view words) {
    constexpr std::string_view kDo = " do ";
    const std::size_t end = words.find(kDo);
    if (end != std::string_view::npos) read_.orders = words.substr(end + kDo.size());
    for (const std::string& word : Split(words.substr(0, end), ' ')) {
      if (!word.empty()) words_.push_back(word);
    }
  }

  [[nodiscard]] Result<Schedule> All() {
    read_.name = Take();
    if (!IsValidName(read_.name) || read_.name.size() > kMostNameBytes) {
      return NotA(read_.name, fmt::format("its name: 1 to {} of letters, digits, '_', '.' and '-'",
                                          kMostNameBytes));
    }
    while (at_ < words_.size()) {
      if (auto taken = TakePart(Take()); !taken) return tl::unexpected(taken.error());
    }
    if (auto whole = CheckWhole(); !whole) return tl::unexpected(whole.error());
    return std::move(read_);
  }

 private:
  std::string Take() { return at_ < words_.size() ? words_[at_++] : ""; }

  [[nodiscard]] Result<void> TakePart(const std::string& what) {
    if (!taken_.insert(what).second) return NotA(what, "it once");
    if (what == "to") return TakeRobots();
    if (what == "at") return TakeTimes();
    if (what == "every") return TakeNumber(1, kMinutesADay, "minutes, 1 to 1440", read_.every_min);
    if (what == "from") return TakeTime(read_.from_min);
    if (what == "until") return TakeTime(read_.until_min);
    if (what == "on") return TakeDays();
    if (what == "once") return TakeOnce();
    if (what == "zone") return CheckZone(read_.zone = Take());
    if (what == "battery") {
      return TakeNumber(1, 100, "per cent of its battery, 1 to 100",
                        read_.battery_percent.emplace());
    }
    if (what == "valid") {
      int valid_s = 0;
      auto taken = TakeNumber(1, static_cast<int>(mission::kLongestValid_s),
                              "seconds, a week at most", valid_s);
      read_.valid_s = static_cast<std::uint32_t>(valid_s);
      return taken;
    }
    if (what == "missed") return TakeMissed();
    if (what == "unless-closed") return Set(read_.unless_closed);
    if (what == "if-arrived") return Set(read_.if_arrived);
    if (what == "goes-on") return Set(read_.goes_on);
    return NotA(what,
                "to, at, every, from, until, on, once, zone, battery, unless-closed, if-arrived, "
                "missed, valid, goes-on or do");
  }

  [[nodiscard]] static Result<void> Set(bool& flag) {
    flag = true;
    return {};
  }

  [[nodiscard]] Result<void> TakeNumber(int least, int most, const char* expected, int& value) {
    const std::string word = Take();
    const auto number = ParseNumber<std::uint32_t>(word);
    if (!number || *number < static_cast<std::uint32_t>(least) ||
        *number > static_cast<std::uint32_t>(most)) {
      return NotA(word, expected);
    }
    value = static_cast<int>(*number);
    return {};
  }

  [[nodiscard]] Result<void> TakeRobots() {
    const std::string word = Take();
    for (std::string& robot : Split(word, ',')) {
      if (!IsRobots(robot)) {
        return NotA(robot, "a robot's name, or the beginning of several with '*' behind it");
      }
      const bool is_new =
          std::find(read_.robots.begin(), read_.robots.end(), robot) == read_.robots.end();
      if (is_new) read_.robots.push_back(std::move(robot));
    }
    if (read_.robots.size() <= kMostRobots) return {};
    return NotA(word, fmt::format("{} robots at most: a '*' means more", kMostRobots));
  }

  [[nodiscard]] Result<void> TakeTime(int& minutes) {
    const std::string word = Take();
    const auto time = ReadTime(word);
    if (!time) return NotA(word, kTimeExpected);
    minutes = *time;
    return {};
  }

  [[nodiscard]] Result<void> TakeTimes() {
    const std::string word = Take();
    std::set<int> times;
    for (const std::string& part : Split(word, ',')) {
      const auto time = ReadTime(part);
      if (!time) return NotA(part, kTimeExpected);
      times.insert(*time);
    }
    if (times.size() > kMostTimes) {
      return NotA(word, fmt::format("{} times a day at most: 'every' has more", kMostTimes));
    }
    read_.at_min.assign(times.begin(), times.end());
    return {};
  }

  [[nodiscard]] Result<void> TakeDays() {
    const std::string word = Take();
    const auto days = ReadDays(word);
    if (!days) return NotA(word, kDaysExpected);
    read_.days = *days;
    return {};
  }

  [[nodiscard]] Result<void> TakeOnce() {
    const std::string word = Take();
    read_.once = ReadDate(word);
    if (!read_.once) return NotA(word, kDateExpected);
    if (auto exists = CheckDate(*read_.once); !exists) return exists;
    read_.at_min.resize(1);
    return TakeTime(read_.at_min.front());
  }

  [[nodiscard]] Result<void> TakeMissed() {
    const std::string word = Take();
    if (word != "skip" && word != "once") return NotA(word, "'skip' or 'once'");
    read_.missed = word == "once" ? Missed::kOnce : Missed::kSkip;
    return {};
  }

  [[nodiscard]] Result<void> CheckWhole() const {
    const auto wrong = [&](const std::string& what) {
      return Fail(ErrorCode::kInvalidArgument, "schedule {}: {}", read_.name, what);
    };
    if (read_.robots.empty()) return wrong("there is nobody to send to: say 'to ROBOT'");
    const auto times = taken_.count("at") + taken_.count("every") + taken_.count("once");
    if (times != 1) {
      return wrong("expected one of 'at HH:MM', 'every MINUTES' and 'once YYYY-MM-DD HH:MM'");
    }
    if (taken_.contains("from") != taken_.contains("until")) {
      return wrong("'from' and 'until' go together");
    }
    if (taken_.contains("from") && read_.every_min == 0) {
      return wrong("'from' and 'until' are for 'every' alone");
    }
    if (taken_.contains("from") && read_.from_min == read_.until_min) {
      return wrong(
          "its period ends when it begins: leave 'from' and 'until' out for the whole day");
    }
    if (read_.once && taken_.contains("on")) return wrong("'once' is on one day: leave 'on' out");
    if (read_.zone.empty()) return wrong("say 'zone ZONE', as Europe/Berlin or UTC");
    if (read_.orders.empty()) return wrong("say what is to be done: 'do ORDERS'");
    return CheckOrders(read_.orders);
  }

  std::vector<std::string> words_;
  std::size_t at_ = 0;
  std::set<std::string> taken_;
  Schedule read_;
};

}  // namespace

std::string ClockText(int minutes) {
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

std::string DayText(int day) { return std::string(kDays[static_cast<std::size_t>(day)]); }

bool IsPattern(std::string_view word) { return word.ends_with('*'); }

bool IsMeant(std::string_view word, std::string_view robot) {
  return IsPattern(word) ? robot.starts_with(word.substr(0, word.size() - 1)) : robot == word;
}

std::string MissionOrders(const Schedule& schedule) {
  return schedule.orders.starts_with(kGoto) ? schedule.orders + std::string(kWaitWay)
                                            : schedule.orders;
}

std::string ScheduleOrders(std::string mission_orders) {
  if (mission_orders.starts_with(kGoto) && mission_orders.ends_with(kWaitWay)) {
    mission_orders.resize(mission_orders.size() - kWaitWay.size());
  }
  return mission_orders;
}

Result<Schedule> ParseSchedule(std::string_view words) { return Parser(words).All(); }

std::string WhenText(const Schedule& schedule) {
  std::string text;
  if (schedule.once) {
    const auto& [year, month, day] = *schedule.once;
    text = fmt::format("once {:04}-{:02}-{:02} {}", year, month, day,
                       ClockText(schedule.at_min.front()));
  } else if (schedule.every_min > 0) {
    text = fmt::format("every {}", schedule.every_min);
    if (schedule.until_min != kMinutesADay) {
      text += fmt::format(" from {} until {}", ClockText(schedule.from_min),
                          ClockText(schedule.until_min));
    }
  } else {
    std::vector<std::string> times;
    for (const int minutes : schedule.at_min) times.push_back(ClockText(minutes));
    text = fmt::format("at {}", fmt::join(times, ","));
  }
  if (!schedule.days.empty()) text += " on " + DaysText(schedule.days);
  return text + " zone " + schedule.zone;
}

std::string ToText(const Schedule& schedule) {
  std::string text = fmt::format("{} to {} {}", schedule.name, fmt::join(schedule.robots, ","),
                                 WhenText(schedule));
  if (schedule.battery_percent) text += fmt::format(" battery {}", *schedule.battery_percent);
  if (schedule.unless_closed) text += " unless-closed";
  if (schedule.if_arrived) text += " if-arrived";
  if (schedule.missed == Missed::kOnce) text += " missed once";
  if (schedule.valid_s != Schedule{}.valid_s) text += fmt::format(" valid {}", schedule.valid_s);
  if (schedule.goes_on) text += " goes-on";
  return text + " do " + schedule.orders;
}

}  // namespace trailcast::schedule
