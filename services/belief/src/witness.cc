#include "services/belief/witness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trailcast::belief {
namespace {

// These are shares of how far a robot may have come whose motion nobody measured, in multiples of
// the guess: half of it lies about the guess, the other half reaches from standing to a multiple of
// it, with a little backwards.
struct Share {
  double of_guess = 0.0;
  double weight = 0.0;
};
constexpr std::array kGuesses = {Share{0.0, 0.11}, Share{0.35, 0.08}, Share{0.7, 0.16},
                                 Share{1.0, 0.25}, Share{1.4, 0.14},  Share{2.0, 0.10},
                                 Share{3.0, 0.05}, Share{-1.0, 0.05}};
// Some multiples of the taught pace are possible whatever the pace so far.
constexpr std::array kPaces = {Share{3.0, 0.04}, Share{4.5, 0.02}};
constexpr double kSlowestPace = 0.2;
constexpr double kFastestBackwards = -3.0;
constexpr double kFastestPace = 4.0;
constexpr double kPaceLearns = 0.1;       // for each look
constexpr double kLongestPaceStep = 0.4;  // route units between looks that tell of the pace
// A measured motion's scale is measured over this many units, with ends known to about this much.
// It drifts by this much a root unit, and lies within these bounds.
constexpr double kScaleBase = 2.0;
constexpr double kEndSigma = 0.2;
constexpr double kScaleDrift = 0.01;
constexpr double kLeastScale = 0.4;
constexpr double kMostScale = 2.5;
constexpr double kBelieved = 0.3;
constexpr double kSameScale = 0.15;
constexpr std::size_t kEnoughDoubted = 3;
constexpr double kScaleSigma = 0.1;

}  // namespace

void Witness::Move(const Motion& motion, double diffusion) {
  guesses_ = motion.guessed;
  if (motion.along == 0.0 && guesses_) return;
  moved_ += motion.along;
  if (guesses_) {
    CellGrid::Taps taps;
    for (const Share& share : kGuesses) {
      taps.Add(share.of_guess * scale_ * motion.along / grid_.cell(), share.weight);
    }
    for (const Share& share : kPaces) {
      taps.Add(share.of_guess * motion.along / grid_.cell(), share.weight);
    }
    grid_.Scatter(taps);
    return;
  }
  const double along = scale_ * motion.along;
  grid_.Shift(along);
  const double by_scale = scale_sigma_ * motion.along;
  grid_.Spread(motion.sigma * motion.sigma + by_scale * by_scale +
               diffusion * diffusion * std::abs(along));
}

void Witness::NoteWay(double come, bool drives_backwards, double trust) {
  const double moved = std::exchange(moved_, 0.0);
  if (guesses_) {
    LearnPace(come, moved, drives_backwards);
  } else {
    LearnScale(come, moved, trust);
  }
}

void Witness::NoteGap(bool held) {
  moved_ = told_ = came_ = 0.0;
  if (guesses_ && !held) scale_ += kPaceLearns * (1.0 - scale_);
}

void Witness::LearnPace(double come, double moved, bool drives_backwards) {
  if (moved <= 0.0 || moved >= kLongestPaceStep) return;
  const double slowest = drives_backwards ? kFastestBackwards : kSlowestPace;
  scale_ = std::clamp(scale_ + kPaceLearns * (come / moved - scale_), slowest, kFastestPace);
}

// This is a Kalman filter of one number, measured every so many units. A witness that is not
// trusted tells nothing of its scale, unless it is wrong by the same factor all the time.
void Witness::LearnScale(double come, double moved, double trust) {
  told_ += moved;
  came_ += come;
  if (std::max(std::abs(told_), std::abs(came_)) < kScaleBase) return;
  const double told = std::exchange(told_, 0.0);
  const double came = std::exchange(came_, 0.0);
  if (std::abs(told) < kLeastScale * std::abs(came)) return;
  const double measured = came / told;
  if (trust < kBelieved) {
    if (!doubted_scales_.empty() &&
        std::abs(measured / doubted_scales_.front() - 1.0) > kSameScale) {
      doubted_scales_.clear();
    }
    doubted_scales_.push_back(measured);
    if (doubted_scales_.size() < kEnoughDoubted) return;
    if (measured < kLeastScale || measured > kMostScale) return;
    scale_ = measured;
    scale_sigma_ = kScaleSigma;
  }
  doubted_scales_.clear();
  const double noise = kEndSigma / std::abs(told);
  const double variance = scale_sigma_ * scale_sigma_ + kScaleDrift * kScaleDrift * std::abs(told);
  const double gain = variance / (variance + noise * noise);
  scale_ = std::clamp(scale_ + gain * (measured - scale_), kLeastScale, kMostScale);
  scale_sigma_ = std::sqrt((1.0 - gain) * variance);
}

}  // namespace trailcast::belief
