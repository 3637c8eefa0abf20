#include "tests/support/faulty_exchange.h"

#include <algorithm>
#include <utility>

namespace trailcast::exchange {

FaultyExchange::FaultyExchange(std::unique_ptr<RouteExchange> inner, Faults faults,
                               std::uint32_t seed)
    : inner_(std::move(inner)), faults_(faults), random_(seed) {}

Result<void> FaultyExchange::Publish(const Message& message) {
  if (refusing_) return Fail(ErrorCode::kUnavailable, "refused by the faulty exchange");
  if (cut_off_) return {};
  return inner_->Publish(message);
}

std::vector<Message> FaultyExchange::Take(std::chrono::milliseconds max_wait) {
  std::vector<Message> taken;
  for (Delayed& delayed : delayed_) {
    if (--delayed.takes_left == 0) taken.push_back(std::move(delayed.message));
  }
  std::erase_if(delayed_, [](const Delayed& delayed) { return delayed.takes_left <= 0; });

  const bool wait = taken.empty() && delayed_.empty();
  std::vector<Message> arrived = inner_->Take(wait ? max_wait : std::chrono::milliseconds(0));
  if (cut_off_) return {};
  for (Message& message : arrived) {
    if (Strikes(faults_.drop)) continue;
    CorruptSome(message);
    if (Strikes(faults_.duplicate)) taken.push_back(message);
    if (Strikes(faults_.delay)) {
      std::uniform_int_distribution<int> takes(1, std::max(1, faults_.max_delay_takes));
      delayed_.push_back({takes(random_), std::move(message)});
    } else {
      taken.push_back(std::move(message));
    }
  }
  return taken;
}

bool FaultyExchange::Strikes(double share) {
  return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < share;
}

void FaultyExchange::CorruptSome(Message& message) {
  auto* batch = std::get_if<SegmentBatch>(&message);
  if (batch == nullptr) return;
  for (route::SegmentPiece& piece : batch->pieces) {
    if (piece.bytes.empty() || !Strikes(faults_.corrupt)) continue;
    std::uniform_int_distribution<std::size_t> position(0, piece.bytes.size() - 1);
    piece.bytes[position(random_)] ^= 0x10U;
  }
}

}  // namespace trailcast::exchange
