#include "services/console/src/api/schedules_api.h"

#include <spdlog/spdlog.h>

#include <iterator>
#include <utility>

#include "services/base/unix_time.h"
#include "services/console/json.h"
#include "services/console/src/api/answers.h"
#include "services/console/src/api/photos_asked.h"
#include "services/exchange/bounds.h"
#include "services/fleet/photo_wish.h"
#include "services/fleet/schedule_client.h"
#include "services/program/json.h"
#include "services/schedule/listed.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;
using program::OneLine;

// Returns the schedules of the server that answers first.
Result<fleet::KnownSchedules> AskForSchedules(Desk& desk) {
  std::vector<std::string> lines;
  fleet::KnownSchedules known;
  std::uint32_t first = 0;
  do {
    auto reply = desk.Network(std::string(schedule::kQuestion), first);
    if (!reply && reply.error().code == ErrorCode::kConflict) {
      return Fail(ErrorCode::kUnavailable, "{}", reply.error().message);
    }
    if (!reply) return tl::unexpected(reply.error());
    known.servers = {reply->server};
    std::move(reply->lines.begin(), reply->lines.end(), std::back_inserter(lines));
    first = reply->next > first ? reply->next : 0;
  } while (first > 0);
  for (schedule::Listed& listed : schedule::ParseLines(lines)) {
    known.schedules.push_back({known.servers.front(), std::move(listed)});
  }
  return known;
}

// Reads a schedule with the photos of its missions. A place's name is looked up.
Result<schedule::Schedule> ScheduleIn(Desk& desk, const std::string& body) {
  auto read = ReadSchedule(body);
  if (!read) return tl::unexpected(read.error());
  const auto wish = PhotosAsked(desk, read->photos);
  if (!wish) return tl::unexpected(wish.error());
  return fleet::ScheduleWithPhotos(std::move(read->schedule), *wish);
}

std::string SchedulesBody(const std::vector<fleet::KnownSchedule>& schedules) {
  return OneLine({{"schedules", fleet::SchedulesJson(schedules)}});
}

void ChangeSchedule(Desk& desk, const std::string& who, schedule::Edit edit, Response& response) {
  const auto known = AskForSchedules(desk);
  if (!known) return Refuse(response, known.error());
  const auto server = fleet::ServerFor(*known, edit);
  if (!server) return Refuse(response, 409, server.error().message);
  edit.server = server->value();
  const std::string words = ToText(edit);
  if (words.size() > exchange::kMaxLineBytes) {
    return Refuse(response, 400,
                  fmt::format("the schedule is too long by {} bytes: name fewer robots or times, "
                              "or give it fewer orders or photos",
                              words.size() - exchange::kMaxLineBytes));
  }
  const auto reply = desk.Join(words);
  if (!reply) return Refuse(response, reply.error());
  spdlog::info("console: {}{}{}", who, who.empty() ? "" : ": ", words);
  std::vector<fleet::KnownSchedule> now;
  for (schedule::Listed& listed : schedule::ParseLines(reply->lines)) {
    now.push_back({reply->server, std::move(listed)});
  }
  Answer(response, 200, SchedulesBody(now));
}

}  // namespace

void ServeSchedules(http::Server& server, Desk& desk, const Access& access) {
  server.Get("/api/schedules", [&desk](const Request& /*request*/, Response& response) {
    const auto known = AskForSchedules(desk);
    if (!known) return Refuse(response, known.error());
    Answer(response, 200, SchedulesBody(known->schedules));
  });
  server.Post("/api/schedules", [&desk, &access](const Request& request, Response& response) {
    auto read = ScheduleIn(desk, request.body);
    if (!read) return Refuse(response, read.error());
    ChangeSchedule(desk, access.WhoIs(request).name,
                   {.kind = schedule::Edit::Kind::kAdd, .schedule = *std::move(read)}, response);
  });
  server.Get("/api/schedules/calendar", [&desk](const Request& /*request*/, Response& response) {
    const auto known = AskForSchedules(desk);
    if (!known) return Refuse(response, known.error());
    const auto firings = fleet::CalendarOf(known->schedules, NowUnixMs(), fleet::kCalendarDays);
    Answer(response, 200,
           OneLine({{"days", fleet::kCalendarDays}, {"firings", fleet::CalendarJson(firings)}}));
  });
  server.Post("/api/schedules/preview", [&desk](const Request& request, Response& response) {
    const auto read = ScheduleIn(desk, request.body);
    if (!read) return Refuse(response, read.error());
    Answer(response, 200, OneLine(fleet::PreviewJson(*read, NowUnixMs())));
  });
  const auto change_as = [&desk, &access](schedule::Edit::Kind kind) {
    return [&desk, &access, kind](const Request& request, Response& response) {
      schedule::Edit edit{.kind = kind};
      edit.schedule.name = request.matches[1];
      ChangeSchedule(desk, access.WhoIs(request).name, std::move(edit), response);
    };
  };
  const std::string named = "/api/schedules/([A-Za-z0-9_.-]{1,64})";
  server.Put(named, [&desk, &access](const Request& request, Response& response) {
    auto read = ScheduleIn(desk, request.body);
    if (!read) return Refuse(response, read.error());
    if (read->name != request.matches[1].str()) {
      return Refuse(response, 400,
                    fmt::format("the schedule in 'words' is called '{}', and not '{}'", read->name,
                                request.matches[1].str()));
    }
    ChangeSchedule(desk, access.WhoIs(request).name,
                   {.kind = schedule::Edit::Kind::kChange, .schedule = *std::move(read)}, response);
  });
  server.Delete(named, change_as(schedule::Edit::Kind::kRemove));
  server.Post(named + "/pause", change_as(schedule::Edit::Kind::kPause));
  server.Post(named + "/resume", change_as(schedule::Edit::Kind::kResume));
}

}  // namespace trailcast::console
