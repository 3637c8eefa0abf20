#include "agent/device/src/still_picture_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "services/base/square.h"

namespace trailcast::agent {
namespace {

// Standing need not be known more precisely than this, so the pictures in between are skipped.
constexpr std::chrono::milliseconds kLooksEvery{100};
// Light changes, so after this time a new picture is kept, unless somebody is in it who was not
// there before.
constexpr std::chrono::milliseconds kKept{1000};
constexpr double kUnhidden = 0.8;
// Something that hides the view for longer is there to stay.
constexpr std::chrono::milliseconds kHidden{2000};
// If a visible scene does not show for so long that the robot stands, the robot may as well have
// moved.
constexpr std::chrono::milliseconds kInDoubt{300};
// Fewer features agree by chance.
constexpr std::size_t kFewestAgree = 8;
// This share of the kept picture must be seen where it was. The same share of what is still visible
// must agree, although a fast drive leaves little of it.
constexpr double kMost = 0.5;
constexpr double kSomeMove = 0.25;
// The noise of a tracked feature.
constexpr double kNoise_px = 0.3;
// The tolerance beside the flow of the whole picture, and as a share of that flow, because near
// things move more than far ones.
constexpr double kAgrees_px = 1.0;
constexpr double kAgrees_share = 0.3;
// The shaking of a standing robot, as a share of the picture's width, and as growth. A robot that
// drives at half a metre a second towards things 50 m away makes the picture grow by that share
// within a third of a second.
constexpr double kStill_flow = 0.003;
constexpr double kStill_growth = 0.003;
constexpr double kSureSigmas = 2.0;

// Weighs each feature by the part of the picture that it has for itself among the kept ones, so
// that a person with many features counts no more than his size.
class Areas {
 public:
  Areas(const std::vector<route::TrackedFeature>& features, int width, int height)
      : width_(width), height_(height) {
    for (const route::TrackedFeature& feature : features) ++count_[CellOf(feature)];
  }
  [[nodiscard]] double Of(const std::vector<teach::MovedFeature>& features) const {
    double area = 0.0;
    for (const teach::MovedFeature& each : features) area += 1.0 / count_[CellOf(each.before)];
    return area;
  }
  [[nodiscard]] double all() const {
    return static_cast<double>(
        std::count_if(count_.begin(), count_.end(), [](int count) { return count > 0; }));
  }

 private:
  static constexpr int kColumns = 6;
  static constexpr int kRows = 4;
  [[nodiscard]] std::size_t CellOf(const route::TrackedFeature& at) const {
    const auto cell = [](double place_px, int size_px, int cells) {
      return std::clamp(static_cast<int>((place_px / size_px + 0.5) * cells), 0, cells - 1);
    };
    return static_cast<std::size_t>(cell(at.v_px, height_, kRows) * kColumns +
                                    cell(at.u_px, width_, kColumns));
  }
  int width_;
  int height_;
  std::array<int, std::size_t{kColumns} * kRows> count_{};
};

// How far the flow moves a feature.
struct Shift {
  double u_px = 0.0;
  double v_px = 0.0;
  [[nodiscard]] double length() const { return std::hypot(u_px, v_px); }
};

Shift By(const teach::PictureFlow& flow, const route::TrackedFeature& at) {
  return {flow.u_px + flow.growth * at.u_px, flow.v_px + flow.growth * at.v_px};
}

bool Agrees(const teach::MovedFeature& feature, const teach::PictureFlow& flow) {
  const Shift by = By(flow, feature.before);
  const double off_px = std::hypot(feature.now.u_px - feature.before.u_px - by.u_px,
                                   feature.now.v_px - feature.before.v_px - by.v_px);
  return off_px <= kAgrees_px + kAgrees_share * by.length();
}

// Returns the variance of the growth that these features agree on.
double GrowthVariance(const std::vector<teach::MovedFeature>& agreed,
                      const teach::PictureFlow& flow) {
  double off2 = 0.0;
  double sum_u = 0.0;
  double sum_v = 0.0;
  double squares = 0.0;
  for (const auto& [before, now] : agreed) {
    const Shift by = By(flow, before);
    off2 += Square(now.u_px - before.u_px - by.u_px) + Square(now.v_px - before.v_px - by.v_px);
    sum_u += before.u_px;
    sum_v += before.v_px;
    squares += Square(before.u_px) + Square(before.v_px);
  }
  const auto count = static_cast<double>(agreed.size());
  // Features at one place cannot tell growth from shift.
  const double spread2 = squares - (Square(sum_u) + Square(sum_v)) / count;
  return 0.5 * off2 / count / std::max(1.0, spread2);
}

double MeanShift_px(const std::vector<teach::MovedFeature>& features,
                    const teach::PictureFlow& flow) {
  double sum_px = 0.0;
  for (const teach::MovedFeature& each : features) sum_px += By(flow, each.before).length();
  return sum_px / static_cast<double>(features.size());
}

teach::PictureFlow Sum(const teach::PictureFlow& one, const teach::PictureFlow& other) {
  return {one.u_px + other.u_px, one.v_px + other.v_px, one.growth + other.growth};
}

}  // namespace

StillPictureWatch::Look StillPictureWatch::Compare(const image::GrayImage& picture) {
  std::vector<teach::MovedFeature> found = teach::MovedBetween(features_, tracker_.Track(picture));
  Look look;
  look.flow = teach::FlowOf(found, kNoise_px);
  const Areas areas(features_, picture.width, picture.height);
  const double found_area = areas.Of(found);
  std::erase_if(found, [&](const auto& each) { return !Agrees(each, look.flow); });
  const double area = areas.Of(found);
  if (found.size() < kFewestAgree || area < kMost * found_area) return look;
  look.seen = area / areas.all();
  look.growth2 = GrowthVariance(found, look.flow);
  const teach::PictureFlow all = Sum(came_, look.flow);
  const double growth = std::abs(all.growth);
  const double unsure = kSureSigmas * std::sqrt(came_growth2_ + look.growth2);
  if (MeanShift_px(found, all) > kStill_flow * picture.width || growth - unsure > kStill_growth) {
    if (look.seen >= kSomeMove) look.verdict = Verdict::kMoves;
  } else if (growth + unsure < kStill_growth && look.seen >= kMost) {
    look.verdict = Verdict::kStands;
  }
  return look;
}

void StillPictureWatch::Keep(const image::GrayImage& picture, SensorTime stamp) {
  features_ = tracker_.Detect();
  kept_ = picture;
  kept_at_ = stood_at_ = stamp;
}

bool StillPictureWatch::Over(SensorTime stamp, const image::GrayImage& camera) {
  if (limit_ <= std::chrono::milliseconds(0)) return false;
  if (looked_at_ && stamp - *looked_at_ < kLooksEvery) return false;
  if (!looked_at_) camera_ = {camera.width, camera.height};
  if (camera.width != camera_.width || camera.height != camera_.height) return false;
  looked_at_ = stamp;
  const image::GrayImage& picture = intake_.Take(camera);
  const Look look = Compare(picture);
  const bool stands = look.verdict == Verdict::kStands;
  const bool moves = look.verdict == Verdict::kMoves;
  if (stands) stood_at_ = stamp;
  const auto patience = look.seen < kMost ? kHidden : kInDoubt;
  const bool waits = features_.size() >= kFewestAgree && stamp - stood_at_ < patience;
  if (moves || !(stands || waits)) {
    moved_ = moved_ || moves;
    came_ = {};
    came_growth2_ = 0.0;
    since_ = stamp;
    Keep(picture, stamp);
  } else if (stands && look.seen >= kUnhidden && stamp - kept_at_ >= kKept) {
    came_ = Sum(came_, look.flow);
    came_growth2_ += look.growth2;
    Keep(picture, stamp);
  } else {
    tracker_.Follow({});
    (void)tracker_.Track(kept_);
    tracker_.Follow(features_);
  }
  return moved_ && stands && stamp - since_ >= limit_;
}

}  // namespace trailcast::agent
