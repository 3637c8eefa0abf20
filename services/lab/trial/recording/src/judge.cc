#include "services/lab/trial/recording/judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trailcast::trial {
namespace {

bool Follows(const Said& said) {
  return said.claim == Claim::kFollowing || said.claim == Claim::kArrived;
}

// Records when a robot was off its place, and how soon it was back.
class OffWatch {
 public:
  explicit OffWatch(const JudgeOptions& options) : options_(options) {}

  void Cut(int at) {
    End(at);
    since_ = at;
  }
  void See(int at, bool right) {
    if (right && off()) {
      const double took_s = (at - since_) / options_.rate_hz;
      found_s_.push_back(took_s);
      ++offs_;
      if (took_s <= options_.found_within_s) ++in_time_;
      since_ = kOn;
    } else if (!right && !off() && ever_right_) {
      since_ = at;
    }
    ever_right_ = ever_right_ || right;
  }
  // Ends the record: nothing more is seen from this frame on.
  void End(int at) {
    if (off() && (at - since_) / options_.rate_hz > options_.found_within_s) ++offs_;
    since_ = kOn;
  }
  void Fill(Verdict& verdict) const {
    verdict.offs = offs_;
    verdict.found_in_time = in_time_;
    verdict.found_s = found_s_;
  }

 private:
  static constexpr int kOn = -1;
  [[nodiscard]] bool off() const { return since_ != kOn; }

  const JudgeOptions& options_;
  int since_ = kOn;
  bool ever_right_ = false;
  int offs_ = 0;
  int in_time_ = 0;
  std::vector<double> found_s_;
};

void JudgeClaims(const Replayed& replayed, Verdict& verdict) {
  verdict.frames = static_cast<int>(replayed.shown.size());
  for (const Said& said : replayed.said) {
    verdict.following += Follows(said) ? 1 : 0;
    verdict.lost += said.claim == Claim::kLost ? 1 : 0;
    verdict.arrived = verdict.arrived || said.claim == Claim::kArrived;
  }
}

std::optional<double> OwnTurn(const Replayed& replayed, int teach_frame) {
  const auto frame = static_cast<std::size_t>(teach_frame);
  return frame < replayed.own_turns_rad.size() ? replayed.own_turns_rad[frame] : std::nullopt;
}

void JudgeSide(const Said& said, const Alignment& truth, std::optional<double> own_turn_rad,
               const JudgeOptions& options, Verdict& verdict) {
  const bool sided = std::abs(truth.median_du_px) > options.side_above * options.width_px;
  if (options.width_px <= 0 || !sided || said.claim != Claim::kFollowing) return;
  ++verdict.sided;
  if (said.turn_rad * truth.median_du_px > 0.0) ++verdict.side_right;
  if (!own_turn_rad) return;
  ++verdict.corrected;
  if ((said.turn_rad - *own_turn_rad) * truth.median_du_px > 0.0) ++verdict.correction_right;
}

void JudgePlaces(const Replayed& replayed, const Reference& reference, const JudgeOptions& options,
                 Verdict& verdict) {
  const std::vector<std::optional<Alignment>> truth = AlignmentsOf(replayed, reference);
  OffWatch offs(options);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const int at = static_cast<int>(i);
    if (replayed.shown[i].cut) offs.Cut(at);
    if (!truth[i]) continue;
    ++verdict.aligned;
    bool right = false;
    if (i < replayed.said.size()) {
      const Said& said = replayed.said[i];
      const double off = std::abs(said.teach_frame - truth[i]->teach_frame);
      right = Follows(said) && off <= options.right_within * replayed.teach_frames;
      verdict.right += right ? 1 : 0;
      verdict.wrong += Follows(said) && !right ? 1 : 0;
      JudgeSide(said, *truth[i], OwnTurn(replayed, truth[i]->teach_frame), options, verdict);
    }
    offs.See(at, right);
  }
  offs.End(static_cast<int>(truth.size()));
  offs.Fill(verdict);
}

void JudgeSteering(const Replayed& replayed, const Steering& steering, const JudgeOptions& options,
                   Verdict& verdict) {
  for (std::size_t i = 0; i < replayed.said.size(); ++i) {
    const Said& said = replayed.said[i];
    if (said.claim != Claim::kFollowing) continue;
    for (int lead = options.steering_leads_least; lead <= options.steering_leads_most; ++lead) {
      const auto steered = steering.find(replayed.shown[i].frame - lead);
      if (steered == steering.end()) continue;
      if (std::abs(steered->second) <= options.steering_above) continue;
      ++verdict.steered;
      verdict.steered_alike += steered->second * said.turn_rad > 0.0 ? 1 : 0;
    }
  }
}

}  // namespace

void Verdict::Add(const Verdict& other) {
  frames += other.frames;
  following += other.following;
  lost += other.lost;
  arrived = arrived || other.arrived;
  aligned += other.aligned;
  right += other.right;
  wrong += other.wrong;
  sided += other.sided;
  side_right += other.side_right;
  corrected += other.corrected;
  correction_right += other.correction_right;
  steered += other.steered;
  steered_alike += other.steered_alike;
  offs += other.offs;
  found_in_time += other.found_in_time;
  found_s.insert(found_s.end(), other.found_s.begin(), other.found_s.end());
}

std::vector<std::optional<Alignment>> AlignmentsOf(const Replayed& replayed,
                                                   const Reference& reference) {
  const int below = (replayed.stride - 1) / 2;
  const int above = replayed.stride / 2;
  const auto by_frame = [](const Alignment& row, int frame) { return row.replay_frame < frame; };
  std::vector<std::optional<Alignment>> found;
  found.reserve(replayed.shown.size());
  for (const Shown& shown : replayed.shown) {
    const auto first =
        std::lower_bound(reference.begin(), reference.end(), shown.frame - below, by_frame);
    const auto end = std::lower_bound(first, reference.end(), shown.frame + above + 1, by_frame);
    const auto nearest = std::min_element(first, end, [&](const auto& a, const auto& b) {
      return std::abs(a.replay_frame - shown.frame) < std::abs(b.replay_frame - shown.frame);
    });
    const bool good = nearest != end && nearest->good;
    found.push_back(good ? std::optional(*nearest) : std::nullopt);
  }
  return found;
}

Verdict Judge(const Replayed& replayed, const Reference& reference, const Steering& steering,
              const JudgeOptions& options) {
  Verdict verdict;
  JudgeClaims(replayed, verdict);
  JudgePlaces(replayed, reference, options, verdict);
  JudgeSteering(replayed, steering, options, verdict);
  return verdict;
}

}  // namespace trailcast::trial
