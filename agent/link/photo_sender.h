#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/ids.h"
#include "services/exchange/messages.h"
#include "services/photos/photo_folder.h"

namespace trailcast::agent {

// Hands the photos on this robot's disk over to the server that it hears, the first taken first,
// and removes each once the server has it on its own disk. There is one piece under way at a time,
// which is small enough for its answer to come soon, so that everything else on the link goes
// between. After a cut it goes on from the byte that the server lacks. It has no clock of its own.
class PhotoSender {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kSmallestPiece = 4U << 10U;
  static constexpr std::size_t kLargestPiece = 32U << 10U;
  // A piece that is not answered is sent again after the first pause, and then after ever longer
  // ones.
  static constexpr std::chrono::milliseconds kSoon{1000};
  static constexpr std::chrono::milliseconds kLate{30'000};
  // A server that takes nothing, because its disk is full, is asked again after this.
  static constexpr std::chrono::milliseconds kAfterRefusal{60'000};

  PhotoSender(AgentId self, photos::PhotoFolder& folder)
      : self_(std::move(self)), folder_(folder) {}

  void Handle(const exchange::Message& message, Time now);
  // Returns the piece to publish, if one is due.
  [[nodiscard]] std::vector<exchange::Message> Due(Time now, const std::optional<AgentId>& server);
  // Returns lines for the log.
  [[nodiscard]] std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }

 private:
  // Begins with the next photo, if there is one. One whose bytes are damaged is removed.
  void Begin();
  void Adapt(std::chrono::milliseconds answered_after);

  AgentId self_;
  photos::PhotoFolder& folder_;
  std::optional<AgentId> server_;
  std::optional<photos::Photo> photo_;  // the one under way
  std::vector<std::uint8_t> jpeg_;      // and its bytes
  std::uint32_t offset_ = 0;
  std::size_t piece_bytes_ = kSmallestPiece;
  Time sent_at_{};
  Time again_at_{};
  std::chrono::milliseconds pause_ = kSoon;
  std::string refused_;  // the last reason that was told
  std::vector<std::string> news_;
};

}  // namespace trailcast::agent
