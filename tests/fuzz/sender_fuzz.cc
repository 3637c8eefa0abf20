// A scout's end of the protocol among strangers: it sends what it has, and every segment is either
// without a receipt or was reported as having one, once.
#include <set>

#include "services/exchange/route_sender.h"
#include "tests/fuzz/messages.h"

namespace trailcast::fuzz {
namespace {

class Scout {
 public:
  void Teach() {
    if (complete_ || pieces_.size() >= 50) return;
    pieces_.push_back(test::PieceOf(kKey, static_cast<std::uint32_t>(pieces_.size()), 20));
    sender_.Add(pieces_.back(), Info());
  }
  void Complete() {
    complete_ = true;
    sender_.Update(Info());
  }
  void LosePieces(bool lost) { lost_ = lost; }
  void Handle(const exchange::Message& message, Time now) { sender_.Handle(message, now); }

  void Tick(Time now) {
    const std::vector<exchange::Message> out = sender_.Tick(now);
    RequireBounds(out);
    for (const route::SegmentPiece& piece : test::PiecesIn(out)) {
      Require(piece.index.value() < pieces_.size(), "it sends what it has");
      const route::SegmentPiece& taught = pieces_[piece.index.value()];
      Require(piece.digest == taught.digest && (piece.bytes.empty() || piece == taught),
              "it sends it as it has it, or its digest");
    }
    for (const auto& announcement : test::Only<exchange::RouteAnnouncement>(out)) {
      route::RouteInfo expected = Info();
      expected.revision = std::max(expected.revision, announcement.info.revision);
      Require(announcement.info == expected, "it announces what it has");
    }
    for (const SegmentIndex index : sender_.TakeNewlyReceipted()) {
      Require(receipted_.insert(index).second, "a receipt is reported once");
    }
    std::set<SegmentIndex> all = receipted_;
    all.insert(sender_.Unreceipted().begin(), sender_.Unreceipted().end());
    Require(all.size() == pieces_.size() &&
                receipted_.size() + sender_.Unreceipted().size() == all.size(),
            "every segment either has a receipt or lacks one");
    Require(!sender_.AllReceipted() || (complete_ && sender_.Unreceipted().empty()),
            "all receipted is all receipted");
    Require(sender_.TakeReadErrors().size() <= unread_, "what cannot be read is told once");
    unread_ = 0;
  }

 private:
  inline static const route::RouteKey kKey = test::KeyNumber(0);

  [[nodiscard]] route::RouteInfo Info() const {
    return test::InfoOf(kKey, pieces_,
                        complete_ ? route::RouteState::kComplete : route::RouteState::kTeaching);
  }
  Result<route::SegmentPiece> Read(SegmentIndex index) {
    if (!lost_ && index.value() < pieces_.size()) return pieces_[index.value()];
    ++unread_;
    return Fail(ErrorCode::kCorrupt, "segment {} cannot be read", index.value());
  }

  std::vector<route::SegmentPiece> pieces_;
  bool complete_ = false;
  bool lost_ = false;
  std::size_t unread_ = 0;
  std::set<SegmentIndex> receipted_;
  exchange::RouteSender sender_{
      AgentId("scout-1"), Info(), [this](SegmentIndex index) { return Read(index); }, {}, {}};
};

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast::fuzz;
  FuzzedDataProvider input(data, size);
  Stranger stranger(input);
  Scout scout;
  Time now{};
  while (input.remaining_bytes() > 0) {
    switch (input.ConsumeIntegralInRange<int>(0, 9)) {
      case 0:
      case 1:
        now += stranger.Pause();
        scout.Tick(now);
        break;
      case 2:
      case 3:
        scout.Teach();
        break;
      case 4:
        input.ConsumeIntegral<std::uint8_t>() == 0 ? scout.Complete()
                                                   : scout.LosePieces(input.ConsumeBool());
        break;
      default:
        scout.Handle(stranger.Say(), now);
    }
  }
  scout.Tick(now);
  return 0;
}
