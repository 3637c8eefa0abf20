#include "agent/photos/photo_taker.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "services/base/give_way.h"
#include "services/base/guarded.h"
#include "services/base/unix_time.h"
#include "services/image/files.h"
#include "services/route/digest.h"

namespace trailcast::agent {
namespace {

constexpr std::chrono::hours kPhotoWakeUp{1};  // unless something was handed over
constexpr int kPhotoNiceness = 10;
constexpr int kCoarser = 10;
constexpr int kCoarsest = 15;
constexpr std::size_t kIdDigits = 16;

Result<std::vector<std::uint8_t>> Encoded(const image::GrayImage& picture) {
  int quality = PhotoTaker::kQuality;
  auto jpeg = image::EncodeJpeg(picture, quality);
  while (jpeg && jpeg->size() > PhotoTaker::kMostBytes && quality > kCoarsest) {
    quality -= kCoarser;
    jpeg = image::EncodeJpeg(picture, quality);
  }
  if (jpeg && jpeg->size() > PhotoTaker::kMostBytes) {
    return Fail(ErrorCode::kInvalidArgument, "a picture of {}x{} pixels has more than {} bytes",
                picture.width, picture.height, PhotoTaker::kMostBytes);
  }
  return jpeg;
}

}  // namespace

PhotoTaker::PhotoTaker(photos::PhotoFolder& folder) : folder_(folder), thread_([this] { Run(); }) {}

PhotoTaker::~PhotoTaker() {
  ending_ = true;
  handed_over_.Ring();
  thread_.join();
}

bool PhotoTaker::Take(photos::Photo photo, const image::GrayImage& picture) {
  photo.taken_unix_ms = NowUnixMs();
  if (!items_.TryPut({std::move(photo), picture})) return false;
  handed_over_.Ring();
  return true;
}

std::vector<std::string> PhotoTaker::TakeNews() {
  std::vector<std::string> news;
  while (auto line = news_.TryGet()) news.push_back(*std::move(line));
  return news;
}

void PhotoTaker::Run() {
  GiveWay(kPhotoNiceness);
  bool last = false;
  while (!last) {
    handed_over_.Wait(kPhotoWakeUp);
    last = ending_;
    while (auto item = items_.TryGet()) {
      // A photo that cannot be kept is missing, and the robot drives on.
      const auto kept = Guarded("the thread that keeps photos",
                                [&]() -> Result<void> { return Keep(*std::move(item)); });
      // If nobody takes the news, some of it is dropped.
      if (!kept) (void)news_.TryPut("a photo was not kept: " + kept.error().message);
    }
  }
}

Result<void> PhotoTaker::Keep(Item item) {
  auto jpeg = Encoded(item.picture);
  if (!jpeg) return tl::unexpected(jpeg.error());
  photos::Photo& photo = item.photo;
  photo.id = MakeRouteId().value().substr(0, kIdDigits);
  photo.width_px = item.picture.width;
  photo.height_px = item.picture.height;
  photo.bytes = static_cast<std::uint32_t>(jpeg->size());
  photo.digest = route::Sha256(*jpeg);
  const auto gone = folder_.Add(photo, *jpeg);
  if (!gone) return tl::unexpected(gone.error());
  if (!gone->empty()) {
    (void)news_.TryPut(fmt::format(
        "the folder of photos is full: {} of them went that no server has, the oldest, of {} in "
        "mission {}",
        gone->size(), photos::SpotText(gone->front()), gone->front().mission));
  }
  return {};
}

void PhotoRun::Pass(const Place& place, const image::GrayImage& picture) {
  if (!plan_) plan_.emplace(wish_, place.route, backwards_);
  const auto spot = plan_->Due(place.along_m, place.at_end);
  if (!spot) return;
  const bool taken = taker_.Take({.robot = robot_,
                                  .mission = mission_,
                                  .route = place.route.name,
                                  .revision = place.route.revision.value(),
                                  .along_m = place.along_m,
                                  .spot_m = spot->at_m,
                                  .place = spot->place,
                                  .sure = place.sure,
                                  .backwards = backwards_},
                                 picture);
  if (!taken) return;
  plan_->NoteTaken(*spot);
  ++taken_;
}

std::set<std::string> PhotoRun::Photographed() const {
  return plan_ ? plan_->Photographed() : std::set<std::string>();
}

}  // namespace trailcast::agent
