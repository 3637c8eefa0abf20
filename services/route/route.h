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

// This is the grey pattern around a feature in the segment's first image, normalised in contrast:
// kPatchSize x kPatchSize samples one pixel apart, row-major, from 0 to 15, with 8 at the patch's
// mean. Correlation needs no more than 4 bits, so no more travel.
inline constexpr int kPatchSize = 11;
using Patch = std::array<std::uint8_t, std::size_t{kPatchSize} * kPatchSize>;

// This is where a feature was after a fraction `s` of its segment, in pixels of the scout's camera
// from its image centre, u to the right, v down. The resolution on the wire is 1/16 px.
struct TrackKnot {
  float s = 0.0F;  // 0 at the segment's first image, 1 at its last
  float u_px = 0.0F;
  float v_px = 0.0F;

  bool operator==(const TrackKnot&) const = default;
};

struct Feature {
  Patch patch{};
  // This is at the scale of the segment's first image. Only segments from before there were key
  // views have it; it is all zero otherwise.
  Descriptor descriptor{};
  // It has at least two knots in rising s. front() is in the first image, back() at the milestone.
  std::vector<TrackKnot> track;
  // This many of the last visits that refreshed the route, in a row, searched for it in vain.
  std::uint8_t missed = 0;

  [[nodiscard]] const TrackKnot& first() const { return track.front(); }
  [[nodiscard]] const TrackKnot& milestone() const { return track.back(); }
  bool operator==(const Feature&) const = default;
};

// This is the taught heading relative to the segment's start as a function of the metres s driven
// since then, counter-clockwise positive: c[0] s + c[1] s^2 + c[2] s^3 (Chen & Birchfield 2009,
// II.B: a third-order polynomial). Its constant term is zero because heading is counted from the
// segment's start.
struct HeadingPolynomial {
  std::array<double, 3> c{};

  bool operator==(const HeadingPolynomial&) const = default;
};

// This is the path that a scout without odometry drove in a segment, as its pictures tell
// (visual_odometry.h).
struct SeenWay {
  double length_m = 0.0;      // true up to one factor of the whole route; never 0
  HeadingPolynomial heading;  // as a function of such metres

  bool operator==(const SeenWay&) const = default;
};

// This was taught between two milestones. Its odometry is local to the segment, in metres and
// radians.
struct Segment {
  SegmentIndex index;
  bool has_odometry = false;           // without it the four below are 0
  double length_m = 0.0;               // distance driven
  double heading_change_rad = 0.0;     // counter-clockwise positive
  double heading_variation_rad = 0.0;  // largest |heading| inside the segment: sigma_h
  HeadingPolynomial heading;
  std::optional<SeenWay> seen_way;  // only without odometry
  double duration_s = 0.0;          // speed is length over duration
  // The robot turned by this on the spot before the segment's first image, counter-clockwise
  // positive. The segment begins where the last one ended, and heads so much further to the left.
  double turn_before_rad = 0.0;
  // The robot drove backwards, with the camera looking ahead. All else is as driven: metres,
  // heading and knots count from where the robot began, and its features become smaller on the way.
  bool reverse = false;
  std::vector<Feature> features;
  std::vector<KeyView> key_views;  // in rising s; segments from before there were any have none
  Terrain terrain;

  // Returns the segment's length for people: in metres, or without odometry in seconds of teaching.
  [[nodiscard]] double extent() const { return has_odometry ? length_m : duration_s; }
  [[nodiscard]] double speed_mps() const { return duration_s > 0.0 ? length_m / duration_s : 0.0; }
  bool operator==(const Segment&) const = default;
};

// This names one teaching of a route. A scout that teaches a known route again makes another
// teaching of the same route. A teaching is immutable once it is complete.
struct RouteKey {
  RouteId route;
  TeachingId teaching{1};

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
  auto operator<=>(const RouteKey&) const = default;
};

// This is SHA-256 of the bytes that travel and are stored.
using Digest = std::array<std::uint8_t, 32>;
using Bytes = std::vector<std::uint8_t>;

enum class RouteState : std::uint8_t {
  kTeaching = 0,  // more segments will come
  kComplete = 1,  // immutable from now on
};

// This is a revision's state in its life, as operators set it.
enum class Standing : std::uint8_t {
  kStaged = 0,   // kept, and not in use, or not yet
  kActive = 1,   // the one revision of its route that followers take
  kRetired = 2,  // kept, and offered to nobody
  kDeleted = 3,  // a tombstone: its segments are gone, and no server accepts them again
};

// This is where a route begins, for people and for queries. No robot follows by it.
struct Place {
  enum class Frame : std::uint8_t {
    kSite = 1,   // metres east and north in the site's own frame
    kWgs84 = 2,  // longitude and latitude, degrees
  };
  Frame frame = Frame::kSite;
  double x = 0.0;  // east
  double y = 0.0;  // north

  bool operator==(const Place&) const = default;
};

inline constexpr std::size_t kMaxTags = 16;
inline constexpr std::size_t kMaxDescriptionBytes = 256;

// This is what is known of a route without its segments. The scout announces it, and the catalog
// keeps it. Operators may change its labels afterwards (labels.h): name, revision, tags,
// description, standing, and whether it is to be reviewed.
struct RouteInfo {
  RouteKey key;
  std::string name;  // for people; IsValidName
  // People call this teaching by this number. It is the scout's own count until a server numbers
  // it.
  RevisionNumber revision{};
  AgentId scout;           // who taught it
  std::string camera;      // for people ("webcam 320x240"); at most 128 bytes
  int image_width_px = 0;  // of the scout's frames, reduced and upright
  int image_height_px = 0;
  std::int64_t taught_unix_ms = 0;  // when teaching began, by the scout's clock
  RouteState state = RouteState::kTeaching;
  std::uint32_t segment_count = 0;  // segments taught so far
  double length_m = 0.0;            // sum over those segments
  std::uint64_t bytes = 0;          // sum of their encoded sizes
  // This is SHA-256 over the concatenated digests of segments 0 to segment_count - 1.
  Digest manifest_digest{};
  // The route is complete and yet ends early, because the scout's process, camera or robot failed.
  bool cut_off = false;
  std::vector<std::string> tags{};  // IsValidName each, rising, unique, at most kMaxTags
  std::optional<Place> place{};     // given when teaching
  std::string description{};        // for people: one line, at most kMaxDescriptionBytes
  Standing standing = Standing::kStaged;
  // Its scout wants it reviewed before robots follow it. An operator who activates it ends that.
  bool to_review = false;
  std::uint32_t edition = 0;   // number of changes of the labels since it was taught
  RevisionNumber refreshes{};  // a follower's visit made it of this revision; 0 if it was taught

  // Returns whether no robot follows it, and no server activates it, unless an operator says so.
  [[nodiscard]] bool held_back() const { return cut_off || to_review; }
  bool operator==(const RouteInfo&) const = default;
};

// This is a segment as it travels and is stored: the bytes that were hashed at the scout, which
// nobody encodes again.
struct SegmentPiece {
  RouteKey key;
  SegmentIndex index;
  Digest digest{};
  Bytes bytes;

  bool operator==(const SegmentPiece&) const = default;
};

}  // namespace trailcast::route
