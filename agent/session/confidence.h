#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "services/motion/motion.h"
#include "services/replay/follower.h"

namespace trailcast::agent {

// What is seen of the route in one frame.
struct Sighting {
  std::uint32_t segment = 0;
  int taught = 0;    // features that the segment has
  int agreeing = 0;  // of them in view, where the route says they are
  int vanished = 0;  // lost in this frame by tracking, in the middle of the picture
  // Of those taught, how many this camera should have in its picture where the robot is thought to
  // be: a narrower one than the scout's loses some. Nothing where that is not estimated: all.
  std::optional<int> in_picture = std::nullopt;
  // How well the place beside the path is known; nothing where it is not estimated.
  std::optional<double> left_sigma_m = std::nullopt;
  // What is seen says that somebody carried the robot off just now.
  bool carried_off = false;
  // By the belief over the whole route: the view as a whole is that of where the robot is thought
  // to be; or of somewhere else on the route.
  bool recognised = false;
  bool elsewhere = false;
  // Some of that view is in the picture, if too little to steer by: nothing hides all of it.
  bool glimpsed = false;
  double dt_s = 1.0 / 30.0;  // since the last frame
};

// Of a frame that came so much later the robot saw nothing in between, rather than in vain.
constexpr double kLongestFrame_s = 0.25;
// So much more than a limit is beyond it: sums of periods come to it a little above or below.
constexpr double kTimeSlack_s = 1e-6;

// What a robot may do.
enum class Trust {
  kSure,    // of the path: follow
  kUnsure,  // some of the features, too few to be sure: follow, for a short way
  // Features enough, but all so far away that they tell the heading and not the place beside the
  // path: follow, slowly, as long as the path is still under the robot.
  kDistant,
  kBlind,  // next to none: on by odometry alone, slowly, for a short way
  // A good view was gone all at once, as if somebody had stepped in front of the camera: stand
  // still, for a while. Driving on might mean driving into it.
  kCovered,
  kSeeking,  // the route's start has not been found yet: stand still, for a while
  kLooking,  // it has found nothing of the path for too long: turn on the spot to look for it
  kLost,     // none of these any longer: stop
};

[[nodiscard]] const char* ToString(Trust trust);

struct Verdict {
  Trust trust = Trust::kSeeking;
  std::string reason;  // one line for people; empty when all is well
};

struct ConfidenceOptions {
  std::string not_found = "the route's start is not found";  // why a robot stands at first
  // With fewer features than this there is nothing to steer by but odometry.
  int min_features = replay::kFewestAgreeing;
  // So many of the features that should be in the picture have to agree with what was taught for
  // the robot to be sure that it is on the path. A handful can be found in any picture: a robot
  // that follows those alone would drive through the wrong building with confidence.
  double sure_share = 0.4;
  double sure_least = 5.0;
  double sure_most = 8.0;
  // Near features tell the place beside the path to a centimetre or two. Past the first of these
  // there are only distant ones; past the second the path may be anywhere.
  double distant_sigma_m = 0.07;
  double lost_sigma_m = 0.5;
  double settle_m = 1.0;  // of driving, until the start's own uncertainty is over
  // A robot that was carried off knows its new place only roughly, until it has driven so far.
  double carried_settle_m = 3.0;
  // So often in a row nobody carries a robot: its features contradict each other.
  int carried_limit = 8;
  // With fewer than so many that should be in the picture, their absence says nothing of somebody
  // who covers it.
  int covered_least_expected = 10;
  // How far a robot that is not sure may go on, and how long one without odometry, or one that has
  // not found the route yet, may look around, before it is lost.
  // Further, or longer, than this after it was last sure it does not follow but drive blindly:
  // a handful of features agree in any picture.
  double unsure_limit_m = 0.5;
  double unsure_limit_s = 1.0;
  double blind_limit_m = 2.5;
  double blind_limit_s = 3.0;
  // A view of so many times the features it takes to be sure, gone within so many seconds, was
  // covered, if this share of its features vanished where they were: in a bend a camera with a
  // narrow view loses them as fast, over the picture's edge.
  bool stand_when_covered = true;
  double good_view = 1.5;
  double covered_within_s = 1.5;
  double vanished_share = 0.5;
  double covered_limit_s = 18.0;
  // Whoever covered the view so many seconds ago is still about: a view that is gone again, if only
  // at the next segment's start, was covered again.
  double still_about_s = 5.0;
  // A good view that is going is not to be given up for the next segment's before it is clear
  // whether it is being covered.
  double going_within_s = 20.0 / 30.0;
};

// Says frame by frame how far a robot may trust what it sees. No clock: the frames' own periods and
// metres count.
class Confidence {
 public:
  explicit Confidence(const ConfidenceOptions& options = {}) : options_(options) {}

  // The robot is on the path by other evidence than a segment's features: it may go on as if it had
  // been sure.
  void SetFound() { sure_once_ = true; }
  // It looks elsewhere from now on: until it is sure of what is there it stands. `not_found` is
  // why.
  void SeekAnew(std::string not_found);
  // `moved`: since the last frame; nothing on robots without odometry.
  [[nodiscard]] Verdict Judge(const Sighting& seen,
                              const std::optional<motion::OdometryIncrement>& moved);

  // A good view of the segment is a moment ago, and it is not over the edge that its features went.
  [[nodiscard]] bool view_is_going() const {
    return options_.stand_when_covered && since_good_s_ && *since_good_s_ > 0.0 &&
           *since_good_s_ <= options_.going_within_s + kTimeSlack_s && VanishedInPlace();
  }
  [[nodiscard]] double unsure_s() const { return unsure_s_; }  // since it was last sure
  // Not the segment's features, but the view as a whole says that the robot is on the path.
  [[nodiscard]] bool recognised_only() const { return recognised_only_; }
  [[nodiscard]] const ConfidenceOptions& options() const { return options_; }
  [[nodiscard]] bool ever_sure() const { return sure_once_; }

 private:
  [[nodiscard]] int Wanted(const Sighting& seen) const;
  void NoteView(const Sighting& seen);
  void NoteCarry();
  [[nodiscard]] bool SettlesAfterCarry() const {
    return carried_at_m_ && driven_m_ - *carried_at_m_ < options_.carried_settle_m;
  }
  [[nodiscard]] bool CoveredNow(const Sighting& seen) const;
  [[nodiscard]] bool VanishedInPlace() const {
    return vanished_ >= options_.vanished_share * good_features_;
  }
  [[nodiscard]] Verdict JudgePlace(const Sighting& seen) const;
  [[nodiscard]] Trust Decide(const Sighting& seen, bool by_distance) const;
  [[nodiscard]] std::string Explain(const Sighting& seen, bool by_distance) const;

  ConfidenceOptions options_;
  bool sure_once_ = false;
  double driven_m_ = 0.0;
  std::optional<double> carried_at_m_;  // of what it has driven; nothing: it was not carried off
  int carries_ = 0;                     // before it had settled after the last
  // Since it was last sure.
  double unsure_m_ = 0.0;
  double unsure_s_ = 0.0;
  bool recognised_only_ = false;
  bool covered_ = false;
  std::optional<double> since_covered_s_;
  std::optional<double> since_good_s_;  // view; nothing: there was none
  int good_features_ = 0;               // then
  int vanished_ = 0;                    // since then
};

}  // namespace trailcast::agent
