#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/route/key_view.h"
#include "services/route/terrain.h"

namespace trailcast::route {

// The grey pattern around a feature, contrast-normalised, seen in the segment's first image:
// kPatchSize x kPatchSize samples one pixel apart, row-major, 0..15 (4 bits are what a correlation
// needs, and what travels), 8 about the patch's mean.
inline constexpr int kPatchSize = 11;
using Patch = std::array<std::uint8_t, std::size_t{kPatchSize} * kPatchSize>;

// Where a feature was when a fraction `s` of its segment had been driven. Pixels of the scout's
// camera from its image centre, u to the right, v down. Resolution on the wire: 1/16 px.
struct TrackKnot {
  float s = 0.0F;  // 0 at the segment's first image, 1 at its last
  float u_px = 0.0F;
  float v_px = 0.0F;

  bool operator==(const TrackKnot&) const = default;
};

struct Feature {
  Patch patch{};
  // At the scale of the segment's first image. Only in segments without key views, as they were
  // taught before there were any; all zero otherwise.
  Descriptor descriptor{};
  // At least two knots in rising s; front() is the first image, back() the milestone.
  std::vector<TrackKnot> track;
  // Of the last visits that refreshed the route, how many in a row looked for it in vain.
  std::uint8_t missed = 0;

  [[nodiscard]] const TrackKnot& first() const { return track.front(); }
  [[nodiscard]] const TrackKnot& milestone() const { return track.back(); }
  bool operator==(const Feature&) const = default;
};

// Taught heading relative to the segment's start against metres driven since then,
// counter-clockwise positive: c[0] s + c[1] s^2 + c[2] s^3 (Chen & Birchfield 2009, II.B: a
// third-order polynomial; its constant term is zero because heading is counted from the segment's
// start).
struct HeadingPolynomial {
  std::array<double, 3> c{};

  bool operator==(const HeadingPolynomial&) const = default;
};

// How a scout without odometry drove a segment, as its pictures tell (visual_odometry.h).
struct SeenWay {
  double length_m = 0.0;      // true up to one factor of the whole route; never 0
  HeadingPolynomial heading;  // against such metres

  bool operator==(const SeenWay&) const = default;
};

// What was taught between two milestones. Odometry is local to the segment (metres, radians).
struct Segment {
  SegmentIndex index;
  bool has_odometry = false;           // false: a recording without it; the four below are then 0
  double length_m = 0.0;               // distance driven
  double heading_change_rad = 0.0;     // counter-clockwise positive
  double heading_variation_rad = 0.0;  // largest |heading| inside the segment: sigma_h
  HeadingPolynomial heading;
  std::optional<SeenWay> seen_way;  // only without odometry
  double duration_s = 0.0;          // how long teaching took; speed is length over duration
  // Turned on the spot before the segment's first image, counter-clockwise positive: the segment
  // begins where the last one ended, and heads so much further to the left.
  double turn_before_rad = 0.0;
  // Driven backwards, the camera looking ahead. All else is as driven: metres, heading and knots
  // from where the robot began to, its features becoming smaller on the way.
  bool reverse = false;
  std::vector<Feature> features;
  std::vector<KeyView> key_views;  // in rising s; none in segments taught before there were any
  Terrain terrain;

  // How long the segment is for people: in metres, or without odometry in seconds of teaching.
  [[nodiscard]] double extent() const { return has_odometry ? length_m : duration_s; }
  [[nodiscard]] double speed_mps() const { return duration_s > 0.0 ? length_m / duration_s : 0.0; }
  bool operator==(const Segment&) const = default;
};

// One teaching of a route: who teaches a known route again makes another teaching of the same
// route. Immutable once complete.
struct RouteKey {
  RouteId route;
  TeachingId teaching{1};

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
  auto operator<=>(const RouteKey&) const = default;
};

// SHA-256 of the bytes that travel and are stored.
using Digest = std::array<std::uint8_t, 32>;
using Bytes = std::vector<std::uint8_t>;

enum class RouteState : std::uint8_t {
  kTeaching = 0,  // more segments will come
  kComplete = 1,  // immutable from now on
};

// What a revision is to its operator.
enum class Standing : std::uint8_t {
  kStaged = 0,   // held, and not in use, or not yet
  kActive = 1,   // the one of its route that followers take
  kRetired = 2,  // kept, and offered to nobody
  kDeleted = 3,  // a tombstone: its segments are gone, and are taken from nobody
};

// Where a route begins, for people and for queries; nobody follows by it.
struct Place {
  enum class Frame : std::uint8_t {
    kSite = 1,   // metres east and north in whatever frame the site uses
    kWgs84 = 2,  // longitude and latitude, degrees
  };
  Frame frame = Frame::kSite;
  double x = 0.0;  // east
  double y = 0.0;  // north

  bool operator==(const Place&) const = default;
};

inline constexpr std::size_t kMaxTags = 16;
inline constexpr std::size_t kMaxDescriptionBytes = 256;

// What is known of a route without its segments: announced by the scout, kept in the catalog. What
// operators may change afterwards are its labels (labels.h): name, revision, tags, description,
// standing and whether it is to be reviewed.
struct RouteInfo {
  RouteKey key;
  std::string name;  // what people call it; IsValidName
  // What people call this teaching by. The scout's own count until a server numbers it.
  RevisionNumber revision{};
  AgentId scout;           // who taught it
  std::string camera;      // the scout's camera, for people ("webcam 320x240"); at most 128 bytes
  int image_width_px = 0;  // of the scout's frames, reduced and upright
  int image_height_px = 0;
  std::int64_t taught_unix_ms = 0;  // when teaching began, by the scout's clock
  RouteState state = RouteState::kTeaching;
  std::uint32_t segment_count = 0;  // segments taught so far
  double length_m = 0.0;            // sum over those segments
  std::uint64_t bytes = 0;          // sum of their encoded sizes
  // SHA-256 over the digests of segments 0..segment_count-1 put one after the other.
  Digest manifest_digest{};
  // Complete, and yet not what was meant: the scout's process, camera or robot failed on the way.
  bool cut_off = false;
  std::vector<std::string> tags{};  // IsValidName each, rising, none twice, at most kMaxTags
  std::optional<Place> place{};     // given when teaching
  std::string description{};        // for people: one line, at most kMaxDescriptionBytes
  Standing standing = Standing::kStaged;
  // Its scout wants it looked at before robots follow it; no more once an operator activates it.
  bool to_review = false;
  std::uint32_t edition = 0;   // how often the labels were changed since it was taught
  RevisionNumber refreshes{};  // the revision of which a follower's visit made it; 0: it was taught

  // No robot follows it, and no server activates it, unless an operator says so.
  [[nodiscard]] bool held_back() const { return cut_off || to_review; }
  bool operator==(const RouteInfo&) const = default;
};

// A segment as it travels and is stored: the bytes that were hashed at the scout, never re-encoded.
struct SegmentPiece {
  RouteKey key;
  SegmentIndex index;
  Digest digest{};
  Bytes bytes;

  bool operator==(const SegmentPiece&) const = default;
};

}  // namespace trailcast::route
