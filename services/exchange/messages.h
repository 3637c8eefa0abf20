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

// These travel on trailcast/now and trailcast/now_answers.
using mission::NowAnswer;
using mission::NowCommand;
using mission::NowOrder;
using mission::NowWhom;
using mission::ToString;

// Each topic of the wire (idl/trailcast.idl) has one value type here; docs/reference/protocol.md
// describes them. Every member has an initialiser, so that designated initialisers may leave some
// out.

// trailcast/routes has the latest that is known of a route, from its scout or from a server. A
// server announces what it can serve: while it lacks segments, `info` is kTeaching and counts the
// durable prefix only, its length and bytes are estimates, and its manifest digest is zero.
struct RouteAnnouncement {
  AgentId holder{};  // the agent that announces, and can be asked for segments
  route::RouteInfo info{};
  bool operator==(const RouteAnnouncement&) const = default;
};

// trailcast/segments comes from a scout that teaches, or from a holder that answers a request, in
// batches of 32 to 64 KiB. A piece without bytes tells its digest: an agent that has these bytes
// already, from another revision, needs no more, and any other asks for them.
struct SegmentBatch {
  AgentId sender{};
  std::vector<route::SegmentPiece> pieces{};
  // This says what is accepted from the sender, where senders are known (with DDS Security):
  // anything, what it taught itself (a scout), or only what can be proven (a follower). It does not
  // travel on the wire.
  enum class Trust : std::uint8_t { kAll, kOwnRoutes, kProof };
  Trust trust = Trust::kAll;
  // Tells that the pieces have to be proven. `scout` taught their route, as far as that is known.
  [[nodiscard]] bool IsLent(const std::optional<AgentId>& scout) const {
    return trust == Trust::kProof || (trust == Trust::kOwnRoutes && scout && *scout != sender);
  }
  bool operator==(const SegmentBatch&) const = default;
};

// trailcast/segment_requests says "I lack these of this route". Without indices it asks "who has
// this route?", and its holders answer by announcing it again.
struct SegmentRequest {
  AgentId requester{};
  route::RouteKey key{};
  std::vector<SegmentIndex> lacking{};
  bool digests_only = false;  // wants the pieces without their bytes
  bool operator==(const SegmentRequest&) const = default;
};

// This is why a server takes nothing of a revision.
enum class Refusal : std::uint8_t {
  kNone = 0,
  kFull = 1,     // its disk is full, or its share of it; it may have room later
  kDeleted = 2,  // an operator deleted the revision
};

// This names a segment's bytes.
struct NamedSegment {
  SegmentIndex index;
  route::Digest digest{};
  bool operator==(const NamedSegment&) const = default;
};

// trailcast/receipts acknowledges bytes: "of this teaching, these bytes are on my disk", for all
// segments below durable_prefix and for some beyond. A reader compares digests, since other bytes
// may have the same name.
struct Receipt {
  AgentId server{};
  route::RouteKey key{};
  std::uint32_t durable_prefix = 0;
  route::Digest prefix_digest{};  // route::ChainDigest of these; zero if there are none
  std::vector<NamedSegment> durable_beyond{};
  // kComplete says that the route's final RouteInfo is on disk too, and that its manifest digest
  // was found right.
  route::RouteState durable_state = route::RouteState::kTeaching;
  // This is the server's number for it, never less than its scout's. 0 says that it is not stored
  // there yet.
  RevisionNumber revision{};
  route::Standing standing = route::Standing::kStaged;
  RevisionNumber followed{};  // the active revision of its route there; 0 if none is
  Refusal refusal = Refusal::kNone;
  std::string reason{};  // for people: why it was refused, or else a remark, or nothing
  bool operator==(const Receipt&) const = default;
};

// This travels on trailcast/catalog_requests; CatalogReply on trailcast/catalog_replies.
struct CatalogRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  route::RouteQuery query{};  // not checked: the server's reply says what is wrong with it
  bool operator==(const CatalogRequest&) const = default;
};

// trailcast/route_edits is answered by a CatalogReply with the revisions as they are then.
struct RouteEditRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply; a repeated one is carried out once
  route::RouteEdit edit{};    // not checked: the server's reply says what is wrong with it
  bool operator==(const RouteEditRequest&) const = default;
};

// This agent has a whole revision in its own store.
struct Holding {
  route::RouteKey key{};
  AgentId agent{};
  bool operator==(const Holding&) const = default;
};

// The server has lost so many segments of this complete route, and serves the others.
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
  std::vector<std::string> similar_names{};  // existing names, when no route has the name
  std::string error{};                     // why the request could not be answered; empty if it was
  std::vector<Holding> holdings{};         // of the revisions on this page, as far as agents told
  std::vector<LackingSegments> lacking{};  // revisions on this page that are served in part
  // A query by view fills this with the likeliest place first, and `page` with the route of each.
  // It is empty if nothing looks like the view.
  std::vector<route::FoundPlace> places{};
  route::ViewCoverage coverage{};
  bool operator==(const CatalogReply&) const = default;
};

enum class AgentRole : std::uint8_t { kServer = 0, kScout = 1, kFollower = 2, kOperator = 3 };

// This is what the agent does at present, for people and for tools.
enum class AgentMode : std::uint8_t {
  kStarting = 0,
  kWaiting = 1,  // for a server, a route or a segment; `detail` says which
  kTeaching = 2,
  kReplaying = 3,
  kArrived = 4,  // the scout has taught, and all is acknowledged
  kStopped = 5,  // by a signal, or at the end of a recording
  kFault = 6,    // it cannot go on; `detail` says why
};

// This is a robot's place on a route. It says nothing about places on another revision or another
// route.
struct PlaceOnRoute {
  route::RouteKey key{};
  double along_m = 0.0;       // from the route's beginning, in the scout's metres
  double left_m = 0.0;        // beside the path
  double left_sigma_m = 0.0;  // standard deviation of left_m; 0 if not known
  bool operator==(const PlaceOnRoute&) const = default;
};

// This is the evidence that carries a follower along its route.
enum class CarriedBy : std::uint8_t {
  kNothing = 0,
  kFeatures = 1,  // the segment's features, tracked
  kViews = 2,     // key views that are recognised
  kMotion = 3,    // neither: by its motion, as measured or as commanded
};

// This is how far a follower trusts its odometry.
struct OdometryTrust {
  std::uint8_t percent = 0;  // weight against what the camera sees
  double scale = 0.0;        // the route's metres for each of its own; 0 if not known
  bool operator==(const OdometryTrust&) const = default;
};

// This is what a robot follows its route by.
struct Following {
  CarriedBy carried_by = CarriedBy::kNothing;
  std::optional<OdometryTrust> odometry{};  // of a robot that has odometry
  bool operator==(const Following&) const = default;
};

// This is how operators keep a robot standing.
enum class AgentHold : std::uint8_t { kNone = 0, kPaused = 1, kStopped = 2 };

// This is how a message came, as the exchange that took it saw. It does not travel on the wire and
// is no part of what was said, so any two compare equal.
struct Arrival {
  std::string address{};  // the sender's IP address and port; empty if not known
  std::string network{};  // the network interface towards there; empty if not known
  std::chrono::duration<double, std::milli> late{0};  // by both clocks, so below 0 if they differ
  bool operator==(const Arrival&) const { return true; }
};

// This travels on trailcast/agents.
struct AgentStatus {
  AgentId agent{};
  std::uint64_t instance = 0;  // random per process, so that two processes of one name differ
  AgentRole role = AgentRole::kOperator;
  AgentMode mode = AgentMode::kStarting;
  std::string route{};         // name; empty if none
  std::uint32_t segment = 0;   // segment being taught or replayed
  std::uint32_t segments = 0;  // segments known of the route
  double progress = 0.0;       // share of the known route, 0..1; of its drive for a scout
  double speed_mps = 0.0;
  std::uint32_t features = 0;           // tracked at present
  double found_share = 0.0;             // mean share of features found at hand-overs so far
  std::uint32_t backlog = 0;            // a scout's segments without a receipt
  std::string detail{};                 // one line for people
  std::vector<route::RouteKey> held{};  // revisions that are whole in its store, the newest first
  std::optional<PlaceOnRoute> place{};  // a follower's, once it has found its place on its route
  AgentHold hold = AgentHold::kNone;
  // It is available for missions; a server keeps them in queues.
  bool on_duty = false;
  std::optional<std::uint8_t> battery_percent{};  // if the robot reports it
  std::optional<std::uint8_t> link_percent{};     // of its radio, if the robot reports it
  std::string software{};                         // its version, for people
  std::optional<Following> following{};           // of a follower that is on its way
  Arrival arrival{};
  bool operator==(const AgentStatus&) const = default;
};

// Two running processes use this name.
struct ClaimedName {
  AgentId agent{};
  std::uint64_t claims = 0;  // the instance that took the name last
  std::uint64_t keeps = 0;   // the instance that keeps it; 0 if the other has not spoken since
  bool operator==(const ClaimedName&) const = default;
};

// On trailcast/fleet a server tells agents about all others, since agents do not hear each other.
struct Fleet {
  AgentId server{};
  std::uint32_t agents = 0;  // number of agents that the server hears
  std::vector<ClaimedName> claimed{};
  bool operator==(const Fleet&) const = default;
};

struct RouteFollower {
  AgentId agent{};
  double along_m = 0.0;
  double speed_mps = 0.0;
  // It is false if its agent has ended or is out of reach; the robot may still stand there.
  bool heard = true;
  std::chrono::milliseconds age{0};  // since it reported that place
  bool operator==(const RouteFollower&) const = default;
};

// On trailcast/neighbours a server tells the followers of a route where all of them are that have
// not arrived, since they do not hear each other.
struct RouteFollowers {
  AgentId server{};
  route::RouteKey key{};
  std::vector<RouteFollower> followers{};
  bool operator==(const RouteFollowers&) const = default;
};

// This travels on trailcast/mission_requests; MissionReply on trailcast/mission_replies.
struct MissionRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  bool commands = false;      // asks for the commands that robots were given, and not for missions
  mission::Query query{};
  bool operator==(const MissionRequest&) const = default;
};

struct MissionReply {
  AgentId server{};
  AgentId client{};
  std::uint64_t request = 0;
  std::vector<mission::Record> missions{};        // the newest first
  std::vector<mission::GivenCommand> commands{};  // the newest first
  // The answer to a query for one robot has this robot, if the server has heard it since it
  // started, and otherwise others that the server has heard, at most kMaxRobotsTold.
  std::vector<std::string> robots{};
  std::uint64_t next = 0;  // 0: this is the last page
  std::string error{};     // why the request could not be answered; empty if it was
  bool operator==(const MissionReply&) const = default;
};

// trailcast/drives is teleoperation of a robot that teaches. The command is repeated many times a
// second; a robot that has not heard one for a moment stops.
struct DriveCommand {
  AgentId agent{};          // the robot
  AgentId client{};         // the client that drives
  double linear_mps = 0.0;  // forwards
  double turn_radps = 0.0;  // to the left
  // This is by the client's clock, from any origin, and shows which commands are late.
  std::uint64_t sent_ms = 0;
  bool operator==(const DriveCommand&) const = default;
};

// trailcast/snapshot_requests asks for one snapshot of what a robot's camera sees.
struct SnapshotRequest {
  AgentId agent{};  // the robot
  AgentId client{};
  std::uint64_t request = 0;
  bool operator==(const SnapshotRequest&) const = default;
};

// `trailcast/snapshots` has the robot's answer.
struct Snapshot {
  AgentId agent{};
  AgentId client{};  // the client that asked; `request` is its request
  std::uint64_t request = 0;
  std::vector<std::uint8_t> picture{};  // JPEG; empty if there is none, and `detail` says why
  bool marked = false;                  // the features that the robot follows are drawn on it
  std::string detail{};                 // one line for people
  bool operator==(const Snapshot&) const = default;
};

// On trailcast/network_edits an operator changes how routes are joined, or closes a section. A
// NetworkReply answers it.
struct NetworkEdit {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  std::string words{};        // one line, see network/words.h
  bool operator==(const NetworkEdit&) const = default;
};

// trailcast/network_requests asks how routes are joined, or which path leads from one place to
// another.
struct NetworkRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reply
  std::string words{};        // one line, see network/words.h; empty asks for all that is known
  std::uint32_t first = 0;    // NetworkReply::next of the page before
  bool operator==(const NetworkRequest&) const = default;
};

// This travels on trailcast/network_replies.
struct NetworkReply {
  AgentId server{};
  AgentId client{};
  std::uint64_t request = 0;
  std::vector<std::string> lines{};  // see network/words.h; a path is told as a mission's orders
  std::uint32_t next = 0;            // 0: this is the last page
  std::string error{};               // why it could not be done or answered; empty if it was
  bool operator==(const NetworkReply&) const = default;
};

// Following is reported for sections of this length along a route.
inline constexpr double kFollowedSection_m = 5.0;

// trailcast/followed tells how a follower has followed a revision since its last report.
struct FollowedSections {
  struct Section {
    std::uint32_t number = 0;  // of the section, counted along the route from 0
    std::uint32_t passed = 0;  // how often the robot passed it
    std::uint32_t lost = 0;    // how often it lost its path there, found again or not
    bool operator==(const Section&) const = default;
  };
  AgentId agent{};
  route::RouteKey key{};
  std::vector<Section> sections{};
  bool operator==(const FollowedSections&) const = default;
};

// trailcast/reach_requests asks every agent and server whom it hears.
struct ReachRequest {
  AgentId client{};
  std::uint64_t request = 0;  // echoed in the reports
  bool relayed = false;       // `server` asks for agents that do not hear its client
  AgentId server{};           // empty unless it is relayed
  bool operator==(const ReachRequest&) const = default;
};

struct HeardAgent {
  AgentId agent{};
  AgentRole role = AgentRole::kOperator;
  std::chrono::milliseconds heard_for{0};  // without a break
  std::chrono::milliseconds age{0};        // since its last message
  double late_ms = 0.0;                    // Arrival::late of its last message
  std::optional<double> round_trip_ms{};   // if it was measured
  std::string address{};                   // see Arrival::address
  std::string network{};
  bool operator==(const HeardAgent&) const = default;
};

// trailcast/reach_reports has the answer, in several parts if the agent hears many.
struct ReachReport {
  AgentId agent{};   // the agent that hears these
  AgentId client{};  // the client that asked; `request` is its request
  std::uint64_t request = 0;
  AgentId server{};  // the server that passed the question on, if any
  AgentRole role = AgentRole::kOperator;
  bool star = false;                // its exchange says that it meets route servers alone
  std::vector<HeardAgent> heard{};  // agents after the first `before`, by name
  std::uint32_t before = 0;
  bool relayed = false;  // `server` has passed the report on
  bool operator==(const ReachReport&) const = default;
};

// trailcast/stores summarises what a server holds of the routes whose ids begin with `prefix`, for
// other servers (mirror.h). It has either `parts`, one for each two digits that may follow the
// prefix, or `entries` with each revision, including deleted ones.
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

// `trailcast/photos` has a piece of a photo that a robot took on a mission: from the robot to the
// server that it hears, and from a server to an operator who has asked (photos/photo.h).
struct PhotoPiece {
  AgentId holder{};  // the sender
  AgentId client{};  // the receiver
  std::string photo{};
  std::string words{};  // what is known of it, one line
  std::uint32_t offset = 0;
  std::vector<std::uint8_t> bytes{};
  std::string error{};  // why there are none, for people
  bool operator==(const PhotoPiece&) const = default;
};

// `trailcast/photo_requests` asks for a photo from a byte on. A server says so of each piece that
// it has taken from a robot and, at last, that it keeps the photo.
struct PhotoRequest {
  AgentId client{};
  AgentId holder{};
  std::string photo{};
  std::uint32_t offset = 0;
  bool kept = false;      // it is on the client's disk
  std::string refusal{};  // why the client does not take it, for people
  bool operator==(const PhotoRequest&) const = default;
};

// This is not a topic: a peer's agent has gone, since its liveliness ended or it said good-bye.
struct AgentGone {
  AgentId agent{};
  std::uint64_t instance = 0;
  bool operator==(const AgentGone&) const = default;
};

using AnyMessage =
    std::variant<RouteAnnouncement, SegmentBatch, SegmentRequest, Receipt, CatalogRequest,
                 CatalogReply, AgentStatus, RouteEditRequest, Fleet, RouteFollowers, NowCommand,
                 NowAnswer, mission::Mission, mission::Report, MissionRequest, MissionReply,
                 DriveCommand, SnapshotRequest, Snapshot, NetworkEdit, NetworkRequest, NetworkReply,
                 FollowedSections, ReachRequest, ReachReport, StoreSummary, PhotoPiece,
                 PhotoRequest, AgentGone>;

// This is one of these types. One source file makes its copies; otherwise each file that hands
// messages on would make its own for two dozen types, which dominates compile times.
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
