#include "services/route/codec.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "idl/route.pb.h"
#include "services/route/src/seen.h"

namespace trailcast::route {
namespace {

constexpr std::uint8_t kMostGrey = 15;
constexpr double kStepsPerMetre = 1e4;
constexpr double kStepsPerRadian = 1e5;
constexpr double kStepsPerSecond = 1e3;
constexpr double kSizeStepsPerOctave = 16.0;
constexpr int kSizeOfOnePixel = 64;
constexpr double kStepsPerPictureHeight = 1e4;
constexpr double kStepsPerMps2 = 1e2;
constexpr double kSlopeStepsPerRadian = 1e3;
// No robot shakes by more than this, and no vehicle stands steeper.
constexpr std::uint32_t kMostShake = 10'000;
constexpr std::uint32_t kMostVertical = 10'000;
constexpr std::int32_t kSteepest = 1571;

// Returns the nearest multiple within int32, so that absurd values from a broken robot cause no
// undefined behaviour.
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

std::vector<CodedKnot> Coded(const std::vector<TrackKnot>& track) {
  assert(track.size() >= 2 && track.size() <= kMaxKnots);
  std::vector<CodedKnot> coded;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const bool last = i + 1 == track.size();
    int time = 0;
    if (i > 0) {
      time = last ? kLastKnotTime : Quantise(track[i].s, kLastKnotTime);
      if (time <= coded.back().time || (!last && time >= kLastKnotTime)) continue;
    }
    coded.push_back({time, QuantisePixels(track[i].u_px), QuantisePixels(track[i].v_px)});
  }
  return coded;
}

CodedFeature Coded(const Feature& feature) {
  CodedFeature coded{feature.patch, feature.descriptor, feature.missed, Coded(feature.track)};
  for (std::uint8_t& sample : coded.patch) sample = std::min<std::uint8_t>(sample, kMostGrey);
  return coded;
}

Feature Decoded(const CodedFeature& coded) {
  Feature feature{coded.patch, coded.descriptor, {}, coded.missed};
  feature.track.reserve(coded.track.size());
  for (const CodedKnot& knot : coded.track) {
    feature.track.push_back({static_cast<float>(knot.time) / static_cast<float>(kLastKnotTime),
                             static_cast<float>(static_cast<double>(knot.u) / kStepsPerPixel),
                             static_cast<float>(static_cast<double>(knot.v) / kStepsPerPixel)});
  }
  return feature;
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

CodedView Coded(const KeyView& view) {
  assert(view.features.size() <= kMaxKeyViewFeatures);
  CodedView coded{Quantise(std::clamp(view.s, 0.0, 1.0), kLastKnotTime), view.missed, {}};
  for (const ViewFeature& feature : view.features) {
    coded.features.push_back({feature.descriptor, QuantiseSize(feature.size_px),
                              QuantisePlace(feature.u_px), QuantisePlace(feature.v_px)});
  }
  return coded;
}

KeyView Decoded(const CodedView& coded) {
  KeyView view{coded.at / static_cast<double>(kLastKnotTime), {}, coded.missed};
  view.features.reserve(coded.features.size());
  for (const CodedViewFeature& feature : coded.features) {
    view.features.push_back(
        {feature.descriptor,
         static_cast<float>(static_cast<double>(feature.u) / kStepsPerViewPixel),
         static_cast<float>(static_cast<double>(feature.v) / kStepsPerViewPixel),
         SizeOf(feature.size)});
  }
  return view;
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

}  // namespace

Bytes Encode(const Segment& segment) {
  assert(segment.features.size() <= kMaxFeatures);
  assert(segment.has_odometry || !segment.reverse);
  format::v1::Segment out;
  out.set_format_version(kFormatVersion);
  out.set_index(segment.index.value());
  out.set_duration_ms(QuantiseDuration(segment.duration_s));
  if (segment.has_odometry) SetOdometry(segment, *out.mutable_odometry());
  if (segment.seen_way) SetSeenWay(*segment.seen_way, *out.mutable_seen_way());
  Seen seen;
  for (const Feature& feature : segment.features) seen.features.push_back(Coded(feature));
  for (const KeyView& view : segment.key_views) seen.views.push_back(Coded(view));
  out.set_seen(Pack(std::move(seen)));
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
  if (in.format_version() != kFormatVersion) {
    return Fail(ErrorCode::kCorrupt,
                "segment is in route format {}, this program reads format {} alone: {}",
                in.format_version(), kFormatVersion,
                in.format_version() > kFormatVersion ? "update it" : "teach the route again");
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
  if (segment.reverse && !segment.has_odometry) {
    return Fail(ErrorCode::kCorrupt,
                "segment is driven backwards, which takes odometry, and has none");
  }
  const Result<Seen> seen = Unpack(in.seen());
  if (!seen) return tl::unexpected(seen.error());
  for (const CodedFeature& feature : seen->features) segment.features.push_back(Decoded(feature));
  for (const CodedView& view : seen->views) segment.key_views.push_back(Decoded(view));
  if (in.has_terrain()) {
    const Result<Terrain> terrain = ReadTerrain(in.terrain());
    if (!terrain) return tl::unexpected(terrain.error());
    segment.terrain = *terrain;
  }
  return segment;
}

}  // namespace trailcast::route
