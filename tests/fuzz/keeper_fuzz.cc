// A server among strangers, with a disk that fills up and restarts in between: it says that it has
// what it has, and nothing else.
#include <memory>

#include "services/catalog/catalog.h"
#include "services/catalog/editing.h"
#include "services/exchange/route_keeper.h"
#include "tests/fuzz/messages.h"
#include "tests/support/memory_store.h"

namespace trailcast::fuzz {
namespace {

using exchange::RouteKeeper;

class Server {
 public:
  Server() { Start(); }

  void Start() {
    const auto answer = [this](const exchange::CatalogRequest& request) {
      return catalog::Answer(request, kSelf, store_);
    };
    const auto plan = [this](const route::RouteEdit& edit) {
      return catalog::PlanEdit(edit, store_);
    };
    keeper_ = *RouteKeeper::Open(kSelf, store_, {.answer = answer, .plan = plan},
                                 test::ToyIntegrity(), kOptions);
  }
  void FillUp(bool full) { store_.full = full; }
  void Handle(const exchange::Message& message, Time now) { keeper_->Handle(message, now); }

  void Tick(Time now) {
    const std::vector<exchange::Message> out = keeper_->Tick(now);
    RequireBounds(out);
    for (const auto& receipt : test::Only<exchange::Receipt>(out)) Check(receipt);
    for (const auto& announcement : test::Only<exchange::RouteAnnouncement>(out)) {
      Require(announcement.holder == kSelf, "it announces as itself");
      Check(announcement.info);
    }
    for (const auto& request : test::Only<exchange::SegmentRequest>(out)) {
      for (const SegmentIndex index : request.lacking) {
        Require(!Holds(request.key, index), "it asks for what it lacks");
      }
    }
    for (const route::SegmentPiece& piece : test::PiecesIn(out)) {
      const auto stored = store_.ReadSegment(piece.key, piece.index);
      Require(stored && stored->digest == piece.digest, "it sends what it has");
      Require(piece.bytes.empty() || *stored == piece, "it sends it as it has it, or its digest");
    }
    Require(keeper_->TakeNotes().size() <= kMostNotes, "notes are bounded");
  }

 private:
  static constexpr std::size_t kMostNotes = 1000;
  // Fewer at hand than there are routes, so that they are laid aside and taken up.
  static constexpr exchange::RouteKeeperOptions kOptions{.most_at_hand = 3,
                                                         .announced_at_start = 2};
  inline static const AgentId kSelf{"server"};

  bool Holds(const route::RouteKey& key, SegmentIndex index) {
    return store_.ReadSegment(key, index).has_value();
  }
  void Check(const exchange::Receipt& receipt) {
    for (std::uint32_t i = 0; i < receipt.durable_prefix; ++i) {
      Require(Holds(receipt.key, SegmentIndex(i)), "a receipt's prefix is stored");
    }
    for (const auto& [index, digest] : receipt.durable_beyond) {
      Require(Holds(receipt.key, index), "a receipt's further segments are stored");
      Require(store_.ReadSegment(receipt.key, index)->digest == digest, "and are these bytes");
    }
    if (receipt.durable_state != route::RouteState::kComplete) return;
    const auto info = store_.FindRoute(receipt.key).value();
    Require(info && info->state == route::RouteState::kComplete, "a complete route is stored");
    Require(receipt.durable_prefix >= info->segment_count, "all of a complete route is stored");
    Check(*info);
  }
  void Check(const route::RouteInfo& info) {
    Require(store_.FindRoute(info.key).value() == info, "what it announces is stored");
    if (info.standing == route::Standing::kDeleted) {
      Require(store_.HeldSegments(info.key)->empty(), "of what is deleted nothing is left");
      return;
    }
    std::vector<route::Digest> digests;
    for (std::uint32_t i = 0; i < info.segment_count; ++i) {
      const auto piece = store_.ReadSegment(info.key, SegmentIndex(i));
      Require(piece.has_value(), "segments that it announces are stored");
      digests.push_back(piece->digest);
    }
    Require(info.state == route::RouteState::kTeaching ||
                test::ToyManifest(digests) == info.manifest_digest,
            "a complete route's segments are those of its manifest");
  }

  test::MemoryStore store_;
  std::unique_ptr<RouteKeeper> keeper_;
};

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast::fuzz;
  FuzzedDataProvider input(data, size);
  Stranger stranger(input);
  Server server;
  Time now{};
  while (input.remaining_bytes() > 0) {
    switch (input.ConsumeIntegralInRange<int>(0, 9)) {
      case 0:
        server.Start();
        break;
      case 1:
        server.FillUp(input.ConsumeBool());
        break;
      case 2:
      case 3:
        now += stranger.Pause();
        server.Tick(now);
        break;
      default:
        server.Handle(stranger.Say(), now);
    }
  }
  server.Tick(now);
  return 0;
}
