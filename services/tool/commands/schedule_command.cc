// This is `trailcast schedule`.
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/known_robot.h"
#include "services/fleet/network_client.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/photo_wish.h"
#include "services/fleet/schedule_client.h"
#include "services/program/json.h"
#include "services/schedule/listed.h"
#include "services/tool/commands/command.h"
#include "services/tool/commands/photo_options.h"
#include "services/tool/commands/time_spans.h"

namespace trailcast::tool {
namespace {

using schedule::Edit;

constexpr std::chrono::milliseconds kRobotsAreHeard{3000};
constexpr double kMinute_s = 60.0;

struct ScheduleOptions {
  std::string name;
  std::vector<std::string> orders;
  std::vector<std::string> robots;
  std::vector<std::string> at;
  double every_s = 0.0;
  std::string from;
  std::string until;
  std::string on;
  std::string once;
  std::string zone;
  PhotoOptions photos;
  int battery = 0;
  int days = fleet::kCalendarDays;
  bool unless_closed = false;
  bool if_arrived = false;
  std::string missed = "skip";
  double valid_s = 600.0;
  bool goes_on = false;
  bool unheard = false;
  bool json = false;
  double timeout_s = 5.0;
};

constexpr const char* kScheduleExamples =
    "Examples:\n"
    "  trailcast schedule add night-round follow hall --to robot1 --at 22:00,02:00 --on mon-fri "
    "\\\n"
    "      --zone Europe/Berlin --battery 40 --unless-closed\n"
    "  trailcast schedule add shuttle follow hall laps 2 --to 'cart-*' --every 20min \\\n"
    "      --from 08:00 --until 18:00 --zone Europe/Berlin --if-arrived\n"
    "  trailcast schedule add audit goto office@8 --to robot1 --once 2026-12-24T08:30 --zone UTC\n"
    "  trailcast schedule add look follow hall --photo-every 5 --photo-at dock --to robot1 --at "
    "06:00 \\\n"
    "      --zone UTC                          # then: trailcast photos\n"
    "  trailcast schedule list\n"
    "  trailcast schedule calendar             # when all are due next\n"
    "  trailcast schedule change night-round follow hall --to robot1 --at 23:00 --zone UTC\n"
    "  trailcast schedule pause night-round    # and resume, remove\n"
    "A server keeps schedules beside its missions, over restarts. Each has its own --help.";
constexpr const char* kAddExamples =
    "Orders are those of 'trailcast send', without 'teach'.\n"
    "A robot whose last mission of the schedule has not ended is not sent another.\n"
    "Where clocks are set forward, a time that they skip counts as the moment at which they are\n"
    "set; where they are set back, a time that comes twice counts the first time, and the minutes\n"
    "of --every go on. A mission more than a minute late is missed.\n"
    "Exit status: 0 kept by a server; 1 no server, nobody to send to, or the name is taken; 2 "
    "wrong "
    "usage,\nalso of times, days, time zones and orders.";

// Returns the schedule's words, which have not been checked yet.
std::string WordsOf(const ScheduleOptions& options) {
  std::string words = fmt::format("{} to {}", options.name, fmt::join(options.robots, ","));
  const auto add = [&](const char* what, const std::string& value) {
    if (!value.empty()) words += fmt::format(" {} {}", what, value);
  };
  add("at", fmt::format("{}", fmt::join(options.at, ",")));
  if (options.every_s > 0.0) add("every", fmt::format("{}", options.every_s / kMinute_s));
  add("from", options.from);
  add("until", options.until);
  add("on", options.on);
  std::string once = options.once;
  if (const std::size_t at = once.find('T'); at != std::string::npos) once[at] = ' ';
  add("once", once);
  add("zone", options.zone);
  if (options.battery > 0) add("battery", fmt::format("{}", options.battery));
  if (options.unless_closed) words += " unless-closed";
  if (options.if_arrived) words += " if-arrived";
  add("missed", options.missed);
  add("valid", fmt::format("{:.0f}", options.valid_s));
  if (options.goes_on) words += " goes-on";
  return words + fmt::format(" do {}", fmt::join(options.orders, " "));
}

exchange::TopicUse TopicsOf(bool looks_for_robots) {
  exchange::TopicUse use = exchange::NetworkTopics();
  use.write.push_back(exchange::Topic::kNetworkEdits);
  if (!looks_for_robots) return use;
  for (const exchange::TopicUse& more : {exchange::SenderTopics(), exchange::HistoryTopics()}) {
    use.write.insert(use.write.end(), more.write.begin(), more.write.end());
    use.read.insert(use.read.end(), more.read.begin(), more.read.end());
  }
  return use;
}

std::optional<Error> FirstUnknown(fleet::OperatorPeer& peer, const schedule::Schedule& schedule) {
  for (const std::string& robot : schedule.robots) {
    if (schedule::IsPattern(robot)) continue;
    auto unknown = fleet::FindUnknown(*peer.exchange, peer.self, robot, kRobotsAreHeard);
    if (!unknown) continue;
    unknown->message += "; --unheard keeps the schedule all the same";
    return unknown;
  }
  return std::nullopt;
}

int Show(const std::vector<fleet::KnownSchedule>& schedules, bool json) {
  const std::string text =
      json ? program::Indented(fleet::SchedulesJson(schedules)) : fleet::SchedulesText(schedules);
  std::fputs(text.c_str(), stdout);
  return program::kExitOk;
}

// Fails if no message holds it.
Result<void> CheckLength(Edit edit) {
  // The longest name of a server is not longer than this.
  edit.server = std::string(64, 's');
  const std::size_t bytes = schedule::ToText(edit).size();
  if (bytes <= exchange::kMaxLineBytes) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "the schedule is too long by {} bytes: name fewer robots or times, or give it fewer "
              "orders or photos",
              bytes - exchange::kMaxLineBytes);
}

Result<schedule::Schedule> WithPhotos(schedule::Schedule schedule, fleet::OperatorPeer& peer,
                                      const ScheduleOptions& options) {
  const auto wish = WishOf(options.photos, peer, options.timeout_s);
  if (!wish) return tl::unexpected(wish.error());
  return fleet::ScheduleWithPhotos(std::move(schedule), *wish);
}

int ChangeIt(const CLI::App& app, const program::CommonOptions& common,
             const ScheduleOptions& options, Edit edit) {
  const bool adds = edit.kind == Edit::Kind::kAdd || edit.kind == Edit::Kind::kChange;
  auto peer = fleet::JoinAsOperator(common, TopicsOf(adds));
  if (!peer) return program::Complain(app, peer.error());
  if (adds && !options.unheard) {
    if (const auto unknown = FirstUnknown(*peer, edit.schedule)) {
      return program::Complain(app, *unknown);
    }
  }
  if (adds) {
    auto with = WithPhotos(std::move(edit.schedule), *peer, options);
    if (!with) return program::Complain(app, with.error());
    edit.schedule = *std::move(with);
    if (const auto fits = CheckLength(edit); !fits) return program::Complain(app, fits.error());
  }
  const auto timeout = ToMilliseconds(options.timeout_s);
  const auto known = fleet::AskForSchedules(*peer->exchange, peer->self, timeout);
  if (!known) return program::Complain(app, known.error());
  const auto server = fleet::ServerFor(*known, edit);
  if (!server) return program::Complain(app, server.error());
  edit.server = server->value();
  const auto lines = fleet::AskToJoin(*peer->exchange, peer->self, schedule::ToText(edit), timeout);
  if (!lines) return program::Complain(app, lines.error());
  std::vector<fleet::KnownSchedule> now;
  for (schedule::Listed& listed : schedule::ParseLines(*lines)) {
    now.push_back({*server, std::move(listed)});
  }
  if (edit.kind != Edit::Kind::kRemove || options.json) return Show(now, options.json);
  fmt::print("schedule {} is removed\n", edit.schedule.name);
  return program::kExitOk;
}

int AddOrChange(const CLI::App& app, const program::CommonOptions& common,
                const ScheduleOptions& options, Edit::Kind kind) {
  auto read = schedule::ParseSchedule(WordsOf(options));
  if (!read) return ComplainOfUsage(app, read.error());
  Edit edit{.kind = kind, .schedule = *std::move(read)};
  if (const auto fits = CheckLength(edit); !fits) return ComplainOfUsage(app, fits.error());
  return ChangeIt(app, common, options, std::move(edit));
}

int List(const CLI::App& app, const program::CommonOptions& common,
         const ScheduleOptions& options) {
  auto peer = fleet::JoinAsOperator(common, exchange::NetworkTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto known =
      fleet::AskForSchedules(*peer->exchange, peer->self, ToMilliseconds(options.timeout_s));
  if (!known) return program::Complain(app, known.error());
  return Show(known->schedules, options.json);
}

int ShowCalendar(const CLI::App& app, const program::CommonOptions& common,
                 const ScheduleOptions& options) {
  auto peer = fleet::JoinAsOperator(common, exchange::NetworkTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto known =
      fleet::AskForSchedules(*peer->exchange, peer->self, ToMilliseconds(options.timeout_s));
  if (!known) return program::Complain(app, known.error());
  const auto firings = fleet::CalendarOf(known->schedules, NowUnixMs(), options.days);
  const std::string text =
      options.json ? program::Indented(fleet::CalendarJson(firings)) : fleet::CalendarText(firings);
  std::fputs(text.c_str(), stdout);
  return program::kExitOk;
}

void AddAnswerOptions(CLI::App& app, ScheduleOptions& options) {
  app.add_flag("--json", options.json, "For programs");
  app.add_option("--timeout", options.timeout_s, "Seconds to wait for a server")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
}

void AddTimes(CLI::App& app, ScheduleOptions& options) {
  auto* at = app.add_option("--at", options.at, "At these times of the day: 08:30 or 08:30,12:00");
  at->delimiter(',')->allow_extra_args(false)->take_all();
  auto* every = app.add_option("--every", options.every_s,
                               "Every so often, from midnight or --from on: 20min, 2h");
  every->transform(TimeSpan("TIME"))->check(CLI::Range(kMinute_s, 86400.0))->excludes(at);
  app.add_option("--from", options.from, "With --every: a day's first time, HH:MM")->needs(every);
  app.add_option("--until", options.until,
                 "With --every: its last, HH:MM; before --from, on the next day")
      ->needs(every);
  app.add_option("--once", options.once, "On one day alone: 2026-12-24T08:30")
      ->excludes(at)
      ->excludes(every);
  app.add_option("--on", options.on,
                 "On these days alone: mon-fri, or mon,wed,sat; default: daily");
  app.add_option("--zone", options.zone,
                 "The time zone of all these times, of the IANA database: Europe/Berlin, UTC")
      ->required();
}

void AddConditions(CLI::App& app, ScheduleOptions& options) {
  app.add_option("--battery", options.battery,
                 "Only a robot whose battery has this many per cent, or more")
      ->check(CLI::Range(1, 100));
  app.add_flag("--unless-closed", options.unless_closed,
               "Not while the route is closed there ('trailcast network close')");
  app.add_flag("--if-arrived", options.if_arrived,
               "Only if the robot's last mission of this schedule arrived; after another end it is "
               "sent again once the schedule is told to resume");
  app.add_option("--missed", options.missed,
                 "What becomes of times that passed while no server was there: 'skip', or 'once', "
                 "which sends one mission for all of them")
      ->check(CLI::IsMember({"skip", "once"}))
      ->capture_default_str();
  app.add_option("--valid", options.valid_s,
                 "How long a server keeps each mission for a robot that is out of reach: 90s, "
                 "20min, 2h")
      ->transform(TimeSpan("TIME"))
      ->check(CLI::Range(1.0, 7 * 86400.0))
      ->capture_default_str();
  app.add_flag("--goes-on", options.goes_on,
               "A mission goes on by itself after its agent has started again");
  app.add_flag("--unheard", options.unheard, "Also for robots that nobody has ever heard of");
}

}  // namespace

Command AddScheduleCommand(CLI::App& parent, const program::CommonOptions& common) {
  CLI::App* app = parent.add_subcommand("schedule", "Send robots missions at times");
  app->footer(kScheduleExamples);
  app->require_subcommand(1);
  auto options = std::make_shared<ScheduleOptions>();
  std::vector<std::pair<CLI::App*, Edit::Kind>> worded;
  const auto add_worded = [&](const char* name, const char* help, Edit::Kind kind) {
    CLI::App* sub = app->add_subcommand(name, help);
    sub->footer(kAddExamples);
    sub->add_option("NAME", options->name, "What it is called")
        ->required()
        ->check(program::NameValidator());
    sub->add_option("ORDERS", options->orders, "What robots are to do")->required();
    auto* to = sub->add_option("--to", options->robots,
                               "Who is sent: robot1, robot1,robot2 or, for all that the server "
                               "hears then whose names begin so, 'cart-*'");
    to->required()->delimiter(',')->allow_extra_args(false)->take_all();
    AddTimes(*sub, *options);
    AddPhotoOptions(*sub, options->photos);
    AddConditions(*sub, *options);
    AddAnswerOptions(*sub, *options);
    worded.emplace_back(sub, kind);
  };
  add_worded("add", "Make a schedule", Edit::Kind::kAdd);
  add_worded("change", "Give a schedule all that follows in place of what it has; it stays paused",
             Edit::Kind::kChange);
  CLI::App* list =
      app->add_subcommand("list", "List schedules: when next, what became of the last");
  AddAnswerOptions(*list, *options);
  CLI::App* calendar =
      app->add_subcommand("calendar", "List when schedules are due next, the first first");
  calendar->add_option("--days", options->days, "In so many days")
      ->check(CLI::Range(1, 366))
      ->capture_default_str();
  AddAnswerOptions(*calendar, *options);
  std::vector<std::pair<CLI::App*, Edit::Kind>> named;
  const auto add_named = [&](const char* name, const char* help, Edit::Kind kind) {
    CLI::App* sub = app->add_subcommand(name, help);
    sub->add_option("NAME", options->name, "What it is called")
        ->required()
        ->check(program::NameValidator());
    AddAnswerOptions(*sub, *options);
    named.emplace_back(sub, kind);
  };
  add_named("remove", "Remove a schedule; missions that were sent stay", Edit::Kind::kRemove);
  add_named("pause", "Send nobody until it is told to resume", Edit::Kind::kPause);
  add_named("resume", "Have it go on, also after a mission that did not arrive (--if-arrived)",
            Edit::Kind::kResume);
  return {app, [list, calendar, worded, named, options, &common] {
            for (const auto& [sub, kind] : worded) {
              if (sub->parsed()) return AddOrChange(*sub, common, *options, kind);
            }
            if (calendar->parsed()) return ShowCalendar(*calendar, common, *options);
            if (list->parsed()) return List(*list, common, *options);
            for (const auto& [sub, kind] : named) {
              Edit edit{.kind = kind};
              edit.schedule.name = options->name;
              if (sub->parsed()) return ChangeIt(*sub, common, *options, std::move(edit));
            }
            return program::kExitUsage;
          }};
}

}  // namespace trailcast::tool
