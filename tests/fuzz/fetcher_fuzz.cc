// A follower's end of the protocol among strangers: what it hands over is whole and of its route,
// and a route that it calls complete is.
#include <map>

#include "services/exchange/route_fetcher.h"
#include "tests/fuzz/messages.h"

namespace trailcast::fuzz {
namespace {

class Follower {
 public:
  explicit Follower(FuzzedDataProvider& input) {
    std::vector<exchange::RouteFetcher::Held> held;
    for (const SegmentIndex index : Stranger(input).Indices()) {
      if (digests_.contains(index)) continue;
      digests_[index] = test::PieceOf(kKey, index.value(), 20).digest;
      held.push_back({index, digests_[index]});
    }
    fetcher_.emplace(AgentId("follower-1"), kKey, held, test::ToyIntegrity(), Time{});
  }

  void Handle(const exchange::Message& message, Time now) { fetcher_->Handle(message, now); }
  void Learn(const route::RouteInfo& info, Time now) { fetcher_->Learn(info, now); }
  void Tick(Time now) {
    const std::vector<exchange::Message> out = fetcher_->Tick(now);
    TakeArrived();
    RequireBounds(out);
    for (const auto& request : test::Only<exchange::SegmentRequest>(out)) {
      Require(request.key == kKey, "it asks for its route");
      for (const SegmentIndex index : request.lacking) {
        Require(!digests_.contains(index), "it asks for what it lacks");
        Require(fetcher_->info() && index.value() < fetcher_->info()->segment_count,
                "it asks for what was announced");
      }
    }
    CheckProgress(fetcher_->Progress(now));
  }

 private:
  inline static const route::RouteKey kKey = test::KeyNumber(0);

  void TakeArrived() {
    for (const route::SegmentPiece& piece : fetcher_->TakeArrived()) {
      Require(piece.key == kKey, "a piece is of its route");
      Require(test::ToyIntegrity().check_piece(piece).has_value(), "a piece is whole");
      Require(digests_.emplace(piece.index, piece.digest).second, "a piece comes once");
    }
  }
  void CheckProgress(const exchange::FetchProgress& progress) {
    Require(progress.held == digests_.size(), "what it holds is counted");
    Require(fetcher_->Complete() == (progress.state == exchange::FetchState::kComplete),
            "complete is complete");
    if (!fetcher_->Complete()) return;
    std::vector<route::Digest> digests;
    for (std::uint32_t i = 0; i < fetcher_->info()->segment_count; ++i) {
      Require(digests_.contains(SegmentIndex(i)), "all of a complete route arrived");
      digests.push_back(digests_[SegmentIndex(i)]);
    }
    Require(test::ToyManifest(digests) == fetcher_->info()->manifest_digest,
            "a complete route's segments are those of its manifest");
  }

  std::map<SegmentIndex, route::Digest> digests_;
  std::optional<exchange::RouteFetcher> fetcher_;
};

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast::fuzz;
  FuzzedDataProvider input(data, size);
  Stranger stranger(input);
  Follower follower(input);
  Time now{};
  while (input.remaining_bytes() > 0) {
    switch (input.ConsumeIntegralInRange<int>(0, 7)) {
      case 0:
      case 1:
        now += stranger.Pause();
        follower.Tick(now);
        break;
      case 2:
        follower.Learn(stranger.Info(), now);
        break;
      default:
        follower.Handle(stranger.Say(), now);
    }
  }
  follower.Tick(now);
  return 0;
}
