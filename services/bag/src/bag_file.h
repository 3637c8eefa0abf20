#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/bag/bag.h"

namespace trailcast::bag {

// What a file says of itself, or what was counted in it.
struct Contents {
  std::vector<Topic> topics;
  std::chrono::nanoseconds first_at{};  // when its first message was recorded,
  std::chrono::nanoseconds last_at{};   // and its last
};

// One file of a recording.
class BagFile {
 public:
  virtual ~BagFile() = default;
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  [[nodiscard]] virtual Result<Contents> Survey(const Bag::Tell& tell) = 0;
  virtual void Begin(const Topic& topic, std::chrono::nanoseconds from) = 0;
  [[nodiscard]] virtual Result<std::optional<Message>> Next() = 0;

  // See Bag::Open.
  void Bound(std::optional<std::uint64_t> most_growth) { most_growth_ = most_growth; }

  // What was found damaged since the last time.
  [[nodiscard]] std::vector<std::string> TakeDamage() { return std::exchange(damage_, {}); }

 protected:
  BagFile() = default;
  void NoteDamage(std::string what) {
    if (damage_.size() < Bag::kMostDamage) damage_.push_back(std::move(what));
  }
  // That so much of a file of that size is not too much.
  [[nodiscard]] bool MayUnpack(std::uint64_t bytes, std::uint64_t size) const {
    return !most_growth_ || bytes <= *most_growth_ * size + Bag::kFreeBytes;
  }

 private:
  std::vector<std::string> damage_;
  std::optional<std::uint64_t> most_growth_;
};

// A message of more bytes is damage: a picture of 30 megapixels in colour is less.
inline constexpr std::size_t kMostMessageBytes = std::size_t{100} << 20U;

}  // namespace trailcast::bag
