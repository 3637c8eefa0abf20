#include "services/lab/trial/recording/frame_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace trailcast::trial {
namespace {

using Order = std::vector<Shown>;

// Draws a whole number below `bound`, the same with every standard library.
int Below(int bound, std::mt19937_64& random) {
  return static_cast<int>(random() % static_cast<std::uint64_t>(bound));
}

Order Every(const Order& order, int stride) {
  Order kept;
  bool cut = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    cut = cut || order[i].cut;
    if (i % static_cast<std::size_t>(stride) != 0) continue;
    kept.push_back({order[i].frame, cut});
    cut = false;
  }
  return kept;
}

Order Slower(const Order& order, int times) {
  Order slower;
  for (const Shown& shown : order) {
    slower.push_back(shown);
    for (int i = 1; i < times; ++i) slower.push_back({shown.frame, false});
  }
  return slower;
}

Order Reverse(const Order& order) {
  Order reversed(order.rbegin(), order.rend());
  // A cut is between two frames, and the other one now comes second.
  for (std::size_t i = 0; i < reversed.size(); ++i) {
    reversed[i].cut = i > 0 && order[order.size() - i].cut;
  }
  return reversed;
}

// Makes up to three gaps, each somewhere in the middle of its own part of the recording.
Result<Order> Skip(const Order& order, int left_out, std::mt19937_64& random) {
  constexpr int kMostGaps = 3;
  const int frames = static_cast<int>(order.size());
  if (frames < 2 * left_out) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} frames are too few to leave {} out: give a recording of twice as many", frames,
                left_out);
  }
  const int gaps = std::clamp(frames / (3 * left_out), 1, kMostGaps);
  const int part = frames / gaps;
  Order kept;
  int from = 0;
  for (int gap = 0; gap < gaps; ++gap) {
    const int begin = gap * part + part / 5 + Below(std::max(1, part * 4 / 5 - left_out), random);
    kept.insert(kept.end(), order.begin() + from, order.begin() + begin);
    from = begin + left_out;
    if (from < frames) {
      kept.push_back({order[static_cast<std::size_t>(from)].frame, true});
      ++from;
    }
  }
  kept.insert(kept.end(), order.begin() + std::min(from, frames), order.end());
  return kept;
}

// Takes sections of equal length from random places, the first from the beginning.
Result<Order> Jump(const Order& order, int jumps, std::mt19937_64& random) {
  constexpr int kShortestStretch = 10;
  const int frames = static_cast<int>(order.size());
  const int stretch = frames / (jumps + 1);
  if (stretch < kShortestStretch) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} frames are too few for {} jumps: each goes on for {} frames at least", frames,
                jumps, kShortestStretch);
  }
  Order jumped(order.begin(), order.begin() + stretch);
  int at = stretch;
  for (int jump = 0; jump < jumps; ++jump) {
    int to = Below(frames - stretch + 1, random);
    // The next section must not be where the last one leads anyway.
    while (std::abs(to - at) < frames / 5) to = Below(frames - stretch + 1, random);
    jumped.push_back({order[static_cast<std::size_t>(to)].frame, true});
    jumped.insert(jumped.end(), order.begin() + to + 1, order.begin() + to + stretch);
    at = to + stretch;
  }
  return jumped;
}

Order From(const Order& order, double share) {
  const auto left_out = static_cast<std::ptrdiff_t>(share * static_cast<double>(order.size()));
  Order rest(order.begin() + left_out, order.end());
  if (!rest.empty()) rest.front().cut = false;
  return rest;
}

}  // namespace

Result<std::vector<Shown>> OrderOf(const Disturbance& disturbance, int frames, std::uint64_t seed) {
  Order order;
  for (int frame = 0; frame < frames; ++frame) order.push_back({frame, false});
  std::mt19937_64 random(seed);
  for (const Change& change : disturbance) {
    const int value = static_cast<int>(change.value);
    Result<Order> changed = order;
    if (change.kind == ChangeKind::kEvery) changed = Every(order, value);
    if (change.kind == ChangeKind::kSlower) changed = Slower(order, value);
    if (change.kind == ChangeKind::kReverse) changed = Reverse(order);
    if (change.kind == ChangeKind::kSkip) changed = Skip(order, value, random);
    if (change.kind == ChangeKind::kFrom) changed = From(order, change.value);
    if (change.kind == ChangeKind::kJump) changed = Jump(order, value, random);
    if (!changed) return changed;
    order = std::move(*changed);
  }
  return order;
}

bool GoesForward(const std::vector<Shown>& order) {
  return std::is_sorted(order.begin(), order.end(),
                        [](const Shown& a, const Shown& b) { return a.frame < b.frame; });
}

}  // namespace trailcast::trial
