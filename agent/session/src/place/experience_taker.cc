#include "agent/session/src/place/experience_taker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/base/median.h"
#include "services/route/heading.h"
#include "services/route/track.h"

namespace trailcast::agent {
namespace {

using Eigen::Vector2d;
using replay::InverseDepth;

// The place is known to some centimetres, near the path, looking along it.
constexpr double kMostSigma_m = 0.05;
constexpr double kMostLeft_m = 0.3;
constexpr double kMostYaw_rad = 0.25;
constexpr std::size_t kFewestTracked = 8;
// Shorter segments say too little of how anything moves. The others are examined at these
// fractions.
constexpr double kShortest_m = 0.2;
constexpr int kMomentsASegment = 16;
constexpr std::size_t kFewestMoments = 5;
constexpr double kFirstBy = 0.12;  // fractions
constexpr double kLastFrom = 0.88;
constexpr double kAbout = 0.13;  // around a knot: the moments that tell it
// A pattern is taken at the scale of the scout's picture, from one that is not much coarser or
// finer.
constexpr double kLeastMagnification = 0.7;
constexpr double kMostMagnification = 1.5;
constexpr int kInTheMiddle = 8;
constexpr std::size_t kFewestFound = 8;
constexpr double kLeastFoundShare = 0.2;
// These are in pixels of a scout's picture 320 px wide.
constexpr double kEdge_px = 8.0;
// Most found features are within this of their taught places.
constexpr double kFoundWithin_px = 2.5;
constexpr double kMovesAlike_px = 2.5;   // with the found ones, from knot to knot
constexpr double kLeastMotion_px = 1.5;  // a feature that stays in place may be dirt on the lens
constexpr double kApart_px = 5.0;        // from features that are found already
constexpr double kNearby_px = 40.0;      // a missed feature counts where another one is seen nearby
// This counts the times that a feature should have been seen.
constexpr int kFewestExpected = 4;
constexpr double kFoundShare = 0.25;

Vector2d PlaceOf(const route::TrackKnot& knot) { return {knot.u_px, knot.v_px}; }

// Returns the value of a straight line through near samples, which reaches beyond the ends.
Vector2d LineAt(double s, const std::vector<std::pair<double, Vector2d>>& samples) {
  double weight = 0.0;
  double mean_s = 0.0;
  Vector2d mean = Vector2d::Zero();
  for (const auto& [at, place] : samples) {
    if (std::abs(at - s) > kAbout) continue;
    weight += 1.0;
    mean_s += (at - mean_s) / weight;
    mean += (place - mean) / weight;
  }
  double squares = 0.0;
  Vector2d slope = Vector2d::Zero();
  for (const auto& [at, place] : samples) {
    if (std::abs(at - s) > kAbout) continue;
    squares += (at - mean_s) * (at - mean_s);
    slope += (at - mean_s) * (place - mean);
  }
  if (weight < 2.0 || squares < 1e-6) return mean;
  return mean + slope * ((s - mean_s) / squares);
}

// Returns how a feature's knots differ from how a landmark at that depth moves on the taught path,
// for each interval between two knots.
std::vector<Vector2d> Unexplained(const route::Segment& segment, const replay::ScoutCamera& camera,
                                  const route::Feature& feature, const InverseDepth& depth) {
  const Vector2d ahead(camera.ahead_u_px, camera.ahead_v_px);
  std::vector<Vector2d> residuals;
  for (std::size_t i = 1; i < feature.track.size(); ++i) {
    const double from_m = feature.track[i - 1].s * segment.length_m;
    const double to_m = feature.track[i].s * segment.length_m;
    const Vector2d nearer =
        ahead + depth.Growth(from_m, to_m) * (PlaceOf(feature.track[i - 1]) - ahead);
    const double turn_rad =
        route::HeadingAt(segment.heading, to_m) - route::HeadingAt(segment.heading, from_m);
    residuals.push_back(PlaceOf(feature.track[i]) - camera.Turned(nearer, turn_rad));
  }
  return residuals;
}

// Returns the median for each interval.
std::vector<Vector2d> InCommon(const std::vector<std::vector<Vector2d>>& residuals) {
  std::vector<Vector2d> common;
  for (std::size_t stretch = 0; stretch < residuals.front().size(); ++stretch) {
    std::vector<double> u;
    std::vector<double> v;
    for (const std::vector<Vector2d>& each : residuals) {
      if (stretch >= each.size()) continue;
      u.push_back(each[stretch].x());
      v.push_back(each[stretch].y());
    }
    common.emplace_back(Median(u), Median(v));
  }
  return common;
}

}  // namespace

void ExperienceTaker::Look(const FrameInput& seen, const replay::Follower& follower,
                           const std::vector<route::TrackedFeature>& tracked, bool sure) {
  tracker_.Track(*seen.frame, seen.driven ? seen.driven->heading_change_rad : 0.0);
  const std::optional<replay::CameraPlace> place = follower.camera_place();
  if (!place) return;
  const bool other = !segment_ || segment_->index != follower.segment().index;
  if (other) {
    Close(follower);
    Open(follower, *place);
  }
  const bool good = sure && !follower.turning() && place->left_sigma_m < kMostSigma_m &&
                    std::abs(place->left_m) < kMostLeft_m &&
                    std::abs(place->yaw_rad) < kMostYaw_rad && tracked.size() >= kFewestTracked;
  sure_throughout_ = sure_throughout_ && good;
  if (!good || segment_->length_m < kShortest_m) return;
  const double next_s = static_cast<double>(moments_.size()) / kMomentsASegment;
  if (place->along_m / segment_->length_m >= next_s || moments_.empty()) {
    Note(*seen.frame, follower, *place, tracked);
  }
}

void ExperienceTaker::Open(const replay::Follower& follower, const replay::CameraPlace& place) {
  segment_ = follower.segment();
  segment_->key_views.clear();
  moments_.clear();
  counts_.assign(segment_->features.size(), {});
  others_.clear();
  const double k = place.magnification;
  sure_throughout_ = !segment_->reverse &&
                     std::abs(place.along_m) < kFirstBy * segment_->length_m &&
                     k > kLeastMagnification && k < kMostMagnification;
  if (!sure_throughout_) return;
  tracker_.Detect(kInTheMiddle);
  others_ = tracker_.Describe(k);
}

void ExperienceTaker::Note(const image::GrayImage& frame, const replay::Follower& follower,
                           const replay::CameraPlace& place,
                           const std::vector<route::TrackedFeature>& tracked) {
  Moment moment{place, {}, {}};
  const std::vector<route::TrackedFeature> expected = follower.Expect();
  const double most_px = follower.outlier_px() * place.magnification;
  for (const route::TrackedFeature& at : tracked) {
    const route::TrackedFeature& there = expected[static_cast<std::size_t>(at.id)];
    if (std::hypot(at.u_px - there.u_px, at.v_px - there.v_px) < most_px) {
      moment.taught[at.id] = {at.u_px, at.v_px};
    }
  }
  const double edge_px = Pixels(kEdge_px) * place.magnification;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const bool in_view = std::abs(expected[i].u_px) < 0.5 * frame.width - edge_px &&
                         std::abs(expected[i].v_px) < 0.5 * frame.height - edge_px;
    counts_[i].expected += in_view ? 1 : 0;
    counts_[i].found += moment.taught.contains(static_cast<int>(i)) ? 1 : 0;
  }
  for (const route::TrackedFeature& at : tracker_.Current()) {
    moment.other[at.id] = {at.u_px, at.v_px};
  }
  moments_.push_back(std::move(moment));
}

Eigen::Vector2d ExperienceTaker::FirstPlace(int feature) const {
  return PlaceOf(segment_->features[static_cast<std::size_t>(feature)].first());
}

std::vector<int> ExperienceTaker::Found() const {
  std::vector<int> found;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const Count& count = counts_[i];
    if (count.found > 0 && count.found >= kFoundShare * count.expected) {
      found.push_back(static_cast<int>(i));
    }
  }
  return found;
}

void ExperienceTaker::Close(const replay::Follower& follower) {
  if (!segment_ || moments_.size() < kFewestMoments) return;
  const std::vector<int> found = Found();
  refresh::SegmentVisit visit{segment_->index, {}, Offer(follower, found)};
  visit.features = Judge(found, visit.offered);
  // Indices rise: a robot that was carried back has seen this one before.
  if (visit_.segments.empty() || visit_.segments.back().index < visit.index) {
    visit_.segments.push_back(std::move(visit));
  }
}

refresh::Visit ExperienceTaker::Take(const replay::Follower& follower) {
  Close(follower);
  segment_.reset();
  return std::exchange(visit_, {});
}

// A feature is missed if it should have been in view several times, while another one was seen
// nearby.
std::vector<refresh::Sought> ExperienceTaker::Judge(
    const std::vector<int>& found, const std::vector<route::Feature>& offered) const {
  std::vector<refresh::Sought> judged(counts_.size(), refresh::Sought::kUnjudged);
  std::vector<Vector2d> seen;
  for (const int i : found) {
    judged[static_cast<std::size_t>(i)] = refresh::Sought::kFound;
    seen.push_back(FirstPlace(i));
  }
  for (const route::Feature& feature : offered) seen.push_back(PlaceOf(feature.first()));
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i].found > 0 || counts_[i].expected < kFewestExpected) continue;
    const Vector2d place = PlaceOf(segment_->features[i].first());
    if (std::any_of(seen.begin(), seen.end(), [&](const Vector2d& other) {
          return (other - place).norm() < Pixels(kNearby_px);
        })) {
      judged[i] = refresh::Sought::kMissed;
    }
  }
  return judged;
}

std::vector<route::TrackKnot> ExperienceTaker::TrackOf(int id, const InverseDepth& depth) const {
  std::vector<std::pair<double, Vector2d>> samples;
  for (const Moment& moment : moments_) {
    samples.emplace_back(
        moment.place.along_m / segment_->length_m,
        moment.place.AsTaught(moment.other.at(id), depth.At(moment.place.along_m)));
  }
  std::vector<route::TrackKnot> track;
  for (const route::TrackKnot& knot : segment_->features.front().track) {
    const Vector2d at = LineAt(knot.s, samples);
    track.push_back({knot.s, static_cast<float>(at.x()), static_cast<float>(at.y())});
  }
  return track;
}

// Returns those that were followed from the segment's beginning to its end, and moved, as if they
// were infinitely far away.
std::vector<ExperienceTaker::Candidate> ExperienceTaker::Candidates() const {
  std::vector<Candidate> candidates;
  for (const route::DescribedFeature& other : others_) {
    const int id = other.at.id;
    const auto last = moments_.back().other.find(id);
    if (last == moments_.back().other.end()) continue;
    const double moved_px = (last->second - moments_.front().other.at(id)).norm();
    if (moved_px < Pixels(kLeastMotion_px) * moments_.back().place.magnification) continue;
    candidates.push_back({id, {other.patch, {}, TrackOf(id, {})}});
  }
  return candidates;
}

// Tells that most found features lay where the believed place predicts them.
bool ExperienceTaker::PlaceWasRight(const std::vector<int>& found,
                                    const std::vector<InverseDepth>& depths) const {
  std::vector<double> off_px;
  for (const Moment& moment : moments_) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto seen = moment.taught.find(found[i]);
      if (seen == moment.taught.end()) continue;
      const double along_m = moment.place.along_m;
      const Vector2d as_taught = moment.place.AsTaught(seen->second, depths[i].At(along_m));
      off_px.push_back((as_taught - PlaceOf(route::TaughtPlace(
                                        segment_->features[static_cast<std::size_t>(found[i])],
                                        along_m / segment_->length_m)))
                           .norm());
    }
  }
  return !off_px.empty() && Median(off_px) < Pixels(kFoundWithin_px);
}

bool ExperienceTaker::SawItWell(const std::vector<int>& found) const {
  return sure_throughout_ && found.size() >= kFewestFound &&
         static_cast<double>(found.size()) >=
             kLeastFoundShare * static_cast<double>(segment_->features.size()) &&
         moments_.front().place.along_m < kFirstBy * segment_->length_m &&
         moments_.back().place.along_m > kLastFrom * segment_->length_m;
}

bool ExperienceTaker::IsNew(const route::Feature& feature, const std::vector<int>& found) const {
  const Vector2d place = PlaceOf(feature.first());
  const bool in_picture = std::abs(place.x()) < 0.5 * width_px_ - Pixels(kEdge_px) &&
                          std::abs(place.y()) < 0.5 * height_px_ - Pixels(kEdge_px);
  return in_picture && std::none_of(found.begin(), found.end(), [&](int other) {
           return (FirstPlace(other) - place).norm() < Pixels(kApart_px);
         });
}

std::vector<route::Feature> ExperienceTaker::Offer(const replay::Follower& follower,
                                                   const std::vector<int>& found) const {
  if (!SawItWell(found)) return {};
  std::vector<Candidate> candidates = Candidates();
  // The depths come out of all features together, as they do for a follower.
  route::Segment all = *segment_;
  all.features.clear();
  for (const int i : found) all.features.push_back(segment_->features[static_cast<std::size_t>(i)]);
  for (const Candidate& each : candidates) all.features.push_back(each.feature);
  const std::vector<InverseDepth> depths = follower.Depths(all);
  if (depths.size() != all.features.size() || !PlaceWasRight(found, depths)) return {};
  const replay::ScoutCamera& camera = moments_.back().place.scout;
  // The error that most found ones share is the taught heading's own.
  std::vector<std::vector<Vector2d>> of_found;
  for (std::size_t i = 0; i < found.size(); ++i) {
    of_found.push_back(Unexplained(all, camera, all.features[i], depths[i]));
  }
  const std::vector<Vector2d> common = InCommon(of_found);
  std::vector<route::Feature> offered;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    route::Feature& feature = candidates[i].feature;
    const InverseDepth& depth = depths[found.size() + i];
    feature.track = TrackOf(candidates[i].id, depth);
    const std::vector<Vector2d> own = Unexplained(all, camera, feature, depth);
    const bool alike = std::equal(own.begin(), own.end(), common.begin(), common.end(),
                                  [&](const Vector2d& a, const Vector2d& b) {
                                    return (a - b).norm() < Pixels(kMovesAlike_px);
                                  });
    if (alike && IsNew(feature, found)) offered.push_back(std::move(feature));
  }
  return offered;
}

}  // namespace trailcast::agent
