#include "services/console/src/api/runs/runs_api.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "services/base/number.h"
#include "services/console/parameters.h"
#include "services/console/src/api/answers.h"
#include "services/console/src/api/incoming_file.h"
#include "services/console/src/api/runs/run_body.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

// After this, the caller is told that the log is being read, and asks again.
constexpr std::chrono::milliseconds kLook{2000};
constexpr std::chrono::minutes kRunsPatience{10};
constexpr const char* kRun = "/api/runs/([0-9a-f]{16})";
constexpr const char* kFrame = "/api/runs/([0-9a-f]{16})/frames/([0-9]{1,9})";

void List(Runs& runs, const Request& request, Response& response) {
  const auto query = ReadRunsQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto page = runs.List(*query, kLook);
  if (!page) return Refuse(response, page.error());
  Answer(response, 200, RunsBody(*page));
}

using Opened = std::shared_ptr<const OpenedRun>;

// Returns null if the answer has been given.
Opened Find(Runs& runs, const Request& request, Response& response) {
  auto found = runs.Find(request.matches[1], kLook);
  if (!found) {
    Refuse(response, found.error());
  } else if (*found == nullptr) {
    Answer(response, 202, program::OneLine({{"reading", true}}));
  }
  return found.value_or(nullptr);
}

void Show(Runs& runs, const Request& request, Response& response) {
  const std::string along = request.get_param_value("along");
  if (!along.empty() && along != "metres" && along != "seconds") {
    return Refuse(response, 400, "'along': is to be metres or seconds");
  }
  const Opened run = Find(runs, request, response);
  if (!run) return;
  Answer(response, 200, RunBody(*run, along == "seconds" ? RunAxis::kSeconds : RunAxis::kMetres));
}

void Frames(Runs& runs, const Request& request, Response& response) {
  const auto first = ParseNumber<std::size_t>(request.get_param_value("first"));
  if (!first) return Refuse(response, 400, "'first': is to be the row of the first frame");
  const Opened run = Find(runs, request, response);
  if (!run) return;
  if (*first >= run->log.frames.size()) {
    return Refuse(response, 404, fmt::format("the run has {} frames", run->log.frames.size()));
  }
  Answer(response, 200, RunFramesBody(*run, *first));
}

// Calls `tell` with the run, the row, and what is seen in it.
template <typename Tell>
void Look(Runs& runs, const Request& request, Response& response, Tell tell) {
  const Opened run = Find(runs, request, response);
  if (!run) return;
  const auto row = ParseNumber<std::size_t>(request.matches[2].str()).value_or(0);
  if (row >= run->log.frames.size()) {
    return Refuse(response, 404, fmt::format("the run has {} frames", run->log.frames.size()));
  }
  const auto seen = run->SeenIn(row);
  if (!seen) return Refuse(response, seen.error());
  tell(*run, row, *seen);
}

void Picture(const OpenedRun::Seen& seen, Response& response) {
  if (!seen.picture) return Refuse(response, 404, "the log has no picture of this frame");
  response.set_header("Cache-Control", "private, max-age=60");
  const auto& jpeg = seen.picture->jpeg;
  response.set_content(reinterpret_cast<const char*>(jpeg.data()), jpeg.size(), "image/jpeg");
}

void Upload(Desk& desk, Runs& runs, Response& response, const httplib::ContentReader& read) {
  const auto upload = runs.BeginUpload();
  if (!upload) return Refuse(response, upload.error());
  const auto came = ReceiveInto(upload->path, "log", desk, read);
  runs.EndUpload(*upload, came.has_value());
  if (!came) return Refuse(response, came.error());
  Answer(response, 202, program::OneLine({{"run", upload->id}}));
}

}  // namespace

void ServeRuns(http::Server& server, Desk& desk, Runs& runs) {
  server.Allow({.method = "POST",
                .path = "/api/runs",
                .body_bytes = Runs::kMostUploadBytes,
                .patience = kRunsPatience});
  server.Get("/api/runs",
             [&](const Request& request, Response& response) { List(runs, request, response); });
  server.Post("/api/runs",
              [&](const Request&, Response& response, const httplib::ContentReader& read) {
                Upload(desk, runs, response, read);
              });
  server.Get(kRun,
             [&](const Request& request, Response& response) { Show(runs, request, response); });
  server.Get(fmt::format("{}/frames", kRun),
             [&](const Request& request, Response& response) { Frames(runs, request, response); });
  server.Get(fmt::format("{}/seen", kFrame), [&](const Request& request, Response& response) {
    Look(runs, request, response,
         [&](const OpenedRun& run, std::size_t row, const OpenedRun::Seen& seen) {
           Answer(response, 200, RunSeenBody(run, row, seen));
         });
  });
  server.Get(fmt::format("{}/picture", kFrame), [&](const Request& request, Response& response) {
    Look(runs, request, response, [&](const OpenedRun&, std::size_t, const OpenedRun::Seen& seen) {
      Picture(seen, response);
    });
  });
}

}  // namespace trailcast::console
