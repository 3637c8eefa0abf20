#include "services/route/src/seen.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <limits>
#include <utility>

#include "services/route/codec.h"
#include "services/route/src/bit_coder.h"
#include "services/route/src/descriptor_model.h"
#include "services/route/src/number_model.h"
#include "services/route/src/patch_model.h"

namespace trailcast::route {
namespace {

constexpr int kSampleBits = 4;
constexpr std::int32_t kTrackLimit = kMaxCoordinatePx * kStepsPerPixel;
constexpr std::int32_t kPlaceLimit = kMaxCoordinatePx * kStepsPerViewPixel;
// So many features are kept as candidates for a similar descriptor.
constexpr std::size_t kMostCandidates = 256;
// Two descriptors that differ in no more bits than this are probably of the same thing.
constexpr int kMostDifferent = 64;

int Differences(const Descriptor& a, const Descriptor& b) {
  int different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    different += std::popcount(static_cast<unsigned>(a[i] ^ b[i]));
  }
  return different;
}

// Codes a value by `code`, or as plain bits, `kBits` a byte, if that is shorter: noise follows no
// model.
template <int kBits, class Bytes, class CodeByModel>
void CodeShorter(BitCoder& coder, LearntBit& plain_model, Bytes& bytes, CodeByModel code) {
  bool plain = false;
  if (!coder.reads()) {
    BitCoder trial;
    Bytes copy = bytes;
    code(trial, copy);
    plain = trial.Finish().size() > (kBits * bytes.size() + 7) / 8;
  }
  if (!plain_model.Code(coder, plain)) return code(coder, bytes);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(coder.CodePlain(byte, kBits));
}

// This goes through features and views and writes them or fills them in, in the same order. Values
// that are read are checked against the format's bounds at once, so that nothing grows beyond them.
class SeenCoder {
 public:
  SeenCoder(BitCoder& coder, Seen& seen) : coder_(coder), seen_(seen) {}

  Result<void> Code() {
    const std::size_t features = Count(seen_.features.size());
    if (features > kMaxFeatures) return TooMany(features, "features", kMaxFeatures);
    seen_.features.resize(features);
    const std::size_t views = Count(seen_.views.size());
    if (views > kMaxKeyViews) return TooMany(views, "key views", kMaxKeyViews);
    seen_.views.resize(views);
    described_ = Flag(std::any_of(seen_.features.begin(), seen_.features.end(),
                                  [](const auto& f) { return IsDescribed(f.descriptor); }));
    any_missed_ = Flag(std::any_of(seen_.features.begin(), seen_.features.end(),
                                   [](const auto& f) { return f.missed > 0; }));
    for (std::size_t i = 0; i < features; ++i) {
      if (Result<void> coded = CodeFeature(seen_.features[i]); !coded) {
        return Wrap(coded.error(), fmt::format("segment's feature {}", i));
      }
    }
    for (std::size_t i = 0; i < views; ++i) {
      if (Result<void> coded = CodeView(seen_.views[i]); !coded) {
        return Wrap(coded.error(), fmt::format("segment's key view {}", i));
      }
    }
    return {};
  }

 private:
  static tl::unexpected<Error> TooMany(std::size_t count, std::string_view what, std::size_t most) {
    return Fail(ErrorCode::kCorrupt, "segment has {} {}, more than {}", count, what, most);
  }

  // This counts far beyond every bound.
  std::size_t Count(std::size_t count) {
    constexpr int kDigits = 4;
    int digits = std::bit_width(count);
    digits = static_cast<int>(coder_.CodePlain(static_cast<std::uint32_t>(digits), kDigits));
    return coder_.CodePlain(static_cast<std::uint32_t>(count), digits);
  }
  bool Flag(bool flag) { return coder_.CodePlain(flag ? 1 : 0, 1) != 0; }

  Result<void> CodeFeature(CodedFeature& feature) {
    CodeShorter<kSampleBits>(coder_, plain_patch_, feature.patch, CodePatch);
    if (described_) CodeDescriptorLike(nullptr, feature.descriptor);
    if (any_missed_)
      feature.missed = static_cast<std::uint8_t>(missed_.Code(coder_, feature.missed));
    if (Result<void> times = CodeTimes(feature.track); !times) return times;
    if (!CodeTrack(feature.track)) {
      return Fail(ErrorCode::kCorrupt, "it lies more than {} px from the image centre",
                  kMaxCoordinatePx);
    }
    return EnoughBytes();
  }

  // The times are nearly always those of the feature before.
  Result<void> CodeTimes(std::vector<CodedKnot>& track) {
    const bool same = same_times_.Code(
        coder_, std::equal(track.begin(), track.end(), times_.begin(), times_.end(),
                           [](const CodedKnot& knot, int time) { return knot.time == time; }));
    if (!same) {
      if (coder_.reads()) track.clear();
      times_.assign(1, 0);
      while (times_.back() != kLastKnotTime) {
        if (times_.size() == kMaxKnots) {
          return Fail(ErrorCode::kCorrupt, "it has more than {} knots", kMaxKnots);
        }
        const int known = coder_.reads() ? 0 : track[times_.size()].time;
        const int time = static_cast<int>(time_.Code(coder_, static_cast<std::uint32_t>(known)));
        if (time <= times_.back()) {
          return Fail(ErrorCode::kCorrupt, "its knots are out of order");
        }
        times_.push_back(time);
      }
    }
    if (times_.empty()) return Fail(ErrorCode::kCorrupt, "it has no knots");
    track.resize(times_.size());
    for (std::size_t i = 0; i < times_.size(); ++i) track[i].time = times_[i];
    return {};
  }

  // Codes the first knot as it is, the second relative to the first, and each further one relative
  // to the extrapolation from the two before it.
  [[nodiscard]] bool CodeTrack(std::vector<CodedKnot>& track) {
    for (std::size_t i = 0; i < track.size(); ++i) {
      const CodedKnot expected = Expected(track, i);
      auto& [u_model, v_model] = track_.at(std::min<std::size_t>(i, track_.size() - 1));
      track[i].u = expected.u + u_model.Code(coder_, track[i].u - expected.u);
      track[i].v = expected.v + v_model.Code(coder_, track[i].v - expected.v);
      if (std::abs(track[i].u) > kTrackLimit || std::abs(track[i].v) > kTrackLimit) return false;
    }
    return true;
  }
  static CodedKnot Expected(const std::vector<CodedKnot>& track, std::size_t knot) {
    if (knot == 0) return {};
    const CodedKnot& last = track[knot - 1];
    if (knot == 1) return last;
    const CodedKnot& before = track[knot - 2];
    const int ahead = track[knot].time - last.time;
    const int since = last.time - before.time;
    const auto lead = [ahead, since](std::int64_t from, std::int64_t to) {
      return static_cast<std::int32_t>(
          std::clamp<std::int64_t>(to + (to - from) * ahead / since, -kTrackLimit, kTrackLimit));
    };
    return {0, lead(before.u, last.u), lead(before.v, last.v)};
  }

  Result<void> CodeView(CodedView& view) {
    view.at = last_at_ + at_.Code(coder_, view.at - last_at_);
    if (view.at < last_at_ || view.at > kLastKnotTime) {
      return Fail(ErrorCode::kCorrupt, "at {} of {}, after one at {}", view.at, kLastKnotTime,
                  last_at_);
    }
    last_at_ = view.at;
    const bool added = Flag(view.missed.has_value());
    if (added) {
      view.missed = static_cast<std::uint8_t>(coder_.CodePlain(view.missed.value_or(0), 8));
    }
    view.features.resize(
        coder_.CodePlain(static_cast<std::uint32_t>(view.features.size()), kViewCountBits));
    for (CodedViewFeature& feature : view.features) {
      if (!CodeViewFeature(feature)) {
        return Fail(ErrorCode::kCorrupt, "a feature lies more than {} px from the image centre",
                    kMaxCoordinatePx);
      }
      if (Result<void> enough = EnoughBytes(); !enough) return enough;
      known_.push_back(feature);
    }
    return {};
  }

  [[nodiscard]] bool CodeViewFeature(CodedViewFeature& feature) {
    const CodedViewFeature* like = CodeLike(feature.descriptor);
    CodeDescriptorLike(like, feature.descriptor);
    feature.size = static_cast<std::uint8_t>(size_.Code(coder_, feature.size));
    if (like != nullptr) {
      feature.u = like->u + moved_[0].Code(coder_, feature.u - like->u);
      feature.v = like->v + moved_[1].Code(coder_, feature.v - like->v);
    } else {
      feature.u = CodePlace(place_[0], feature.u, feature.size);
      feature.v = CodePlace(place_[1], feature.v, feature.size);
    }
    return std::abs(feature.u) <= kPlaceLimit && std::abs(feature.v) <= kPlaceLimit;
  }

  void CodeDescriptorLike(const CodedViewFeature* like, Descriptor& descriptor) {
    CodeShorter<8>(coder_, plain_descriptor_, descriptor, [like](BitCoder& coder, Descriptor& own) {
      CodeDescriptor(coder, own, like != nullptr ? &like->descriptor : nullptr);
    });
  }

  // Returns the known feature that has a descriptor like this one, or nothing.
  const CodedViewFeature* CodeLike(const Descriptor& descriptor) {
    const std::size_t candidates = std::min(known_.size(), kMostCandidates);
    if (candidates == 0) return nullptr;
    std::size_t back = 0;
    bool alike = false;
    if (!coder_.reads()) {
      int fewest = kMostDifferent + 1;
      for (std::size_t i = 0; i < candidates; ++i) {
        const int different = Differences(Known(i).descriptor, descriptor);
        if (different >= fewest) continue;
        fewest = different;
        back = i;
        alike = true;
      }
    }
    if (!alike_.Code(coder_, alike)) return nullptr;
    const int digits = std::bit_width(candidates - 1);
    back = coder_.CodePlain(static_cast<std::uint32_t>(back), digits);
    return &Known(std::min(back, candidates - 1));
  }
  [[nodiscard]] const CodedViewFeature& Known(std::size_t back) const {
    return known_[known_.size() - 1 - back];
  }

  // If a pixel of the pyramid's level is a whole number of steps, the fraction is nearly always the
  // same.
  struct PlaceModel {
    LearntNumber whole;
    std::array<LearntSymbol<2>, 256> fraction;  // by the feature's size
  };
  std::int32_t CodePlace(PlaceModel& model, std::int32_t place, std::uint8_t size) {
    const std::int32_t fraction = place & 3;
    const std::int32_t whole = model.whole.Code(coder_, (place - fraction) / 4);
    return whole * 4 + static_cast<std::int32_t>(
                           model.fraction[size].Code(coder_, static_cast<std::uint32_t>(fraction)));
  }

  Result<void> EnoughBytes() const {
    if (!coder_.reads() || !coder_.exhausted()) return {};
    return Fail(ErrorCode::kCorrupt, "its bytes end before it does");
  }

  static constexpr int kViewCountBits = 8;
  static_assert(kMaxKeyViewFeatures < 1U << kViewCountBits);

  BitCoder& coder_;
  Seen& seen_;
  bool described_ = false;
  bool any_missed_ = false;
  LearntBit plain_patch_;
  LearntBit plain_descriptor_;
  LearntSymbol<8> missed_;
  LearntBit same_times_;
  LearntSymbol<8> time_;
  std::vector<int> times_;  // of the last feature's knots
  // These are for u and v, each for a feature's first knot, its second, and all others.
  std::array<std::array<LearntNumber, 2>, 3> track_;
  LearntNumber at_;
  int last_at_ = 0;
  std::vector<CodedViewFeature> known_;  // features of this view and of those before it
  LearntBit alike_;
  LearntSymbol<8> size_;
  std::array<PlaceModel, 2> place_;
  std::array<LearntNumber, 2> moved_;
};

}  // namespace

std::string Pack(Seen seen) {
  if (seen.features.empty() && seen.views.empty()) return {};
  BitCoder coder;
  (void)SeenCoder(coder, seen).Code();
  return coder.Finish();
}

Result<Seen> Unpack(std::string_view bytes) {
  Seen seen;
  if (bytes.empty()) return seen;
  BitCoder coder(bytes);
  if (Result<void> coded = SeenCoder(coder, seen).Code(); !coded) {
    return tl::unexpected(coded.error());
  }
  if (!coder.AtEnd()) {
    return Fail(ErrorCode::kCorrupt,
                "segment has {} bytes of what was seen, which takes more or less", bytes.size());
  }
  return seen;
}

}  // namespace trailcast::route
