#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <semaphore>
#include <utility>
#include <vector>

namespace trailcast {

// A bounded queue without locks, from one thread to one other. It connects the control loop with
// the link thread, so that neither ever waits for the other.
template <typename T>
class Mailbox {
 public:
  explicit Mailbox(std::size_t capacity) : slots_(capacity + 1) {}

  // Adds an item; the sender's thread alone may call this. A full queue returns false and leaves
  // `item` untouched.
  [[nodiscard]] bool TryPut(T&& item) {
    const std::size_t write = write_.load(std::memory_order_relaxed);
    const std::size_t next = (write + 1) % slots_.size();
    if (next == read_.load(std::memory_order_acquire)) return false;
    slots_[write] = std::move(item);
    write_.store(next, std::memory_order_release);
    return true;
  }

  // Takes the oldest item; the receiver's thread alone may call this.
  [[nodiscard]] std::optional<T> TryGet() {
    const std::size_t read = read_.load(std::memory_order_relaxed);
    if (read == write_.load(std::memory_order_acquire)) return std::nullopt;
    std::optional<T> item(std::move(slots_[read]));
    slots_[read] = T{};
    read_.store((read + 1) % slots_.size(), std::memory_order_release);
    return item;
  }

 private:
  std::vector<T> slots_;  // one slot more than fits, so that full and empty differ
  std::atomic<std::size_t> read_{0};
  std::atomic<std::size_t> write_{0};
};

// Wakes the one thread that waits for it. Ringing takes no lock and never waits.
class Bell {
 public:
  void Ring() {
    if (!rung_.exchange(true)) semaphore_.release();
  }
  // Returns true if it was rung since it last returned true.
  bool Wait(std::chrono::milliseconds at_most) {
    if (!semaphore_.try_acquire_for(at_most)) return false;
    rung_.exchange(false);
    return true;
  }

 private:
  std::atomic<bool> rung_{false};
  std::binary_semaphore semaphore_{0};
};

}  // namespace trailcast
