#include "services/route/src/patch_model.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace trailcast::route {
namespace {

constexpr int kSampleLevels = 16;
constexpr int kMeanSample = 8;
constexpr int kLevelUnit = 256;  // one level, and a neighbour's full weight

// These are the neighbours that are known when a sample is coded. The nearest one inside replaces
// one outside the patch.
struct Neighbours {
  int left = kMeanSample;
  int above = kMeanSample;
  int above_left = kMeanSample;
  int above_right = kMeanSample;
  int second_left = kMeanSample;
  int second_above = kMeanSample;
};

Neighbours NeighboursOf(const Patch& patch, int row, int column) {
  const auto at = [&patch](int r, int c) {
    return int{patch.at(static_cast<std::size_t>(r * kPatchSize + c))};
  };
  if (row == 0 && column == 0) return {};
  Neighbours near;
  near.left = column > 0 ? at(row, column - 1) : at(row - 1, column);
  near.above = row > 0 ? at(row - 1, column) : near.left;
  near.above_left = row > 0 && column > 0 ? at(row - 1, column - 1) : near.above;
  near.above_right = row > 0 && column + 1 < kPatchSize ? at(row - 1, column + 1) : near.above;
  near.second_left = column > 1 ? at(row, column - 2) : near.left;
  near.second_above = row > 1 ? at(row - 2, column) : near.above;
  return near;
}

// These are the neighbours' weights, in the order of `Neighbours`, and the steepness of a sample's
// logistic distribution, in 1/256 for each level, by how much the neighbours differ. They are
// fitted to the patches of 4 900 features of five recordings.
constexpr std::size_t kActivities = 8;
struct Expectation {
  std::array<int, 6> weights;
  std::array<int, kActivities> steepness;
};
constexpr Expectation kInside = {{208, 145, -107, 21, -24, -6},
                                 {883, 595, 449, 337, 253, 210, 190, 157}};
constexpr Expectation kFirstRow = {{299, 0, 0, 0, -43, 0},
                                   {371, 190, 108, 108, 108, 108, 108, 108}};
constexpr Expectation kFirstColumn = {{0, 203, 0, 22, 0, -16},
                                      {371, 231, 190, 157, 130, 130, 89, 67}};
constexpr Expectation kFirst = {{}, {130, 130, 130, 130, 130, 130, 130, 130}};

const Expectation& ExpectationAt(int row, int column) {
  if (row > 0) return column > 0 ? kInside : kFirstColumn;
  return column > 0 ? kFirstRow : kFirst;
}

// This is a sample's distribution: a logistic one about the prediction, mixed with a small uniform
// one.
class SampleModel {
 public:
  SampleModel(const Neighbours& near, const Expectation& expectation) {
    const std::array values = {near.left,        near.above,       near.above_left,
                               near.above_right, near.second_left, near.second_above};
    centre_ = kMeanSample * kLevelUnit;
    for (std::size_t i = 0; i < values.size(); ++i) {
      centre_ += expectation.weights.at(i) * (values.at(i) - kMeanSample);
    }
    const int halves =
        2 * (std::abs(near.left - near.above_left) + std::abs(near.above - near.above_left) +
             std::abs(near.above - near.above_right)) +
        std::abs(near.left - near.second_left) + std::abs(near.above - near.second_above);
    steepness_ =
        expectation.steepness.at(std::min(kActivities - 1, static_cast<std::size_t>(halves) / 4));
  }

  // Returns the probability of a sample below `level`.
  [[nodiscard]] int Below(int level) const {
    constexpr int kEach = 32;  // the least share of each level
    if (level <= 0) return 0;
    if (level >= kSampleLevels) return kCertain;
    const int from_centre = level * kLevelUnit - kLevelUnit / 2 - centre_;
    const int logistic = Logistic(from_centre * steepness_ / kLevelUnit);
    return level * kEach +
           static_cast<int>(std::int64_t{logistic} * (kCertain - kSampleLevels * kEach) / kCertain);
  }

 private:
  int centre_ = 0;
  int steepness_ = 0;
};

std::uint8_t CodeSample(BitCoder& coder, int sample, const SampleModel& model) {
  int low = 0;
  int high = kSampleLevels;
  int below_low = 0;
  int below_high = kCertain;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    const int below = model.Below(middle);
    const auto above =
        static_cast<int>(std::int64_t{below_high - below} * kCertain / (below_high - below_low));
    if (coder.Code(sample >= middle, std::clamp(above, 1, kCertain - 1))) {
      low = middle;
      below_low = below;
    } else {
      high = middle;
      below_high = below;
    }
  }
  return static_cast<std::uint8_t>(low);
}

}  // namespace

void CodePatch(BitCoder& coder, Patch& patch) {
  for (int row = 0; row < kPatchSize; ++row) {
    for (int column = 0; column < kPatchSize; ++column) {
      const SampleModel model(NeighboursOf(patch, row, column), ExpectationAt(row, column));
      auto& sample = patch.at(static_cast<std::size_t>(row * kPatchSize + column));
      sample = CodeSample(coder, sample, model);
    }
  }
}

}  // namespace trailcast::route
