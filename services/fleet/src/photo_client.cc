#include "services/fleet/photo_client.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "services/base/csv_line.h"
#include "services/base/file_name.h"
#include "services/base/hex.h"
#include "services/base/local_time.h"
#include "services/base/time.h"
#include "services/fleet/src/ask_all.h"
#include "services/program/json.h"
#include "services/route/digest.h"

namespace trailcast::fleet {
namespace {

using program::Json;
using program::Rounded;
using std::chrono::milliseconds;

constexpr milliseconds kAskPieceAgain{500};
constexpr milliseconds kPieceWait{50};
constexpr double kCentimetres = 100.0;

// "2026-11-30T09:15:02Z"
std::string UtcText(std::int64_t unix_ms) {
  const std::chrono::system_clock::time_point time{milliseconds(unix_ms)};
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

}  // namespace

std::vector<KnownPhoto> PhotosIn(const AgentId& server, const std::vector<std::string>& lines) {
  std::vector<KnownPhoto> known;
  for (const std::string& line : lines) {
    if (auto photo = photos::ParsePhoto(line)) known.push_back({server, *std::move(photo)});
  }
  return known;
}

Result<std::vector<KnownPhoto>> AskForPhotos(exchange::RouteExchange& exchange,
                                             const AgentId& client, const photos::PhotoQuery& query,
                                             std::size_t limit, milliseconds timeout) {
  const auto lines = AskAllForLines(exchange, client, ToText(query), timeout, limit);
  if (!lines) return tl::unexpected(lines.error());
  std::vector<KnownPhoto> all;
  for (const auto& [server, told] : *lines) {
    auto of_server = PhotosIn(server, told);
    std::move(of_server.begin(), of_server.end(), std::back_inserter(all));
  }
  std::stable_sort(all.begin(), all.end(), [](const KnownPhoto& a, const KnownPhoto& b) {
    return a.photo.taken_unix_ms > b.photo.taken_unix_ms;
  });
  if (all.size() > limit) all.resize(limit);
  return all;
}

PhotoFetch::PhotoFetch(AgentId client, KnownPhoto known)
    : client_(std::move(client)), known_(std::move(known)) {}

exchange::PhotoRequest PhotoFetch::Asks() const {
  return {.client = client_,
          .holder = known_.server,
          .photo = known_.photo.id,
          .offset = static_cast<std::uint32_t>(jpeg_.size())};
}

bool PhotoFetch::Hear(const exchange::Message& message) {
  const auto* piece = std::get_if<exchange::PhotoPiece>(&message);
  const bool is_its = piece != nullptr && piece->client == client_ &&
                      piece->holder == known_.server && piece->photo == known_.photo.id;
  if (!is_its || outcome_ || piece->offset != jpeg_.size()) return false;
  if (!piece->error.empty()) {
    outcome_ = Fail(ErrorCode::kNotFound, "server '{}': {}", known_.server.value(), piece->error);
    return true;
  }
  jpeg_.insert(jpeg_.end(), piece->bytes.begin(), piece->bytes.end());
  if (jpeg_.size() < known_.photo.bytes) return !piece->bytes.empty();
  if (route::Sha256(jpeg_) == known_.photo.digest) {
    outcome_ = std::move(jpeg_);
  } else {
    outcome_ = Fail(ErrorCode::kCorrupt, "photo {} is damaged on the disk of server '{}'",
                    known_.photo.id, known_.server.value());
  }
  return true;
}

Result<std::vector<std::uint8_t>> FetchPhoto(exchange::RouteExchange& exchange,
                                             const AgentId& client, const KnownPhoto& known,
                                             milliseconds timeout) {
  using Clock = std::chrono::steady_clock;
  PhotoFetch fetch(client, known);
  auto deadline = Clock::now() + timeout;
  auto ask_at = Clock::now();
  while (!fetch.outcome() && Clock::now() < deadline) {
    if (Clock::now() >= ask_at) {
      (void)exchange.Publish(fetch.Asks());  // repeated if it could not be sent
      ask_at = Clock::now() + kAskPieceAgain;
    }
    for (const exchange::Message& message : exchange.Take(kPieceWait)) {
      if (!fetch.Hear(message)) continue;
      ask_at = Clock::now();
      deadline = ask_at + timeout;
    }
  }
  if (fetch.outcome()) return *fetch.outcome();
  return Fail(ErrorCode::kUnavailable, "server '{}' does not send photo {} within {:.1f} s",
              known.server.value(), known.photo.id, Seconds(timeout));
}

std::string FileNameOf(const photos::Photo& photo) {
  std::string time = UtcText(photo.taken_unix_ms);
  std::replace(time.begin(), time.end(), ':', '-');
  return ForFileName(fmt::format("{}-{}-{}-{}.jpg", time, SpotText(photo), photo.robot.value(),
                                 photo.id.substr(0, 4)));
}

std::string PhotosCsv(std::span<const KnownPhoto> photos) {
  std::string text =
      "file,taken_utc,robot,mission,route,revision,place,spot_m,along_m,sure,backwards,width_px,"
      "height_px,bytes,sha256,photo\n";
  for (const auto& [server, photo] : photos) {
    text += fmt::format("{},{},{},{},{},{},{},{:.2f},{:.2f},{:d},{:d},{},{},{},{},{}\n",
                        CsvText(FileNameOf(photo)), UtcText(photo.taken_unix_ms),
                        CsvText(photo.robot.value()), CsvText(photo.mission), CsvText(photo.route),
                        photo.revision, CsvText(photo.place), photo.spot_m, photo.along_m,
                        photo.sure, photo.backwards, photo.width_px, photo.height_px, photo.bytes,
                        ToHex(photo.digest), photo.id);
  }
  return text;
}

std::string PhotosTable(std::span<const KnownPhoto> photos) {
  if (photos.empty()) return "no photos\n";
  std::size_t spot = 5;
  std::size_t robot = 5;
  std::size_t mission = 7;
  for (const auto& [server, photo] : photos) {
    spot = std::max(spot, SpotText(photo).size());
    robot = std::max(robot, photo.robot.value().size());
    mission = std::max(mission, photo.mission.size());
  }
  const auto line = [&](const auto&... each) {
    return fmt::format("{:<16}  {:<20}  {:<{}}  {:<{}}  {:<{}}  {:>7}  {}\n", each...);
  };
  std::string text =
      line("photo", "taken", "place", spot, "robot", robot, "mission", mission, "kB", "where");
  for (const auto& [server, photo] : photos) {
    text +=
        line(photo.id, LocalText(photo.taken_unix_ms), SpotText(photo), spot, photo.robot.value(),
             robot, photo.mission, mission, fmt::format("{:.1f}", 1e-3 * photo.bytes),
             fmt::format("{} at {:.1f} m{}", photo.route, photo.along_m,
                         photo.sure ? "" : ", not sure"));
  }
  return text;
}

Json PhotoJson(const KnownPhoto& known) {
  const photos::Photo& photo = known.photo;
  return {{"id", photo.id},
          {"taken_unix_ms", photo.taken_unix_ms},
          {"robot", photo.robot.value()},
          {"mission", photo.mission},
          {"route", photo.route},
          {"revision", photo.revision},
          {"place", photo.place.empty() ? Json(nullptr) : Json(photo.place)},
          {"spot_m", Rounded(photo.spot_m, kCentimetres)},
          {"along_m", Rounded(photo.along_m, kCentimetres)},
          {"sure", photo.sure},
          {"backwards", photo.backwards},
          {"width_px", photo.width_px},
          {"height_px", photo.height_px},
          {"bytes", photo.bytes},
          {"sha256", ToHex(photo.digest)},
          {"server", known.server.value()}};
}

Json PhotosJson(std::span<const KnownPhoto> photos) {
  Json all = Json::array();
  for (const KnownPhoto& known : photos) all.push_back(PhotoJson(known));
  return all;
}

}  // namespace trailcast::fleet
