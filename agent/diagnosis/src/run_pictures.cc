#include "agent/diagnosis/run_pictures.h"

#include <algorithm>

#include "agent/diagnosis/src/protobuf_reader.h"
#include "agent/diagnosis/src/run_log_messages.h"
#include "agent/diagnosis/src/viewer_messages.h"
#include "services/base/time.h"

namespace trailcast::agent {
namespace {

using std::chrono::nanoseconds;

// A row's time may be seconds since 1970 in a double.
constexpr nanoseconds kRounded = std::chrono::microseconds(1);
// An older picture shows another place.
constexpr std::chrono::seconds kOldest{3};

nanoseconds At(double t_s) {
  constexpr double kLatest_s = 9e9;  // within the range of nanoseconds
  return FromSeconds(std::clamp(t_s, 0.0, kLatest_s));
}

}  // namespace

RunPictures::RunPictures(std::unique_ptr<bag::Bag> bag) : bag_(std::move(bag)) {
  for (const bag::Topic& topic : bag_->topics()) {
    if (topic.messages == 0) continue;
    if (topic.name == kPicturesTopic) pictures_ = &topic;
    if (topic.name == kFeaturesTopic) features_ = &topic;
  }
}

Result<std::unique_ptr<RunPictures>> RunPictures::Open(const std::filesystem::path& file) {
  auto bag = OpenMcap(file);
  if (!bag) return tl::unexpected(bag.error());
  std::unique_ptr<RunPictures> pictures(new RunPictures(std::move(*bag)));
  if (pictures->pictures_ == nullptr && pictures->features_ == nullptr) {
    return Fail(ErrorCode::kInvalidArgument, "this log has no pictures");
  }
  return pictures;
}

Result<std::optional<bag::Message>> RunPictures::NextUntil(nanoseconds until) {
  auto message = bag_->Next();
  if (message && *message && (*message)->logged_at > until) return std::nullopt;
  return message;
}

Result<std::vector<SeenFeature>> RunPictures::FeaturesAt(double t_s) {
  if (features_ == nullptr) return {};
  const nanoseconds at = At(t_s);
  bag_->Begin(*features_, std::max(at - kRounded, nanoseconds(0)));
  const auto message = NextUntil(at + kRounded);
  if (!message) return tl::unexpected(message.error());
  return *message ? ReadFeatures((*message)->bytes) : std::vector<SeenFeature>();
}

Result<std::optional<RunPictures::Picture>> RunPictures::PictureUntil(double t_s) {
  if (pictures_ == nullptr) return std::nullopt;
  const nanoseconds at = At(t_s);
  bag_->Begin(*pictures_, std::max(at - kOldest, nanoseconds(0)));
  std::optional<Picture> last;
  while (true) {
    const auto message = NextUntil(at + kRounded);
    if (!message) return tl::unexpected(message.error());
    if (!*message) return last;
    ProtobufReader reader((*message)->bytes);
    while (const auto field = reader.Next()) {
      const bool is_jpeg = field->number == 2 && field->bytes.size() > 2 &&
                           field->bytes.size() <= kMostPictureBytes && field->bytes[0] == 0xFF &&
                           field->bytes[1] == 0xD8;
      if (!is_jpeg) continue;
      last = Picture{Seconds((*message)->logged_at), {field->bytes.begin(), field->bytes.end()}};
    }
  }
}

}  // namespace trailcast::agent
