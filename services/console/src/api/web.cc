#include "services/console/web.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "services/base/text.h"
#include "services/base/unix_time.h"
#include "services/console/json.h"
#include "services/console/rights.h"
#include "services/console/runs.h"
#include "services/console/src/api/alerts_api.h"
#include "services/console/src/api/answers.h"
#include "services/console/src/api/driving_api.h"
#include "services/console/src/api/files.h"
#include "services/console/src/api/history_api.h"
#include "services/console/src/api/map_api.h"
#include "services/console/src/api/network_api.h"
#include "services/console/src/api/photos_api.h"
#include "services/console/src/api/photos_asked.h"
#include "services/console/src/api/routes/routes_api.h"
#include "services/console/src/api/routes/transfers_api.h"
#include "services/console/src/api/routes/where_api.h"
#include "services/console/src/api/runs/runs_api.h"
#include "services/console/src/api/schedules_api.h"
#include "services/console/src/api/snapshots_api.h"
#include "services/console/src/api/users_api.h"
#include "services/exchange/bounds.h"
#include "services/fleet/draw.h"
#include "services/fleet/mission_client.h"
#include "services/fleet/photo_wish.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using exchange::NowOrder;
using exchange::NowWhom;
using httplib::Request;
using httplib::Response;
using program::OneLine;

// A stream notices within this time that its page is gone.
constexpr std::chrono::milliseconds kNotices{1000};
constexpr std::size_t kMostBody = 64U << 10U;

constexpr std::array kOrders{NowOrder::kPause, NowOrder::kResume,  NowOrder::kCancel,
                             NowOrder::kStop,  NowOrder::kRelease, NowOrder::kEnd,
                             NowOrder::kHome};

// Orders after which a robot stands are obeyed with any body; orders after which it may drive are
// not.
bool MakesStand(NowOrder order) {
  return order != NowOrder::kResume && order != NowOrder::kRelease && order != NowOrder::kHome;
}

// A robot that was never heard may be there all the same, and was commanded, so it counts as one
// that did not answer.
int StatusOf(const std::vector<fleet::RobotsWord>& words) {
  switch (fleet::ObeyedBy(words)) {
    case fleet::Obeyed::kByAll:
      return 200;
    case fleet::Obeyed::kNotByAll:
      return 409;
    case fleet::Obeyed::kUnanswered:
      break;
  }
  return 504;
}

// Robots and servers know only the console. This tells them which of its users commands.
std::string ReasonOf(const users::Who& who, const std::string& reason) {
  if (who.name.empty()) return reason;
  return PlainText(reason.empty() ? who.name : who.name + ": " + reason, exchange::kMaxLineBytes);
}
std::string IdFor(const users::Who& who) {
  return who.name.empty() ? fleet::DrawMissionId() : who.name + "-" + fleet::DrawMissionId();
}

// Each stream, each errand that waits for its answer, and each request that waits for a picture
// takes a thread, and stops have enough left. If strangers can reach the console, one address has
// enough threads for a room of people, and leaves more for others.
http::Limits LimitsFor(const Access& access) {
  constexpr std::size_t kOwn = Web::kMostStreams + Desk::kMostErrands + kMostLookers +
                               Runs::kMostWaiting + NetworkWatch::kMostWaiting +
                               Album::kMostWaiting + 16;
  if (!access.is_open()) return {.threads = kOwn, .body_bytes = kMostBody};
  return {.threads = kOwn + 64, .body_bytes = kMostBody, .of_one_address = 24};
}

// Refuses a method that a known path does not take.
std::optional<http::Refusal> JudgeMethod(const Request& request) {
  const std::string methods = MethodsOf(request.path);
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  if (methods.empty() || RightTo(method, request.path).is_known) return std::nullopt;
  return http::Refusal{405, fmt::format("{} takes {}, not {}", request.path, methods, method)};
}

// Returns why the server refused a request that no handler has seen.
const char* WhyRefused(int status) {
  switch (status) {
    case 400:
      return "this is no request of HTTP/1.1: it begins with METHOD PATH HTTP/1.1, and each line "
             "ends with CR LF";
    case 414:
      return "the address is too long";
    default:
      return "not found";
  }
}

}  // namespace

Web::Web(Desk& desk, Atlas& atlas, Site* site, Entry entry, Transfers::Join join, Runs* runs)
    : desk_(desk),
      access_(std::move(entry)),
      network_(desk),
      album_(desk),
      server_(LimitsFor(access_),
              [](const Error& error) { spdlog::error("console: {}", error.message); }) {
  httplib::Headers headers{
      {"Content-Security-Policy",
       "default-src 'self'; base-uri 'none'; form-action 'none'; "
       "frame-ancestors 'none'; object-src 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Permissions-Policy", "camera=(), geolocation=(), microphone=(), payment=(), usb=()"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"}};
  if (access_.encrypted()) headers.emplace("Strict-Transport-Security", "max-age=31536000");
  server_.set_default_headers(std::move(headers));
  server_.set_error_handler([](const Request& request, Response& response) {
    if (response.status == 405) response.set_header("Allow", MethodsOf(request.path));
    if (response.body.empty()) Refuse(response, response.status, WhyRefused(response.status));
  });
  server_.JudgeBy(
      [this](const Request& request) {
        auto refusal = http::Judge(request, door_);
        if (!refusal) refusal = JudgeMethod(request);
        if (!refusal && !server_.TakesAnyBody(request)) refusal = http::JudgeType(request);
        return refusal ? refusal : access_.Judge(request);
      },
      [](const http::Refusal& refusal, Response& response) {
        Refuse(response, refusal.status, refusal.why);
      });
  ServeFiles();
  ServeState();
  ServeOrders();
  ServeMissions();
  ServeMetrics();
  ServeAlerts(server_, desk_, access_);
  ServeRoutes(server_, desk_);
  ServeMap(server_, atlas, site);
  ServeNetwork(server_, desk_, network_, access_);
  ServeSchedules(server_, desk_, access_);
  ServePhotos(server_, album_);
  ServeDriving(server_, desk_);
  ServeWhere(server_, desk_);
  if (join) ServeTransfers(server_, desk_, transfers_.emplace(std::move(join)));
  ServeSnapshots(server_, desk_);
  if (runs != nullptr) ServeRuns(server_, desk_, *runs);
  access_.Serve(server_);
  ServeUsers(server_, access_);
}

Result<std::unique_ptr<Web>> Web::Open(Desk& desk, Atlas& atlas, Site* site,
                                       const std::string& host, int port,
                                       std::set<std::string> names, Entry entry,
                                       Transfers::Join join, Runs* runs) {
  const bool asks = entry.guard != nullptr;
  const auto tls = entry.tls;
  std::unique_ptr<Web> web(new Web(desk, atlas, site, std::move(entry), std::move(join), runs));
  web->door_ = {.port = port, .names = std::move(names), .encrypted = tls.has_value()};
  web->door_.any_name = asks && web->door_.names.empty();
  if (tls) web->server_.Speak(*tls);
  web->access_.At(port);
  // A port that the system chooses is known only after this.
  if (auto listens = web->server_.Listen(host, port); !listens) {
    return tl::unexpected(listens.error());
  }
  if (port == 0) {
    web->door_.port = web->port();
    web->access_.At(web->port());
  }
  return web;
}

void Web::ServeFiles() {
  for (const File& file : Files()) {
    server_.Get(file.path, [&file](const Request& request, Response& response) {
      response.set_header("ETag", file.tag);
      response.set_header("Cache-Control", "no-cache");
      response.set_header("Vary", "Accept-Encoding");
      if (request.get_header_value("If-None-Match") == file.tag) {
        response.status = 304;
        return;
      }
      const bool packed =
          !file.packed.empty() &&
          request.get_header_value("Accept-Encoding").find("gzip") != std::string::npos;
      if (packed) response.set_header("Content-Encoding", "gzip");
      // set_content would compress the bytes anew for each request.
      const std::string_view bytes = packed ? file.packed : file.bytes;
      response.set_content_provider(
          bytes.size(), file.type,
          [bytes](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            return sink.write(bytes.data() + offset, length);
          });
    });
  }
}

void Web::ServeState() {
  server_.Get("/api/state", [this](const Request&, Response& response) {
    const auto news = desk_.See(0, kNotices);
    if (!news) return Refuse(response, 503, "nothing is known yet");
    Answer(response, 200, StateBody(*news->state, NowUnixMs()));
  });
  server_.Get("/api/events",
              [this](const Request& request, Response& response) { Stream(request, response); });
}

void Web::Stream(const Request& request, Response& response) {
  // The stream counts until the last copy of its writer is gone.
  const std::shared_ptr<void> seat(nullptr, [this](void*) { --streams_; });
  if (++streams_ > kMostStreams) {
    ++streams_refused_;
    response.set_header("Retry-After", "5");
    return Refuse(response, 503, "too many pages look already: close some");
  }
  struct Told {
    std::shared_ptr<const Desk::News> news{};
    std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now();
  };
  response.set_header("Cache-Control", "no-store");
  response.set_header("X-Accel-Buffering", "no");
  response.set_content_provider(
      "text/event-stream", [this, seat, still_in = access_.StillIn(request), told = Told{}](
                               std::size_t, httplib::DataSink& sink) mutable {
        const auto news = desk_.See(told.news ? told.news->number : 0, kNotices);
        if (desk_.closed() || !sink.is_writable() || !still_in()) return false;
        std::string text;
        if (news && told.news) {
          text = fmt::format("event: change\ndata: {}\n\n",
                             ChangeBody(*told.news->state, *news->state, NowUnixMs()));
        } else if (news) {
          text = fmt::format("event: state\ndata: {}\n\n", StateBody(*news->state, NowUnixMs()));
        } else if (std::chrono::steady_clock::now() >= told.at + kAliveEvery) {
          // This is an event and no comment, because a page is not told of comments, and must
          // notice when nothing comes.
          text = fmt::format("event: alive\ndata: {}\n\n", OneLine({{"now_unix_ms", NowUnixMs()}}));
        } else {
          return true;
        }
        if (news) told.news = news;
        told.at = std::chrono::steady_clock::now();
        stream_bytes_ += text.size();
        return sink.write(text.data(), text.size());
      });
}

void Web::ServeOrders() {
  for (const NowOrder order : kOrders) {
    const std::string path =
        fmt::format("/api/robots/(@?[A-Za-z0-9_.-]{{1,64}})/{}", mission::ToString(order));
    auto tell = [this, order](const Request& request, Response& response) {
      Tell(order, {NowWhom::kRobot, request.matches[1]}, request, response);
    };
    if (MakesStand(order)) {
      server_.PostWithAnyBody(path, std::move(tell));
    } else {
      server_.Post(path, std::move(tell));
    }
  }
  server_.Post("/api/robots/([A-Za-z0-9_.-]{1,64})/forget",
               [this](const Request& request, Response& response) {
                 const auto forgotten = desk_.Forget(AgentId(request.matches[1]));
                 if (!forgotten) return Refuse(response, forgotten.error());
                 Answer(response, 200, OneLine({{"forgotten", request.matches[1].str()}}));
               });
  server_.PostWithAnyBody("/api/all/stop", [this](const Request& request, Response& response) {
    Tell(NowOrder::kStop, {NowWhom::kAll, ""}, request, response);
  });
  server_.Post("/api/all/home", [this](const Request& request, Response& response) {
    Tell(NowOrder::kHome, {NowWhom::kAll, ""}, request, response);
  });
}

void Web::Tell(NowOrder order, const fleet::NowTarget& target, const Request& request,
               Response& response) {
  const auto reason =
      MakesStand(order) ? Result<std::string>(ReasonIfAny(request.body)) : ReadReason(request.body);
  if (!reason) return Refuse(response, 400, reason.error().message);
  const auto words = desk_.Tell(order, target, ReasonOf(access_.WhoIs(request), *reason));
  if (!words) {
    const bool nobody = words.error().code == ErrorCode::kNotFound;
    return Refuse(response, nobody ? 504 : 503, words.error().message);
  }
  commands_.Count(order, *words);
  if (target.whom == NowWhom::kAll) {
    program::Json all{{"robots", fleet::WordsJson(*words)}};
    if (order == NowOrder::kStop) all["text"] = fleet::StandText(*words);
    return Answer(response, StatusOf(*words), OneLine(all));
  }
  Answer(response, StatusOf(*words), OneLine(fleet::WordJson(words->front())));
}

void Web::ServeMissions() {
  ServeHistory(server_, desk_);
  server_.Post("/api/robots/([A-Za-z0-9_.-]{1,64})/missions",
               [this](const Request& request, Response& response) {
                 Send(request.matches[1], request, response);
               });
  server_.Post("/api/missions",
               [this](const Request& request, Response& response) { Send("", request, response); });
}

void Web::Send(const std::string& robot, const Request& request, Response& response) {
  const auto body = ReadSend(request.body, robot.empty());
  if (!body) return Refuse(response, 400, body.error().message);
  const auto orders =
      PhotosAsked(desk_, body->photos).and_then([&](const mission::PhotoWish& wish) {
        return fleet::OrdersWithPhotos(body->orders, wish);
      });
  if (!orders) return Refuse(response, orders.error());
  const auto reports =
      desk_.Send({.agent = AgentId(robot.empty() ? body->to : robot),
                  .id = body->id.empty() ? IdFor(access_.WhoIs(request)) : body->id,
                  .orders = *orders,
                  .valid_for_s = body->valid_s,
                  .goes_on = body->goes_on},
                 body->unheard);
  if (!reports) {
    const bool unknown = reports.error().code == ErrorCode::kNotFound;
    return Refuse(response, unknown ? 404 : 504, reports.error().message);
  }
  auto all = program::Json::array();
  bool taken = true;
  for (const mission::Report& report : *reports) {
    all.push_back(fleet::ReportJson(report));
    taken = taken && (!mission::HasEnded(report.state) || report.state == mission::State::kArrived);
  }
  Answer(response, taken ? 200 : 409,
         OneLine(robot.empty() ? program::Json{{"missions", all}} : all.front()));
}

}  // namespace trailcast::console
