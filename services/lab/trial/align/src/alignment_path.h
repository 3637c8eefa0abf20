#pragma once

#include <cstddef>
#include <vector>

namespace trailcast::trial {

// A taught picture that a replayed one was compared with.
struct Candidate {
  int teach = 0;  // which of the taught pictures
  int inliers = 0;
};

// How robots move along a route between two replayed pictures, in taught pictures: on, by about as
// many, faster or slower; now and then a little back; anything else is a jump (a lap's end, a cut).
struct PathCosts {
  double per_step = 0.05;  // for each taught picture more or less than one
  int quick_steps = 3;     // as many are nothing unusual; each more than these:
  double per_quick_step = 0.3;
  double per_back_step = 1.5;
  double jump = 8.0;  // the most that any motion costs
};

// The most likely way through the candidates of one replayed picture after the other (Viterbi): the
// sum of log2(1 + inliers), less what the motion between them costs. All that were compared may be
// candidates, or those that were thought worth it.
class AlignmentPath {
 public:
  explicit AlignmentPath(const PathCosts& costs = {}) : costs_(costs) {}

  // The next replayed picture's; one at least.
  void Add(const std::vector<Candidate>& candidates);
  // Which taught picture the best way so far ends at. Something was added before.
  [[nodiscard]] const Candidate& Best() const;
  // The best way, one candidate for each replayed picture.
  [[nodiscard]] std::vector<Candidate> Trace() const;

 private:
  struct Step {
    Candidate candidate;
    double score = 0.0;      // of the best way to here
    std::size_t before = 0;  // in the row before
  };
  using Row = std::vector<Step>;
  [[nodiscard]] double Cost(int from, int to) const;
  [[nodiscard]] static std::size_t BestOf(const Row& row);

  PathCosts costs_;
  std::vector<Row> rows_;
};

}  // namespace trailcast::trial
