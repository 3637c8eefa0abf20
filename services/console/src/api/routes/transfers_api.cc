#include "services/console/src/api/routes/transfers_api.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>

#include "services/base/number.h"
#include "services/console/json.h"
#include "services/console/src/api/answers.h"
#include "services/console/src/api/incoming_file.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

constexpr const char* kUploads = "/api/transfers/uploads";
constexpr std::chrono::minutes kTransfersPatience{15};
constexpr std::uint32_t kMostRevisions = 200;

std::string ProgressBody(const Transfers::Progress& progress) {
  const char* state = progress.state == Transfers::State::kUnderWay ? "under way"
                      : progress.state == Transfers::State::kDone   ? "done"
                                                                    : "failed";
  return program::OneLine({{"transfer", progress.id},
                           {"upload", progress.is_upload},
                           {"state", state},
                           {"route", progress.route},
                           {"revision", progress.revision},
                           {"done_bytes", progress.done_bytes},
                           {"total_bytes", progress.total_bytes},
                           {"detail", progress.detail}});
}

// Returns the teaching of a route, by its id, that a server has whole.
Result<route::RouteInfo> Find(Desk& desk, const route::RouteKey& key) {
  route::RouteQuery query;
  query.name = key.route.value();
  query.state = route::RouteState::kComplete;
  query.page_size = kMostRevisions;
  const auto reply = desk.Routes(query);
  if (!reply) return tl::unexpected(reply.error());
  for (const route::RouteInfo& info : reply->page.routes) {
    if (info.key == key) return info;
  }
  return Fail(ErrorCode::kNotFound, "no server has this teaching of the route complete");
}

void Fetch(Desk& desk, Transfers& transfers, const Request& request, Response& response) {
  const auto wanted = ReadFetch(request.body);
  if (!wanted) return Refuse(response, wanted.error());
  const auto info = Find(desk, *wanted);
  if (!info) return Refuse(response, info.error());
  const auto progress = transfers.Fetch(*info);
  if (!progress) return Refuse(response, progress.error());
  Answer(response, 202, ProgressBody(*progress));
}

void Upload(Desk& desk, Transfers& transfers, const Request& request, Response& response,
            const httplib::ContentReader& read) {
  const auto bytes = ParseNumber<std::uint64_t>(request.get_header_value("Content-Length"));
  const auto upload = transfers.BeginUpload(bytes.value_or(0));
  if (!upload) return Refuse(response, upload.error());
  if (const auto came = ReceiveInto(upload->path, "file", desk, read); !came) {
    transfers.GiveUp(upload->id);
    return Refuse(response, came.error());
  }
  Answer(response, 202, ProgressBody(transfers.Deliver(upload->id)));
}

void Download(Desk& desk, Transfers& transfers, const Request& request, Response& response) {
  const auto file = transfers.FileOf(request.matches[1]);
  if (!file) return Refuse(response, file.error());
  const auto stream = std::make_shared<std::ifstream>(file->path, std::ios::binary | std::ios::ate);
  if (!*stream) return Refuse(response, 404, "the file is there no more");
  const auto size = static_cast<std::size_t>(stream->tellg());
  response.set_header("Cache-Control", "no-store");
  response.set_header("Content-Disposition", "attachment; filename=\"" + file->name + "\"");
  response.set_content_provider(
      size, "application/octet-stream",
      [stream, &desk](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        std::array<char, 16384> piece{};
        stream->seekg(static_cast<std::streamoff>(offset));
        stream->read(piece.data(), static_cast<std::streamsize>(std::min(length, piece.size())));
        const auto got = static_cast<std::size_t>(stream->gcount());
        return got > 0 && !desk.closed() && sink.write(piece.data(), got);
      });
}

}  // namespace

void ServeTransfers(http::Server& server, Desk& desk, Transfers& transfers) {
  server.Allow({.method = "POST",
                .path = kUploads,
                .body_bytes = Transfers::kMostUploadBytes,
                .patience = kTransfersPatience});
  server.Allow({.method = "GET", .path = "/api/transfers/", .patience = kTransfersPatience});
  server.Post("/api/transfers", [&](const Request& request, Response& response) {
    Fetch(desk, transfers, request, response);
  });
  server.Post(kUploads,
              [&](const Request& request, Response& response, const httplib::ContentReader& read) {
                Upload(desk, transfers, request, response, read);
              });
  server.Get("/api/transfers/([0-9a-f]{16})", [&](const Request& request, Response& response) {
    const auto progress = transfers.Find(request.matches[1]);
    if (!progress) return Refuse(response, progress.error());
    Answer(response, 200, ProgressBody(*progress));
  });
  server.Get("/api/transfers/([0-9a-f]{16})/file", [&](const Request& request, Response& response) {
    Download(desk, transfers, request, response);
  });
}

}  // namespace trailcast::console
