#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "services/base/ids.h"
#include "services/mission/mission.h"
#include "services/mission/now.h"
#include "services/route/route.h"
#include "services/route/route_edit.h"
#include "services/route/route_query.h"

namespace trailcast::exchange {

// trailcast/now and trailcast/now_answers.
using mission::NowAnswer;
using mission::NowCommand;
using mission::NowOrder;
using mission::NowWhom;
using mission::ToString;

// Every member has an initialiser, so that designated initialisers may leave some out.
// One value type for each topic of the wire (idl/trailcast.idl); the prose is in
// docs/reference/protocol.md.

// trailcast/routes: the latest that is known of a route, from its scout or from a server. A server
// announces what it can serve: while it lacks segments, `info` is kTeaching and counts the durable
// prefix only, its length and bytes are estimates and its manifest digest is zero.
struct RouteAnnouncement {
  AgentId holder{};  // who announces, and can be asked for segments
  route::RouteInfo info{};
  bool operator==(const RouteAnnouncement&) const = default;
};

// trailcast/segments: from a scout teaching, or a holder answering a request. 32 to 64 KiB a batch.
// A piece without bytes tells its digest: who has these bytes already, in another revision, needs
// no more; who has not asks for them.
struct SegmentBatch {
  AgentId sender{};
  std::vector<route::SegmentPiece> pieces{};
  // What the sender is believed, where senders are known (with DDS Security): anything, what it
  // taught itself (a scout), or only what can be proven (a follower). Not on the wire.
  enum class Trust : std::uint8_t { kAll, kOwnRoutes, kProof };
  Trust trust = Trust::kAll;
  // Of a route that `scout` taught, as far as that is known: to be proven.
  [[nodiscard]] bool IsLent(const std::optional<AgentId>& scout) const {
    return trust == Trust::kProof || (trust == Trust::kOwnRoutes && scout && *scout != sender);
  }
  bool operator==(const SegmentBatch&) const = default;
};

// trailcast/segment_requests: "of this route I lack these". Without indices: "who has this route?",
// which its holders answer by announcing it again.
struct SegmentRequest {
  AgentId requester{};
  route::RouteKey key{};
  std::vector<SegmentIndex> lacking{};
  bool digests_only = false;  // the pieces without their bytes
  bool operator==(const SegmentRequest&) const = default;
};

// Why a server takes nothing of a revision.
enum class Refusal : std::uint8_t {
  kNone = 0,
  kFull = 1,     // its disk, or what it may use of it; it may have room later
  kDeleted = 2,  // an operator deleted the revision
};

// A segment's bytes, named.
struct NamedSegment {
  SegmentIndex index;
  route::Digest digest{};
  bool operator==(const NamedSegment&) const = default;
};

// trailcast/receipts: "of this teaching, these bytes are on my disk": of all segments below
// durable_prefix, and of some beyond. Whoever hears it compares digests: other bytes under the same
// name are none of its own.
struct Receipt {
  AgentId server{};
  route::RouteKey key{};
  std::uint32_t durable_prefix = 0;
  route::Digest prefix_digest{};  // route::ChainDigest of these; zero of none
  std::vector<NamedSegment> durable_beyond{};
  // kComplete: the route's final RouteInfo is on disk too and its manifest digest was found right.
  route::RouteState durable_state = route::RouteState::kTeaching;
  // What the server calls it; never less than its scout did. 0: it is not stored there yet.
  RevisionNumber revision{};
  route::Standing standing = route::Standing::kStaged;
  RevisionNumber followed{};  // the revision of its route that is active there; 0: none
  Refusal refusal = Refusal::kNone;
  std::string reason{};  // for people: of a refusal; else what is worth knowing, or nothing
  bool operator==(const Receipt&) const = default;
};

// trailcast/catalog_requests and trailcast/catalog_replies.
struct CatalogRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  route::RouteQuery query{};  // anything: the server says in its reply what is wrong with it
  bool operator==(const CatalogRequest&) const = default;
};

// trailcast/route_edits: answered by a CatalogReply with the revisions as they are then.
struct RouteEditRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply; the same one is carried out once
  route::RouteEdit edit{};    // anything: the server says in its reply what is wrong with it
  bool operator==(const RouteEditRequest&) const = default;
};

// An agent has all of a revision in its own store.
struct Holding {
  route::RouteKey key{};
  AgentId agent{};
  bool operator==(const Holding&) const = default;
};

// A complete route is served in part: so many of its segments are lost at the server.
struct LackingSegments {
  route::RouteKey key{};
  std::uint32_t segments = 0;
  bool operator==(const LackingSegments&) const = default;
};

struct CatalogReply {
  AgentId server{};
  AgentId client{};
  std::uint64_t request = 0;
  route::RoutePage page{};
  std::vector<std::string> similar_names{};  // when no route has the name: those that exist
  std::string error{};                       // not empty: the request could not be answered
  std::vector<Holding> holdings{};           // of the revisions on this page, as far as agents told
  std::vector<LackingSegments> lacking{};    // of the revisions on this page those served in part
  // When asked by view: likest first, `page` has the route of each; none: nothing looks like it.
  std::vector<route::FoundPlace> places{};
  route::ViewCoverage coverage{};
  bool operator==(const CatalogReply&) const = default;
};

enum class AgentRole : std::uint8_t { kServer = 0, kScout = 1, kFollower = 2, kOperator = 3 };

// What the agent does at present, for people and for tools.
enum class AgentMode : std::uint8_t {
  kStarting = 0,
  kWaiting = 1,  // for a server, a route or a segment; `detail` says which
  kTeaching = 2,
  kReplaying = 3,
  kArrived = 4,  // the scout: taught and everything receipted
  kStopped = 5,  // by a signal or at the end of a recording
  kFault = 6,    // cannot go on; `detail` says why
};

// A robot's place on a route. Says nothing about one on another revision, let alone another route.
struct PlaceOnRoute {
  route::RouteKey key{};
  double along_m = 0.0;       // from the route's beginning, in the scout's metres
  double left_m = 0.0;        // beside the path
  double left_sigma_m = 0.0;  // how sure it is of that; 0: not known
  bool operator==(const PlaceOnRoute&) const = default;
};

// The evidence that carries a follower along its route.
enum class CarriedBy : std::uint8_t {
  kNothing = 0,
  kFeatures = 1,  // the segment's features, tracked
  kViews = 2,     // key views that are recognised
  kMotion = 3,    // neither: how it is measured, or told, to move
};

// What a follower's odometry is trusted for.
struct OdometryTrust {
  std::uint8_t percent = 0;  // how far it is believed, against what the camera sees
  double scale = 0.0;        // the route's metres for each of its own; 0: not known
  bool operator==(const OdometryTrust&) const = default;
};

// What a robot follows its route by.
struct Following {
  CarriedBy carried_by = CarriedBy::kNothing;
  std::optional<OdometryTrust> odometry{};  // of a robot that has it
  bool operator==(const Following&) const = default;
};

// How operators have a robot stand.
enum class AgentHold : std::uint8_t { kNone = 0, kPaused = 1, kStopped = 2 };

// How a message came, as the exchange that took it saw. Not on the wire, and no part of what is
// said: what is equal stays so however it came.
struct Arrival {
  std::string address{};  // from where: IP address and port; empty: not known
  std::string network{};  // the network interface towards there; empty: not known
  std::chrono::duration<double, std::milli> late{0};  // by both clocks: below 0 where these differ
  bool operator==(const Arrival&) const { return true; }
};

// trailcast/agents
struct AgentStatus {
  AgentId agent{};
  std::uint64_t instance = 0;  // random per process: tells two processes with one name apart
  AgentRole role = AgentRole::kOperator;
  AgentMode mode = AgentMode::kStarting;
  std::string route{};         // name; empty if none
  std::uint32_t segment = 0;   // segment being taught or replayed
  std::uint32_t segments = 0;  // segments known of the route
  double progress = 0.0;       // 0..1 of the route as far as it is known; the scout: of its drive
  double speed_mps = 0.0;
  std::uint32_t features = 0;           // tracked at present
  double found_share = 0.0;             // mean share of features found at hand-overs so far
  std::uint32_t backlog = 0;            // scout: segments without a receipt
  std::string detail{};                 // one line for people
  std::vector<route::RouteKey> held{};  // revisions of which all is in its store, newest first
  std::optional<PlaceOnRoute> place{};  // a follower's, once it has found itself on its route
  AgentHold hold = AgentHold::kNone;
  bool on_duty = false;                           // it takes missions
  std::optional<std::uint8_t> battery_percent{};  // where the robot tells
  std::optional<std::uint8_t> link_percent{};     // of its radio, likewise
  std::string software{};                         // its version, for people
  std::optional<Following> following{};           // of a follower that is on its way
  Arrival arrival{};
  bool operator==(const AgentStatus&) const = default;
};

// A name that two running processes have.
struct ClaimedName {
  AgentId agent{};
  std::uint64_t claims = 0;  // the instance that came to the name last
  std::uint64_t keeps = 0;   // the one whose it is; 0: the other has not spoken since
  bool operator==(const ClaimedName&) const = default;
};

// trailcast/fleet: what a server tells agents of all others, who do not hear each other.
struct Fleet {
  AgentId server{};
  std::uint32_t agents = 0;  // that the server hears
  std::vector<ClaimedName> claimed{};
  bool operator==(const Fleet&) const = default;
};

struct RouteFollower {
  AgentId agent{};
  double along_m = 0.0;
  double speed_mps = 0.0;
  bool heard = true;  // false: its agent has ended or is out of reach; it may stand there yet
  std::chrono::milliseconds age{0};  // since it told of that
  bool operator==(const RouteFollower&) const = default;
};

// trailcast/neighbours: a server to the followers of a route, who do not hear each other: where
// all of them are that have not arrived.
struct RouteFollowers {
  AgentId server{};
  route::RouteKey key{};
  std::vector<RouteFollower> followers{};
  bool operator==(const RouteFollowers&) const = default;
};

// trailcast/mission_requests and trailcast/mission_replies.
struct MissionRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  bool commands = false;      // those that robots were given now, and not missions
  mission::Query query{};
  bool operator==(const MissionRequest&) const = default;
};

struct MissionReply {
  AgentId server{};
  AgentId client{};
  std::uint64_t request = 0;
  std::vector<mission::Record> missions{};        // the newest first
  std::vector<mission::GivenCommand> commands{};  // likewise
  std::uint64_t next = 0;                         // 0: this is the last page
  std::string error{};                            // not empty: the request could not be answered
  bool operator==(const MissionReply&) const = default;
};

// trailcast/drives: a robot that teaches is driven by hand, from a program. Said again many times a
// second: a robot that has not heard one for a moment stands.
struct DriveCommand {
  AgentId agent{};            // whom it is for
  AgentId client{};           // who drives
  double linear_mps = 0.0;    // ahead
  double turn_radps = 0.0;    // to the left
  std::uint64_t sent_ms = 0;  // by the client's clock, from any time on: tells late ones
  bool operator==(const DriveCommand&) const = default;
};

// trailcast/glance_requests: what a robot's camera sees is asked for, once.
struct GlanceRequest {
  AgentId agent{};  // whom it is for
  AgentId client{};
  std::uint64_t request = 0;
  bool operator==(const GlanceRequest&) const = default;
};

// trailcast/glances: the robot's answer.
struct Glance {
  AgentId agent{};
  AgentId client{};  // who has asked, and which request it was
  std::uint64_t request = 0;
  std::vector<std::uint8_t> picture{};  // JPEG; empty: there is none, and `detail` says why
  bool marked = false;                  // the features that the robot follows are drawn on it
  std::string detail{};                 // one line for people
  bool operator==(const Glance&) const = default;
};

// trailcast/network_edits: an operator changes how routes are joined, or closes a stretch. Answered
// by a NetworkReply.
struct NetworkEdit {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  std::string words{};        // one line: network/words.h
  bool operator==(const NetworkEdit&) const = default;
};

// trailcast/network_requests: how routes are joined, or which way leads from one place to another.
struct NetworkRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  std::string words{};        // one line: network/words.h; empty: all that is known
  std::uint32_t first = 0;    // NetworkReply::next of the page before
  bool operator==(const NetworkRequest&) const = default;
};

// trailcast/network_replies
struct NetworkReply {
  AgentId server{};
  AgentId client{};
  std::uint64_t request = 0;
  std::vector<std::string> lines{};  // network/words.h; of a way, orders as missions have them
  std::uint32_t next = 0;            // 0: this is the last page
  std::string error{};               // not empty: it could not be done, or answered
  bool operator==(const NetworkReply&) const = default;
};

// Of these stretches along a route it is told how robots follow.
inline constexpr double kFollowedStretch_m = 5.0;

// trailcast/followed: how a follower has followed a revision since it last said so.
struct FollowedStretches {
  struct Stretch {
    std::uint32_t number = 0;  // along the route, from 0
    std::uint32_t passed = 0;  // how often it came over it
    std::uint32_t lost = 0;    // of those, how often it lost its path, found again or not
    bool operator==(const Stretch&) const = default;
  };
  AgentId agent{};
  route::RouteKey key{};
  std::vector<Stretch> stretches{};
  bool operator==(const FollowedStretches&) const = default;
};

// trailcast/reach_requests: every agent and server is asked whom it hears.
struct ReachRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reports
  bool relayed = false;       // by `server`, for those who do not hear its client
  AgentId server{};           // empty unless it is relayed
  bool operator==(const ReachRequest&) const = default;
};

struct HeardAgent {
  AgentId agent{};
  AgentRole role = AgentRole::kOperator;
  std::chrono::milliseconds heard_for{0};  // without a break
  std::chrono::milliseconds age{0};        // since it spoke last
  double late_ms = 0.0;                    // Arrival::late of that
  std::optional<double> round_trip_ms{};   // if it was measured
  std::string address{};                   // as Arrival has it
  std::string network{};
  bool operator==(const HeardAgent&) const = default;
};

// trailcast/reach_reports: its answer, of many that are heard in several parts.
struct ReachReport {
  AgentId agent{};   // who hears these
  AgentId client{};  // who has asked, and which request it was
  std::uint64_t request = 0;
  AgentId server{};  // who has passed the question on; empty: nobody
  AgentRole role = AgentRole::kOperator;
  bool star = false;                // it meets route servers alone; as its exchange says
  std::vector<HeardAgent> heard{};  // those after the first `before`, by name
  std::uint32_t before = 0;
  bool relayed = false;  // by that server
  bool operator==(const ReachReport&) const = default;
};

// trailcast/stores: what a server holds of the routes whose ids begin with `prefix`, in short
// (mirror.h), for other servers. Either `parts`, one for each two digits that may follow the
// prefix, or `entries`: each of its revisions, the deleted ones too.
struct StoreSummary {
  struct Entry {
    route::RouteKey key{};
    std::uint64_t digest = 0;
    bool operator==(const Entry&) const = default;
  };
  AgentId server{};
  std::string prefix{};  // an even number of hexadecimal digits
  std::vector<std::uint64_t> parts{};
  std::vector<Entry> entries{};
  bool operator==(const StoreSummary&) const = default;
};

// Not a topic: a peer's agent is gone (its liveliness ended or it said good-bye).
struct AgentGone {
  AgentId agent{};
  std::uint64_t instance = 0;
  bool operator==(const AgentGone&) const = default;
};

using AnyMessage =
    std::variant<RouteAnnouncement, SegmentBatch, SegmentRequest, Receipt, CatalogRequest,
                 CatalogReply, AgentStatus, RouteEditRequest, Fleet, RouteFollowers, NowCommand,
                 NowAnswer, mission::Mission, mission::Report, MissionRequest, MissionReply,
                 DriveCommand, GlanceRequest, Glance, NetworkEdit, NetworkRequest, NetworkReply,
                 FollowedStretches, ReachRequest, ReachReport, StoreSummary, AgentGone>;

// One of these. Its copies are made in one source file: where each file that hands messages on made
// its own of two dozen types, compilers were busy with nothing else.
struct Message : AnyMessage {
  using AnyMessage::AnyMessage;
  Message();
  Message(const Message& other);
  Message(Message&& other) noexcept;
  Message& operator=(const Message& other);
  Message& operator=(Message&& other) noexcept;
  ~Message();
};

}  // namespace trailcast::exchange
