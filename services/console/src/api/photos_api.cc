#include "services/console/src/api/photos_api.h"

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "services/base/unix_time.h"
#include "services/console/parameters.h"
#include "services/console/src/api/answers.h"
#include "services/console/src/api/tar.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;
using program::Json;
using program::OneLine;
using program::Rounded;

constexpr int kMostFolders = 2;  // that are sent at once
constexpr std::size_t kMostInFolder = 5000;
constexpr std::int64_t kMsPerS = 1000;

void List(Album& album, const Request& request, Response& response) {
  const auto query = ReadPhotosQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto page = album.List(query->of, query->first);
  if (!page) return Refuse(response, page.error());
  Json silent = Json::array();
  for (const AgentId& server : page->silent) silent.push_back(server.value());
  Answer(response, 200,
         OneLine({{"photos", fleet::PhotosJson(page->photos)},
                  {"next", page->next},
                  {"silent", std::move(silent)}}));
}

void Show(Album& album, const std::string& id, Response& response) {
  const auto known = album.Find(id);
  if (!known) return Refuse(response, known.error());
  const auto visits = album.Visits(*known);
  if (!visits) return Refuse(response, visits.error());
  Answer(response, 200,
         OneLine({{"photo", fleet::PhotoJson(*known)}, {"visits", fleet::PhotosJson(*visits)}}));
}

// A photo never changes.
void AnswerJpeg(Response& response, const std::vector<std::uint8_t>& jpeg) {
  response.set_header("Cache-Control", "private, max-age=604800, immutable");
  response.set_content(reinterpret_cast<const char*>(jpeg.data()), jpeg.size(), "image/jpeg");
}

void ShowPicture(Album& album, const std::string& id, Response& response) {
  const auto jpeg =
      album.Find(id).and_then([&](const fleet::KnownPhoto& known) { return album.Picture(known); });
  if (!jpeg) return Refuse(response, jpeg.error());
  AnswerJpeg(response, **jpeg);
}

Result<std::shared_ptr<const Album::Changes>> Compare(Album& album, const Request& request) {
  const std::string since = request.get_param_value("since");
  if (!photos::IsPhotoId(since)) {
    return Fail(ErrorCode::kInvalidArgument, "'since' is to be the id of an earlier photo");
  }
  const auto later = album.Find(request.matches[1]);
  if (!later) return tl::unexpected(later.error());
  const auto earlier = album.Find(since);
  if (!earlier) return tl::unexpected(earlier.error());
  return album.Compare(*earlier, *later);
}

// That two photos do not align is an answer, too.
void ShowChanges(Album& album, const Request& request, Response& response) {
  const auto compared = Compare(album, request);
  if (!compared && compared.error().code != ErrorCode::kConflict) {
    return Refuse(response, compared.error());
  }
  Json changes = Json::array();
  if (compared) {
    for (const photos::ChangedRegion& region : (*compared)->comparison.changes) {
      changes.push_back({{"x", region.x},
                         {"y", region.y},
                         {"width", region.width},
                         {"height", region.height},
                         {"contrast", Rounded(region.contrast, 10.0)}});
    }
  }
  Answer(response, 200,
         OneLine({{"aligned", compared.has_value()},
                  {"why", compared ? std::string() : compared.error().message},
                  {"overlap", compared ? Json(Rounded((*compared)->comparison.overlap, 1000.0))
                                       : Json(nullptr)},
                  {"changes", std::move(changes)}}));
}

void ShowEarlier(Album& album, const Request& request, Response& response) {
  const auto compared = Compare(album, request);
  if (!compared) return Refuse(response, compared.error());
  AnswerJpeg(response, *(*compared)->earlier);
}

// A folder as one archive: photo after photo, and photos.csv last.
class Folder {
 public:
  Folder(Album& album, std::vector<fleet::KnownPhoto> photos)
      : album_(album), photos_(std::move(photos)) {}

  // Sends the next part. Returns false if there is none, because a photo cannot be fetched: an
  // archive that breaks off is seen to be broken.
  bool SendNext(httplib::DataSink& sink) {
    if (next_ > photos_.size()) return false;
    const bool last = next_ == photos_.size();
    std::string part;
    if (last) {
      const std::string csv = fleet::PhotosCsv(photos_);
      part = TarHeader("photos/photos.csv", csv.size(), NowUnixMs() / kMsPerS) + csv +
             TarPadding(csv.size()) + TarEnd();
    } else {
      const fleet::KnownPhoto& known = photos_[next_];
      const auto jpeg = album_.Picture(known);
      if (!jpeg) return false;
      part = TarHeader("photos/" + fleet::FileNameOf(known.photo), (*jpeg)->size(),
                       known.photo.taken_unix_ms / kMsPerS);
      part.append((*jpeg)->begin(), (*jpeg)->end());
      part += TarPadding((*jpeg)->size());
    }
    ++next_;
    if (!sink.write(part.data(), part.size())) return false;
    if (last) sink.done();
    return true;
  }

 private:
  Album& album_;
  std::vector<fleet::KnownPhoto> photos_;
  std::size_t next_ = 0;
};

void SendFolder(Album& album, std::atomic<int>& sending, const Request& request,
                Response& response) {
  auto seat = std::shared_ptr<void>(nullptr, [&sending](void*) { --sending; });
  if (++sending > kMostFolders) {
    return Refuse(response, 503, "too many folders of photos are sent at once: try again");
  }
  const auto query = ReadPhotosQuery(request.params);
  if (!query) return Refuse(response, query.error());
  auto page = album.List(query->of, query->first, kMostInFolder);
  if (!page) return Refuse(response, page.error());
  if (!page->silent.empty()) {
    return Refuse(response, 503,
                  Album::SilentText(*page) + ", so that the folder would lack photos: try again");
  }
  if (page->photos.empty()) return Refuse(response, 404, "there are no such photos");
  response.set_header("Cache-Control", "no-store");
  response.set_header("Content-Disposition", "attachment; filename=\"photos.tar\"");
  response.set_chunked_content_provider(
      "application/x-tar",
      [seat = std::move(seat), folder = std::make_shared<Folder>(album, std::move(page->photos))](
          std::size_t, httplib::DataSink& sink) { return folder->SendNext(sink); });
}

}  // namespace

void ServePhotos(http::Server& server, Album& album) {
  server.Get("/api/photos", [&album](const Request& request, Response& response) {
    List(album, request, response);
  });
  const auto sending = std::make_shared<std::atomic<int>>(0);
  server.Get("/api/photos.tar", [&album, sending](const Request& request, Response& response) {
    SendFolder(album, *sending, request, response);
  });
  const std::string one = "/api/photos/([0-9a-f]{16})";
  server.Get(one, [&album](const Request& request, Response& response) {
    Show(album, request.matches[1], response);
  });
  server.Get(one + "/picture", [&album](const Request& request, Response& response) {
    ShowPicture(album, request.matches[1], response);
  });
  server.Get(one + "/changes", [&album](const Request& request, Response& response) {
    ShowChanges(album, request, response);
  });
  server.Get(one + "/earlier", [&album](const Request& request, Response& response) {
    ShowEarlier(album, request, response);
  });
}

}  // namespace trailcast::console
