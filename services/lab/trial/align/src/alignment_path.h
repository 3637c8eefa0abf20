#pragma once

#include <cstddef>
#include <vector>

namespace trailcast::trial {

// A taught picture with which a replayed one was compared.
struct Candidate {
  int teach = 0;  // index of the taught picture
  int inliers = 0;
};

// How robots move along a route between two replayed pictures, counted in taught pictures: ahead,
// by about as many, faster or slower, and now and then a little back. Anything else is a jump (a
// lap's end, a cut).
struct PathCosts {
  double per_step = 0.05;  // for each taught picture more or less than one
  int quick_steps = 3;     // this many are usual; each further one costs:
  double per_quick_step = 0.3;
  double per_back_step = 1.5;
  double jump = 8.0;  // the most that any motion costs
};

// The most likely path through the candidates of consecutive replayed pictures (Viterbi). It
// maximises the sum of log2(1 + inliers) less the cost of the motion in between. Candidates may be
// all compared pictures, or a selection.
class AlignmentPath {
 public:
  explicit AlignmentPath(const PathCosts& costs = {}) : costs_(costs) {}

  // Adds the next replayed picture's candidates, of which there is at least one.
  void Add(const std::vector<Candidate>& candidates);
  // Returns the taught picture at the end of the best path so far, after something was added.
  [[nodiscard]] const Candidate& Best() const;
  // Returns the best path, with one candidate for each replayed picture.
  [[nodiscard]] std::vector<Candidate> Trace() const;

 private:
  struct Step {
    Candidate candidate;
    double score = 0.0;      // of the best path up to here
    std::size_t before = 0;  // in the row before
  };
  using Row = std::vector<Step>;
  [[nodiscard]] double Cost(int from, int to) const;
  [[nodiscard]] static std::size_t BestOf(const Row& row);

  PathCosts costs_;
  std::vector<Row> rows_;
};

}  // namespace trailcast::trial
