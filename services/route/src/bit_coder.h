#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trailcast::route {

// A probability is a number of parts of kCertain, from 1 to kCertain - 1.
inline constexpr int kProbabilityBits = 16;
inline constexpr int kCertain = 1 << kProbabilityBits;

// Returns 1 / (1 + exp(-z / 256)), never 0 nor certain. It uses integers alone, to be the same on
// every machine.
[[nodiscard]] int Logistic(int z);

// This is a binary arithmetic coder: it writes each bit in as little as its probability allows. It
// writes and reads by the same calls, so that one function tells what a value is made of. A writer
// passes each bit; a reader gets it returned.
class BitCoder {
 public:
  BitCoder() = default;                       // for writing
  explicit BitCoder(std::string_view bytes);  // for reading

  [[nodiscard]] bool reads() const { return reads_; }
  // Codes one bit and returns it. `likely` is the probability that the bit is 1.
  bool Code(bool bit, int likely);
  // Codes the lowest `count` bits of a number of which nothing is known.
  std::uint32_t CodePlain(std::uint32_t value, int count);

  // Returns what was written.
  [[nodiscard]] std::string Finish();
  // Returns whether reading has gone beyond the end of the bytes. Values that were read since then
  // mean nothing.
  [[nodiscard]] bool exhausted() const;
  // Returns whether the bytes were enough, and all of them were needed.
  [[nodiscard]] bool AtEnd() const;

 private:
  void Shift();

  std::string written_;
  std::string_view bytes_;
  std::size_t next_ = 0;  // next byte to read, which may lie beyond their end
  bool reads_ = false;
  std::uint32_t lowest_ = 0;
  std::uint32_t highest_ = 0xffff'ffffU;
  std::uint32_t window_ = 0;  // the part of what is read that lowest_ and highest_ span
};

}  // namespace trailcast::route
