#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/bag/bag.h"

namespace trailcast::bag {

// A file's list of contents, or what was counted in the file.
struct Contents {
  std::vector<Topic> topics;
  std::chrono::nanoseconds first_at{};  // recording time of its first message,
  std::chrono::nanoseconds last_at{};   // and of its last
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

  // Bounds unpacking; see Bag::Open.
  void Bound(std::optional<std::uint64_t> most_growth) { most_growth_ = most_growth; }

  // Returns the damage found since the last call.
  [[nodiscard]] std::vector<std::string> TakeDamage() { return std::exchange(damage_, {}); }

 protected:
  BagFile() = default;
  void NoteDamage(std::string what) {
    if (damage_.size() < Bag::kMostDamage) damage_.push_back(std::move(what));
  }
  // Says whether unpacking so many bytes of a file of that size is within the bound.
  [[nodiscard]] bool MayUnpack(std::uint64_t bytes, std::uint64_t size) const {
    return !most_growth_ || bytes <= *most_growth_ * size + Bag::kFreeBytes;
  }

 private:
  std::vector<std::string> damage_;
  std::optional<std::uint64_t> most_growth_;
};

// A larger message is damage: a picture of 30 megapixels in colour is smaller.
inline constexpr std::size_t kMostMessageBytes = std::size_t{100} << 20U;

}  // namespace trailcast::bag
