#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trailcast::route {

// A probability is a number of these parts, from 1 to one less than all.
inline constexpr int kProbabilityBits = 16;
inline constexpr int kCertain = 1 << kProbabilityBits;

// 1 / (1 + exp(-z / 256)), never 0 nor certain. Integers alone: the same on every machine.
[[nodiscard]] int Logistic(int z);

// A row of bits, each written in as little as its probability allows: a binary arithmetic coder. It
// writes and reads by the same calls, so that one function says what a value is made of; who writes
// tells each bit, who reads is told it.
class BitCoder {
 public:
  BitCoder() = default;                       // writes
  explicit BitCoder(std::string_view bytes);  // reads

  [[nodiscard]] bool reads() const { return reads_; }
  // `likely`: how probable it is that the bit is 1. Returns the bit.
  bool Code(bool bit, int likely);
  // The lowest `count` bits of a number of which nothing is known.
  std::uint32_t CodePlain(std::uint32_t value, int count);

  // What was written.
  [[nodiscard]] std::string Finish();
  // Reading has gone beyond the end of the bytes: what was read since then means nothing.
  [[nodiscard]] bool exhausted() const;
  // All bytes were needed, and there were enough of them.
  [[nodiscard]] bool AtEnd() const;

 private:
  void Shift();

  std::string written_;
  std::string_view bytes_;
  std::size_t next_ = 0;  // of the bytes read, including those that lie beyond their end
  bool reads_ = false;
  std::uint32_t lowest_ = 0;
  std::uint32_t highest_ = 0xffff'ffffU;
  std::uint32_t window_ = 0;  // of what is read, as much as lowest_ and highest_ have
};

}  // namespace trailcast::route
