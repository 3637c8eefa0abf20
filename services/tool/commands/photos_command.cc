// This is `trailcast photos`.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "services/base/text_file.h"
#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/photo_client.h"
#include "services/image/files.h"
#include "services/photos/compare.h"
#include "services/program/json.h"
#include "services/tool/commands/command.h"
#include "services/tool/commands/time_spans.h"

namespace trailcast::tool {
namespace {

namespace fs = std::filesystem;
using fleet::KnownPhoto;

struct PhotosOptions {
  photos::PhotoQuery query;
  std::string place;
  double newer_than_s = 0.0;
  std::size_t limit = 1000;
  std::string to;
  bool compare = false;
  bool json = false;
  double timeout_s = 5.0;
};

constexpr const char* kPhotosExamples =
    "Examples:\n"
    "  trailcast send robot2 follow hall --photo-every 5 --photo-at dock   # takes them\n"
    "  trailcast photos --mission 4f2a09c1d3e5b687\n"
    "  trailcast photos --place dock --newer-than 30d          # this visit, and those before\n"
    "  trailcast photos --mission 4f2a09c1d3e5b687 --to round/ # JPEG files, and photos.csv\n"
    "  trailcast photos --place dock --compare                 # what has changed since the last\n"
    "A robot keeps its photos on its disk until a server has them on its own, so that those of a\n"
    "robot that is out of reach are not listed yet. Photos of a place are of all missions that\n"
    "passed it, also of those that did not arrive.\n"
    "Exit status: 0 listed, fetched or compared; 1 no server, or a photo could not be fetched; 2 "
    "wrong\nusage; 4 with --compare: the two do not align, or there are not two.";
constexpr int kExitNotCompared = 4;

Result<void> WriteBytes(const fs::path& file, const std::vector<std::uint8_t>& bytes) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) return {};
  return Fail(ErrorCode::kUnavailable, "cannot write {}: is the disk full?", file.string());
}

// A photo that is there from before, by its size, is not fetched again.
Result<void> FetchAll(fleet::OperatorPeer& peer, const std::vector<KnownPhoto>& photos,
                      const PhotosOptions& options) {
  const fs::path folder = options.to;
  std::error_code failed;
  fs::create_directories(folder, failed);
  for (const KnownPhoto& known : photos) {
    const fs::path file = folder / fleet::FileNameOf(known.photo);
    std::error_code missing;
    if (fs::file_size(file, missing) == known.photo.bytes && !missing) continue;
    const auto jpeg =
        fleet::FetchPhoto(*peer.exchange, peer.self, known, ToMilliseconds(options.timeout_s));
    if (!jpeg) return tl::unexpected(jpeg.error());
    if (auto written = WriteBytes(file, *jpeg); !written) return written;
  }
  return WriteTextFile(folder / "photos.csv", fleet::PhotosCsv(photos));
}

Result<image::GrayImage> Fetch(fleet::OperatorPeer& peer, const KnownPhoto& known,
                               const PhotosOptions& options) {
  const auto jpeg =
      fleet::FetchPhoto(*peer.exchange, peer.self, known, ToMilliseconds(options.timeout_s));
  if (!jpeg) return tl::unexpected(jpeg.error());
  return image::DecodeGray(*jpeg, "photo " + known.photo.id);
}

std::string Named(const KnownPhoto& known) {
  return fmt::format("{} of {}", known.photo.id, SpotText(known.photo));
}

// Compares the last photo with the last one of the same spot from another mission.
int Compare(const CLI::App& app, fleet::OperatorPeer& peer, const std::vector<KnownPhoto>& photos,
            const PhotosOptions& options) {
  const auto before =
      photos.empty() ? photos.end()
                     : std::find_if(photos.begin() + 1, photos.end(), [&](const KnownPhoto& each) {
                         return AreOfOneSpot(each.photo, photos.front().photo) &&
                                each.photo.mission != photos.front().photo.mission;
                       });
  if (before == photos.end()) {
    (void)program::Complain(app, {ErrorCode::kNotFound,
                                  "there are no photos of one place from two missions: '--place "
                                  "PLACE' says of which"});
    return kExitNotCompared;
  }
  const auto later = Fetch(peer, photos.front(), options);
  if (!later) return program::Complain(app, later.error());
  const auto earlier = Fetch(peer, *before, options);
  if (!earlier) return program::Complain(app, earlier.error());
  const auto compared = photos::Compare(*earlier, *later);
  if (!compared) {
    (void)program::Complain(app, compared.error());
    return kExitNotCompared;
  }
  if (options.json) {
    program::Json changes = program::Json::array();
    for (const photos::ChangedRegion& region : compared->changes) {
      changes.push_back({{"x", region.x},
                         {"y", region.y},
                         {"width", region.width},
                         {"height", region.height},
                         {"contrast", program::Rounded(region.contrast, 10.0)}});
    }
    fmt::print("{}", program::Indented({{"photo", fleet::PhotoJson(photos.front())},
                                        {"before", fleet::PhotoJson(*before)},
                                        {"overlap", program::Rounded(compared->overlap, 1000.0)},
                                        {"changes", std::move(changes)}}));
    return program::kExitOk;
  }
  fmt::print("{}, compared with {}: {}\n", Named(photos.front()), Named(*before),
             compared->changes.empty() ? "no change was found" : "changes at");
  for (const photos::ChangedRegion& region : compared->changes) {
    fmt::print("  {}x{} pixels at {}, {}\n", region.width, region.height, region.x, region.y);
  }
  return program::kExitOk;
}

int Photos(const CLI::App& app, const program::CommonOptions& common, PhotosOptions options) {
  if (!options.place.empty()) {
    auto at = photos::AtPlace(options.query, options.place);
    if (!at) return ComplainOfUsage(app, at.error());
    options.query = *std::move(at);
  }
  if (options.newer_than_s > 0.0) {
    options.query.from_unix_ms =
        NowUnixMs() - static_cast<std::int64_t>(1e3 * options.newer_than_s);
  }
  exchange::TopicUse use = exchange::NetworkTopics();
  const exchange::TopicUse fetches = exchange::PhotoTopics();
  use.write.insert(use.write.end(), fetches.write.begin(), fetches.write.end());
  use.read.insert(use.read.end(), fetches.read.begin(), fetches.read.end());
  auto peer = fleet::JoinAsOperator(common, use);
  if (!peer) return program::Complain(app, peer.error());
  const auto photos = fleet::AskForPhotos(*peer->exchange, peer->self, options.query, options.limit,
                                          ToMilliseconds(options.timeout_s));
  if (!photos) return program::Complain(app, photos.error());
  if (options.compare) return Compare(app, *peer, *photos, options);
  if (!options.to.empty()) {
    if (const auto fetched = FetchAll(*peer, *photos, options); !fetched) {
      return program::Complain(app, fetched.error());
    }
  }
  const std::string text =
      options.json ? program::Indented(fleet::PhotosJson(*photos)) : fleet::PhotosTable(*photos);
  std::fputs(text.c_str(), stdout);
  return program::kExitOk;
}

}  // namespace

Command AddPhotosCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<PhotosOptions>();
  CLI::App* app = parent.add_subcommand(
      "photos", "List, fetch and compare the photos that robots took on missions");
  app->footer(kPhotosExamples);
  const auto name = [&](const char* flag, std::string& value, const char* help) {
    return app->add_option(flag, value, help)->check(program::NameValidator());
  };
  name("--robot", options->query.robot, "Only by this one");
  name("--mission", options->query.mission, "Only of this mission");
  name("--route", options->query.route, "Only along this route, by its name");
  app->add_option("--place", options->place,
                  "Only of this place: its name, or ROUTE@METRES as hall@12.5");
  app->add_option("--newer-than", options->newer_than_s, "Only taken since: 90min, 12h, 7d; 0: any")
      ->transform(TimeSpan("AGE"));
  app->add_option("--limit", options->limit, "Photos at most, the last taken first")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  auto* to = app->add_option("--to", options->to,
                             "Fetch them into this folder, as JPEG files beside photos.csv; made "
                             "if missing; those that are there already are not fetched again");
  app->add_flag("--compare", options->compare,
                "Align the last one with the one before it of the same place, from another "
                "mission, and tell what has changed")
      ->excludes(to);
  app->add_flag("--json", options->json, "For programs");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Photos(*app, common, *options); }};
}

}  // namespace trailcast::tool
