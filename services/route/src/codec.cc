#include "services/route/codec.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "idl/route.pb.h"

namespace trailcast::route {
namespace {

constexpr double kStepsPerPixel = 16.0;
constexpr double kStepsPerMetre = 1e4;
constexpr double kStepsPerRadian = 1e5;
constexpr double kStepsPerSecond = 1e3;
constexpr int kLastKnotTime = 255;
constexpr double kStepsPerViewPixel = 4.0;
constexpr double kSizeStepsPerOctave = 16.0;
constexpr int kSizeOfOnePixel = 64;
constexpr double kStepsPerPictureHeight = 1e4;
constexpr double kStepsPerMps2 = 1e2;
constexpr double kSlopeStepsPerRadian = 1e3;
// More than this shakes no robot, and nothing that drives stands steeper.
constexpr std::uint32_t kMostShake = 10'000;
constexpr std::uint32_t kMostVertical = 10'000;
constexpr std::int32_t kSteepest = 1571;
constexpr std::size_t kPackedPatchBytes = (std::tuple_size_v<Patch> + 1) / 2;
constexpr std::size_t kDescriptorBytes = std::tuple_size_v<Descriptor>;

// Nearest multiple, held inside int32: a robot gone mad must not make undefined behaviour of it.
std::int32_t Quantise(double value, double steps_per_unit) {
  assert(std::isfinite(value));
  if (!std::isfinite(value)) return 0;
  using Limits = std::numeric_limits<std::int32_t>;
  return static_cast<std::int32_t>(
      std::llround(std::clamp<double>(value * steps_per_unit, Limits::lowest(), Limits::max())));
}

std::uint32_t QuantiseDuration(double seconds) {
  assert(std::isfinite(seconds));
  if (!std::isfinite(seconds)) return 0;
  constexpr double kLimit = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(
      std::llround(std::clamp(seconds * kStepsPerSecond, 0.0, kLimit)));
}

std::int32_t QuantisePixels(float px) {
  return Quantise(std::clamp(px, -1.0F * kMaxCoordinatePx, 1.0F * kMaxCoordinatePx),
                  kStepsPerPixel);
}

void AppendPatch(const Patch& patch, std::string& packed) {
  for (std::size_t i = 0; i < patch.size(); i += 2) {
    const unsigned low = std::min<unsigned>(patch[i], 15U);
    const unsigned high = i + 1 < patch.size() ? std::min<unsigned>(patch[i + 1], 15U) : 0U;
    packed.push_back(static_cast<char>(low | high << 4U));
  }
}

Patch UnpackPatch(const char* packed) {
  Patch patch{};
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const unsigned byte = static_cast<std::uint8_t>(packed[i / 2]);
    patch[i] = static_cast<std::uint8_t>(i % 2 == 0 ? byte & 15U : byte >> 4U);
  }
  return patch;
}

void AppendTrack(const std::vector<TrackKnot>& track, format::v1::Segment& out) {
  assert(track.size() >= 2 && track.size() <= kMaxKnots);
  int time = 0;
  std::int32_t u = 0;
  std::int32_t v = 0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const bool last = i + 1 == track.size();
    if (i > 0) {
      const int knot_time = last ? kLastKnotTime : Quantise(track[i].s, kLastKnotTime);
      if (knot_time <= time || (!last && knot_time >= kLastKnotTime)) continue;
      time = knot_time;
      out.mutable_knot_times()->push_back(static_cast<char>(time));
    }
    const std::int32_t knot_u = QuantisePixels(track[i].u_px);
    const std::int32_t knot_v = QuantisePixels(track[i].v_px);
    out.add_track(knot_u - u);
    out.add_track(knot_v - v);
    u = knot_u;
    v = knot_v;
  }
}

std::uint8_t QuantiseSize(float size_px) {
  if (!(size_px > 0.0F)) return 0;
  const double steps = kSizeOfOnePixel + kSizeStepsPerOctave * std::log2(double{size_px});
  return static_cast<std::uint8_t>(std::clamp(std::lround(steps), 1L, 255L));
}

float SizeOf(std::uint8_t steps) {
  if (steps == 0) return 0.0F;
  return static_cast<float>(std::exp2((steps - kSizeOfOnePixel) / kSizeStepsPerOctave));
}

std::int32_t QuantisePlace(float px) {
  return Quantise(std::clamp(px, -1.0F * kMaxCoordinatePx, 1.0F * kMaxCoordinatePx),
                  kStepsPerViewPixel);
}

void AppendKeyView(const KeyView& view, format::v1::KeyView& out) {
  assert(view.features.size() <= kMaxKeyViewFeatures);
  out.set_at(static_cast<std::uint32_t>(Quantise(std::clamp(view.s, 0.0, 1.0), kLastKnotTime)));
  for (const ViewFeature& feature : view.features) {
    out.mutable_descriptors()->append(feature.descriptor.begin(), feature.descriptor.end());
    out.mutable_sizes()->push_back(static_cast<char>(QuantiseSize(feature.size_px)));
    out.add_places(QuantisePlace(feature.u_px));
    out.add_places(QuantisePlace(feature.v_px));
  }
  if (view.missed) out.set_missed(*view.missed);
}

void SetOdometry(const Segment& segment, format::v1::Odometry& out) {
  out.set_length_tenth_mm(Quantise(segment.length_m, kStepsPerMetre));
  out.set_heading_change_centi_mrad(Quantise(segment.heading_change_rad, kStepsPerRadian));
  out.set_heading_variation_centi_mrad(Quantise(segment.heading_variation_rad, kStepsPerRadian));
  for (const double c : segment.heading.c) out.add_heading_polynomial(static_cast<float>(c));
  out.set_turn_before_centi_mrad(Quantise(segment.turn_before_rad, kStepsPerRadian));
}

void SetSeenWay(const SeenWay& way, format::v1::SeenWay& out) {
  out.set_length_tenth_mm(
      static_cast<std::uint32_t>(std::max(1, Quantise(way.length_m, kStepsPerMetre))));
  for (const double c : way.heading.c) out.add_heading_polynomial(static_cast<float>(c));
}

std::uint32_t QuantiseAmount(double value, double steps_per_unit, std::uint32_t most) {
  return static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(Quantise(value, steps_per_unit), 0, most));
}

void SetTerrain(const Terrain& terrain, format::v1::Terrain& out) {
  if (terrain.shake)
    out.set_shake(QuantiseAmount(*terrain.shake, kStepsPerPictureHeight, kMostShake));
  if (terrain.vertical_mps2) {
    out.set_vertical_cm_per_s2(
        QuantiseAmount(*terrain.vertical_mps2, kStepsPerMps2, kMostVertical));
  }
  if (terrain.slope_rad) {
    out.set_slope_mrad(
        std::clamp(Quantise(*terrain.slope_rad, kSlopeStepsPerRadian), -kSteepest, kSteepest));
  }
}

Result<Terrain> ReadTerrain(const format::v1::Terrain& in) {
  if (in.shake() > kMostShake || in.vertical_cm_per_s2() > kMostVertical ||
      in.slope_mrad() < -kSteepest || in.slope_mrad() > kSteepest) {
    return Fail(ErrorCode::kCorrupt,
                "segment's terrain shakes {} (most {}) and {} cm/s2 (most {}), slopes {} mrad "
                "(steepest {})",
                in.shake(), kMostShake, in.vertical_cm_per_s2(), kMostVertical, in.slope_mrad(),
                kSteepest);
  }
  Terrain terrain;
  if (in.has_shake()) terrain.shake = in.shake() / kStepsPerPictureHeight;
  if (in.has_vertical_cm_per_s2()) terrain.vertical_mps2 = in.vertical_cm_per_s2() / kStepsPerMps2;
  if (in.has_slope_mrad()) terrain.slope_rad = in.slope_mrad() / kSlopeStepsPerRadian;
  return terrain;
}

Result<HeadingPolynomial> ReadHeading(const google::protobuf::RepeatedField<float>& in) {
  HeadingPolynomial heading;
  if (in.size() != static_cast<int>(heading.c.size())) {
    return Fail(ErrorCode::kCorrupt, "segment's heading polynomial has {} coefficients, not {}",
                in.size(), heading.c.size());
  }
  std::copy(in.begin(), in.end(), heading.c.begin());
  if (!std::all_of(heading.c.begin(), heading.c.end(), [](double c) { return std::isfinite(c); })) {
    return Fail(ErrorCode::kCorrupt, "segment's heading polynomial is not finite");
  }
  return heading;
}

Result<void> ReadOdometry(const format::v1::Odometry& in, Segment& segment) {
  const auto heading = ReadHeading(in.heading_polynomial());
  if (!heading) return tl::unexpected(heading.error());
  segment.has_odometry = true;
  segment.length_m = in.length_tenth_mm() / kStepsPerMetre;
  segment.heading_change_rad = in.heading_change_centi_mrad() / kStepsPerRadian;
  segment.heading_variation_rad = in.heading_variation_centi_mrad() / kStepsPerRadian;
  segment.turn_before_rad = in.turn_before_centi_mrad() / kStepsPerRadian;
  segment.heading = *heading;
  return {};
}

Result<SeenWay> ReadSeenWay(const format::v1::SeenWay& in, const Segment& segment) {
  if (segment.has_odometry || in.length_tenth_mm() == 0) {
    return Fail(ErrorCode::kCorrupt,
                "segment's way by sight is {:.4f} m long, {} odometry: it is longer than nothing, "
                "and only there without odometry",
                in.length_tenth_mm() / kStepsPerMetre, segment.has_odometry ? "with" : "without");
  }
  const auto heading = ReadHeading(in.heading_polynomial());
  if (!heading) return tl::unexpected(heading.error());
  return SeenWay{in.length_tenth_mm() / kStepsPerMetre, *heading};
}

// Every column must speak of the same number of features, and of knots.
Result<std::size_t> CountFeatures(const format::v1::Segment& in) {
  const std::string& times = in.knot_times();
  const auto features = static_cast<std::size_t>(
      std::count(times.begin(), times.end(), static_cast<char>(kLastKnotTime)));
  if (features > kMaxFeatures) {
    return Fail(ErrorCode::kCorrupt, "segment has {} features, more than {}", features,
                kMaxFeatures);
  }
  const bool undescribed = in.format_version() > 1 && in.descriptors().empty();
  if (in.patches().size() != features * kPackedPatchBytes ||
      (!undescribed && in.descriptors().size() != features * kDescriptorBytes)) {
    return Fail(ErrorCode::kCorrupt,
                "segment has {} features by its knot times, but {} bytes of patches (expected {}) "
                "and {} of descriptors (expected {})",
                features, in.patches().size(), features * kPackedPatchBytes,
                in.descriptors().size(), features * kDescriptorBytes);
  }
  const std::size_t coordinates = 2 * (features + times.size());
  if (static_cast<std::size_t>(in.track_size()) != coordinates) {
    return Fail(ErrorCode::kCorrupt, "segment has {} track coordinates, expected {}",
                in.track_size(), coordinates);
  }
  if (!times.empty() && static_cast<std::uint8_t>(times.back()) != kLastKnotTime) {
    return Fail(ErrorCode::kCorrupt, "segment's last feature has no milestone");
  }
  return features;
}

// Walks the columns of knots, one feature at a time.
class TrackReader {
 public:
  explicit TrackReader(const format::v1::Segment& in) : in_(in) {}

  Result<std::vector<TrackKnot>> Next() {
    u_ = v_ = 0;
    std::vector<TrackKnot> track;
    int time = 0;
    if (!AddKnot(time, track)) return OutOfRange();
    while (time != kLastKnotTime) {
      const int next = static_cast<std::uint8_t>(in_.knot_times()[next_time_++]);
      if (next <= time) return Fail(ErrorCode::kCorrupt, "its knots are out of order");
      time = next;
      if (track.size() == kMaxKnots) {
        return Fail(ErrorCode::kCorrupt, "it has more than {} knots", kMaxKnots);
      }
      if (!AddKnot(time, track)) return OutOfRange();
    }
    return track;
  }

 private:
  static tl::unexpected<Error> OutOfRange() {
    return Fail(ErrorCode::kCorrupt, "it lies more than {} px from the image centre",
                kMaxCoordinatePx);
  }

  [[nodiscard]] bool AddKnot(int time, std::vector<TrackKnot>& track) {
    constexpr double kLimit = kMaxCoordinatePx * kStepsPerPixel;
    u_ += in_.track(next_coordinate_++);
    v_ += in_.track(next_coordinate_++);
    if (std::abs(static_cast<double>(u_)) > kLimit || std::abs(static_cast<double>(v_)) > kLimit) {
      return false;
    }
    track.push_back({static_cast<float>(time) / static_cast<float>(kLastKnotTime),
                     static_cast<float>(static_cast<double>(u_) / kStepsPerPixel),
                     static_cast<float>(static_cast<double>(v_) / kStepsPerPixel)});
    return true;
  }

  const format::v1::Segment& in_;
  std::size_t next_time_ = 0;
  int next_coordinate_ = 0;
  std::int64_t u_ = 0;  // wide: a sum of hostile differences must not overflow
  std::int64_t v_ = 0;
};

Result<void> ReadMissed(const format::v1::Segment& in, Segment& segment) {
  const std::string& missed = in.missed();
  if (missed.empty()) return {};
  if (missed.size() != segment.features.size()) {
    return Fail(ErrorCode::kCorrupt,
                "segment says of {} features how often they were missed, of {}", missed.size(),
                segment.features.size());
  }
  for (std::size_t i = 0; i < missed.size(); ++i) {
    segment.features[i].missed = static_cast<std::uint8_t>(missed[i]);
  }
  return {};
}

Result<void> ReadFeatures(const format::v1::Segment& in, Segment& segment) {
  const Result<std::size_t> count = CountFeatures(in);
  if (!count) return tl::unexpected(count.error());
  segment.features.resize(*count);
  TrackReader tracks(in);
  for (std::size_t i = 0; i < *count; ++i) {
    Feature& feature = segment.features[i];
    const char* packed = in.patches().data() + i * kPackedPatchBytes;
    if ((static_cast<std::uint8_t>(packed[kPackedPatchBytes - 1]) >> 4U) != 0) {
      return Fail(ErrorCode::kCorrupt, "segment's feature {}: its patch has a 122nd sample", i);
    }
    feature.patch = UnpackPatch(packed);
    if (!in.descriptors().empty()) {
      std::copy_n(in.descriptors().begin() + static_cast<std::ptrdiff_t>(i * kDescriptorBytes),
                  kDescriptorBytes, feature.descriptor.begin());
    }
    Result<std::vector<TrackKnot>> track = tracks.Next();
    if (!track) return Wrap(track.error(), fmt::format("segment's feature {}", i));
    feature.track = std::move(*track);
  }
  return ReadMissed(in, segment);
}

Result<KeyView> ReadKeyView(const format::v1::KeyView& in) {
  constexpr double kLimit = kMaxCoordinatePx * kStepsPerViewPixel;
  const std::size_t features = in.sizes().size();
  if (in.at() > kLastKnotTime || features > kMaxKeyViewFeatures ||
      in.descriptors().size() != features * kDescriptorBytes ||
      static_cast<std::size_t>(in.places_size()) != 2 * features) {
    return Fail(ErrorCode::kCorrupt,
                "at {} of {}, {} features by their sizes, {} bytes of descriptors, {} coordinates",
                in.at(), kLastKnotTime, features, in.descriptors().size(), in.places_size());
  }
  KeyView view{in.at() / static_cast<double>(kLastKnotTime), View(features)};
  constexpr std::uint32_t kMostMissed = std::numeric_limits<std::uint8_t>::max();
  if (in.has_missed()) view.missed = static_cast<std::uint8_t>(std::min(in.missed(), kMostMissed));
  for (std::size_t i = 0; i < features; ++i) {
    const double u = in.places(static_cast<int>(2 * i));
    const double v = in.places(static_cast<int>(2 * i + 1));
    if (std::abs(u) > kLimit || std::abs(v) > kLimit) {
      return Fail(ErrorCode::kCorrupt, "a feature lies more than {} px from the image centre",
                  kMaxCoordinatePx);
    }
    ViewFeature& feature = view.features[i];
    feature.u_px = static_cast<float>(u / kStepsPerViewPixel);
    feature.v_px = static_cast<float>(v / kStepsPerViewPixel);
    feature.size_px = SizeOf(static_cast<std::uint8_t>(in.sizes()[i]));
    std::copy_n(in.descriptors().begin() + static_cast<std::ptrdiff_t>(i * kDescriptorBytes),
                kDescriptorBytes, feature.descriptor.begin());
  }
  return view;
}

Result<void> ReadKeyViews(const format::v1::Segment& in, Segment& segment) {
  const auto count = static_cast<std::size_t>(in.key_views_size());
  if (count > kMaxKeyViews) {
    return Fail(ErrorCode::kCorrupt, "segment has {} key views, more than {}", count, kMaxKeyViews);
  }
  for (const format::v1::KeyView& each : in.key_views()) {
    Result<KeyView> view = ReadKeyView(each);
    if (!view) {
      return Wrap(view.error(), fmt::format("segment's key view {}", segment.key_views.size()));
    }
    if (!segment.key_views.empty() && view->s < segment.key_views.back().s) {
      return Fail(ErrorCode::kCorrupt, "segment's key views are out of order");
    }
    segment.key_views.push_back(std::move(*view));
  }
  return {};
}

// The least that has what the segment needs: who reads no more than that follows it all the same,
// and who does not know of driving backwards does not drive it forwards.
std::uint32_t VersionOf(const Segment& segment) {
  if (segment.reverse) return 3;
  return segment.key_views.empty() && segment.turn_before_rad == 0.0 ? 1 : 2;
}

}  // namespace

Bytes Encode(const Segment& segment) {
  assert(segment.features.size() <= kMaxFeatures);
  assert(segment.has_odometry || !segment.reverse);
  format::v1::Segment out;
  const std::uint32_t version = VersionOf(segment);
  out.set_format_version(version);
  out.set_index(segment.index.value());
  out.set_duration_ms(QuantiseDuration(segment.duration_s));
  if (segment.has_odometry) SetOdometry(segment, *out.mutable_odometry());
  if (segment.seen_way) SetSeenWay(*segment.seen_way, *out.mutable_seen_way());
  const bool missed = std::any_of(segment.features.begin(), segment.features.end(),
                                  [](const Feature& f) { return f.missed > 0; });
  const bool described =
      version == 1 || std::any_of(segment.features.begin(), segment.features.end(),
                                  [](const Feature& f) { return IsDescribed(f.descriptor); });
  for (const Feature& feature : segment.features) {
    AppendPatch(feature.patch, *out.mutable_patches());
    if (described) {
      out.mutable_descriptors()->append(feature.descriptor.begin(), feature.descriptor.end());
    }
    AppendTrack(feature.track, out);
    if (missed) out.mutable_missed()->push_back(static_cast<char>(feature.missed));
  }
  for (const KeyView& view : segment.key_views) AppendKeyView(view, *out.add_key_views());
  if (segment.terrain.known()) SetTerrain(segment.terrain, *out.mutable_terrain());
  out.set_reverse(segment.reverse);
  Bytes bytes(out.ByteSizeLong());
  google::protobuf::io::ArrayOutputStream array(bytes.data(), static_cast<int>(bytes.size()));
  google::protobuf::io::CodedOutputStream stream(&array);
  stream.SetSerializationDeterministic(true);
  out.SerializeWithCachedSizes(&stream);
  return bytes;
}

Result<Segment> Decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > kMaxSegmentBytes) {
    return Fail(ErrorCode::kCorrupt, "segment of {} bytes is larger than {}", bytes.size(),
                kMaxSegmentBytes);
  }
  format::v1::Segment in;
  if (!in.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return Fail(ErrorCode::kCorrupt, "{} bytes are no segment, or it is cut short", bytes.size());
  }
  if (in.format_version() < 1 || in.format_version() > kFormatVersion) {
    return Fail(ErrorCode::kCorrupt,
                "segment is in route format {}, this program reads 1 to {}: is it newer than this "
                "one?",
                in.format_version(), kFormatVersion);
  }
  Segment segment;
  segment.index = SegmentIndex(in.index());
  segment.duration_s = in.duration_ms() / kStepsPerSecond;
  if (in.has_odometry()) {
    if (Result<void> odometry = ReadOdometry(in.odometry(), segment); !odometry) {
      return tl::unexpected(odometry.error());
    }
  }
  if (in.has_seen_way()) {
    auto way = ReadSeenWay(in.seen_way(), segment);
    if (!way) return tl::unexpected(way.error());
    segment.seen_way = *way;
  }
  segment.reverse = in.reverse();
  if (segment.reverse && (in.format_version() < 3 || !segment.has_odometry)) {
    return Fail(ErrorCode::kCorrupt,
                "segment is driven backwards, which takes route format 3 and odometry: it is in "
                "format {}, {} odometry",
                in.format_version(), segment.has_odometry ? "with" : "without");
  }
  if (Result<void> features = ReadFeatures(in, segment); !features) {
    return tl::unexpected(features.error());
  }
  if (Result<void> views = ReadKeyViews(in, segment); !views) {
    return tl::unexpected(views.error());
  }
  if (in.has_terrain()) {
    const Result<Terrain> terrain = ReadTerrain(in.terrain());
    if (!terrain) return tl::unexpected(terrain.error());
    segment.terrain = *terrain;
  }
  return segment;
}

}  // namespace trailcast::route
