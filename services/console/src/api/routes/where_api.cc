#include "services/console/src/api/routes/where_api.h"

#include <fmt/format.h>

#include <atomic>
#include <memory>
#include <mutex>

#include "services/console/src/api/answers.h"
#include "services/fleet/routes/picture_query.h"
#include "services/fleet/routes/where_report.h"
#include "services/image/files.h"
#include "services/image/picture_check.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

constexpr const char* kPath = "/api/where";
constexpr std::size_t kMostBytes = 4U << 20U;
constexpr std::uint64_t kMostPixels = 6'000'000;
constexpr std::chrono::milliseconds kWherePatience{30'000};

// Bodies are read a few at a time, and decoded one at a time, because decoding takes ten times the
// memory.
constexpr int kMostAtOnce = 3;
struct Turns {
  std::atomic<int> taken{0};
  std::mutex decodes{};
};

Result<route::RouteQuery> QueryOf(const std::string& body, std::mutex& decodes) {
  const std::scoped_lock turn(decodes);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(body.data()), body.size());
  if (auto fit = image::CheckPicture(bytes, kMostPixels); !fit) return tl::unexpected(fit.error());
  return image::DecodeGray(bytes, "that was sent").and_then([](const image::GrayImage& picture) {
    return fleet::QueryByPicture(picture, "the picture");
  });
}

void Find(Desk& desk, Turns& turns, const httplib::ContentReader& read, Response& response) {
  const std::shared_ptr<void> turn(nullptr, [&turns](void*) { --turns.taken; });
  if (++turns.taken > kMostAtOnce) {
    return Refuse(response, 503, "other pictures are looked at: try again in a moment");
  }
  std::string body;
  const bool came = read([&](const char* data, std::size_t size) {
    body.append(data, size);
    return body.size() <= kMostBytes;
  });
  if (!came) return Refuse(response, 400, "the picture did not come whole");
  const auto query = QueryOf(body, turns.decodes);
  if (!query) return Refuse(response, query.error());
  const auto reply = desk.Routes(*query);
  if (!reply) return Refuse(response, reply.error());
  Answer(response, 200, program::OneLine(fleet::WhereJson(*reply)));
}

}  // namespace

void ServeWhere(http::Server& server, Desk& desk) {
  server.Allow(
      {.method = "POST", .path = kPath, .body_bytes = kMostBytes, .patience = kWherePatience});
  server.Post(kPath, [&desk, turns = std::make_shared<Turns>()](
                         const Request&, Response& response, const httplib::ContentReader& read) {
    Find(desk, *turns, read, response);
  });
}

}  // namespace trailcast::console
