#include "services/lab/trial/align/src/alignment_path.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace trailcast::trial {

double AlignmentPath::Cost(int from, int to) const {
  const int steps = to - from;
  double cost = costs_.per_step * std::abs(steps - 1);
  if (steps < 0) cost += costs_.per_back_step * -steps;
  if (steps > costs_.quick_steps) cost += costs_.per_quick_step * (steps - costs_.quick_steps);
  return std::min(cost, costs_.jump);
}

std::size_t AlignmentPath::BestOf(const Row& row) {
  const auto best = std::max_element(
      row.begin(), row.end(), [](const Step& a, const Step& b) { return a.score < b.score; });
  return static_cast<std::size_t>(best - row.begin());
}

void AlignmentPath::Add(const std::vector<Candidate>& candidates) {
  Row row;
  for (const Candidate& candidate : candidates) {
    Step step{candidate, std::log2(1.0 + candidate.inliers), 0};
    if (!rows_.empty()) {
      const Row& last = rows_.back();
      double best = -INFINITY;
      for (std::size_t i = 0; i < last.size(); ++i) {
        const double score = last[i].score - Cost(last[i].candidate.teach, candidate.teach);
        if (score <= best) continue;
        best = score;
        step.before = i;
      }
      step.score += best;
    }
    row.push_back(step);
  }
  rows_.push_back(std::move(row));
}

const Candidate& AlignmentPath::Best() const {
  return rows_.back()[BestOf(rows_.back())].candidate;
}

std::vector<Candidate> AlignmentPath::Trace() const {
  std::vector<Candidate> trace(rows_.size());
  std::size_t at = rows_.empty() ? 0 : BestOf(rows_.back());
  for (std::size_t i = rows_.size(); i-- > 0;) {
    trace[i] = rows_[i][at].candidate;
    at = rows_[i][at].before;
  }
  return trace;
}

}  // namespace trailcast::trial
