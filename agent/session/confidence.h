#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "services/motion/motion.h"
#include "services/replay/follower.h"

namespace trailcast::agent {

// This is what one frame shows of the route.
struct Sighting {
  std::uint32_t segment = 0;
  int taught = 0;    // features that the segment has
  int agreeing = 0;  // features in view, where the route predicts them
  int vanished = 0;  // features that tracking lost in this frame, in the middle of the picture
  // This is how many of the taught features this camera should have in its picture at the robot's
  // estimated place: a narrower camera than the scout's loses some. Without an estimate all are
  // expected.
  std::optional<int> in_picture = std::nullopt;
  // This is the standard deviation of the place beside the path, if it is estimated.
  std::optional<double> left_sigma_m = std::nullopt;
  // The picture shows that the robot was just carried off.
  bool carried_off = false;
  // These are from the belief over the whole route: the view as a whole is that of the robot's
  // estimated place, or of another place on the route.
  bool recognised = false;
  bool elsewhere = false;
  // Some of that view is in the picture, though too little to steer by, so nothing hides all of it.
  bool glimpsed = false;
  double dt_s = 1.0 / 30.0;  // since the last frame
};

// After a longer gap between frames the robot counts as having seen nothing, rather than as having
// looked in vain.
constexpr double kLongestFrame_s = 0.25;
// This much more than a limit is beyond it: sums of periods come to it with a small error.
constexpr double kTimeSlack_s = 1e-6;

// This is how far a robot may drive.
enum class Trust {
  kSure,    // sure of the path: it follows
  kUnsure,  // sees some of the features, too few to be sure: it follows for a short distance
  // It sees enough features, but all so far away that they tell the heading and not the place
  // beside the path. It follows slowly, as long as the path is still under the robot.
  kDistant,
  kBlind,  // sees next to none: it goes on by odometry alone, slowly, for a short distance
  // A good view was gone all at once, as if a person had stepped in front of the camera. It stands
  // for a while, since it might drive into that.
  kCovered,
  kSeeking,  // it has not found the route's start yet, and stands for a while
  kLooking,  // it has found nothing of the path for too long, and turns on the spot to look for it
  kLost,     // none of these any longer: it stops
};

[[nodiscard]] const char* ToString(Trust trust);

struct Verdict {
  Trust trust = Trust::kSeeking;
  std::string reason;  // one line for people; empty if all is well
};

struct ConfidenceOptions {
  std::string not_found = "the route's start is not found";  // why a robot stands at first
  // With fewer features than this, only odometry is left to steer by.
  int min_features = replay::kFewestAgreeing;
  // A robot is sure that it is on the path if this share of the features that should be in the
  // picture agrees with what was taught. A handful can be found in any picture: a robot that
  // followed those alone would drive through the wrong building with confidence.
  double sure_share = 0.4;
  double sure_least = 5.0;
  double sure_most = 8.0;
  // Near features tell the place beside the path to a centimetre or two. Above the first of these
  // there are only distant ones; above the second the path may be anywhere.
  double distant_sigma_m = 0.07;
  double lost_sigma_m = 0.5;
  double settle_m = 1.0;  // distance to drive until the start's own uncertainty is over
  // A robot that was carried off knows its new place only roughly until it has driven this far.
  double carried_settle_m = 3.0;
  // No robot is carried off so often in a row: its features contradict each other.
  int carried_limit = 8;
  // If fewer than this many should be in the picture, their absence does not tell that the camera
  // is covered.
  int covered_least_expected = 10;
  // These limit how far a robot that is not sure may go on, and how long one without odometry, or
  // one that has not found the route yet, may look around, before it is lost. Beyond them, after it
  // was last sure, it would not follow but drive blindly: a handful of features agree in any
  // picture.
  double unsure_limit_m = 0.5;
  double unsure_limit_s = 1.0;
  double blind_limit_m = 2.5;
  double blind_limit_s = 3.0;
  // The camera was covered if a view of this many times the features that make a robot sure went
  // within this time, and if this share of its features vanished where they were. In a bend a
  // camera with a narrow view loses them as fast, over the picture's edge.
  bool stand_when_covered = true;
  double good_view = 1.5;
  double covered_within_s = 1.5;
  double vanished_share = 0.5;
  double covered_limit_s = 18.0;
  // A person who covered the camera this long ago is probably still near: a view that is gone
  // again, if only at the next segment's start, was covered again.
  double still_about_s = 5.0;
  // The robot keeps following a good view that is going, and does not begin the next segment,
  // before it is clear whether the view is being covered.
  double going_within_s = 20.0 / 30.0;
};

// This tells frame by frame how far a robot may trust what it sees. It has no clock: the frames'
// own periods and metres count.
class Confidence {
 public:
  explicit Confidence(const ConfidenceOptions& options = {}) : options_(options) {}

  // Evidence other than a segment's features shows that the robot is on the path. It may go on as
  // if it had been sure.
  void SetFound() { sure_once_ = true; }
  // The robot looks elsewhere from now on, and stands until it is sure of what is there.
  // `not_found` is the reason.
  void SeekAnew(std::string not_found);
  // `moved` is since the last frame; robots without odometry have none.
  [[nodiscard]] Verdict Judge(const Sighting& seen,
                              const std::optional<motion::OdometryIncrement>& moved);

  // Tells that a good view of the segment was there a moment ago, and that its features did not go
  // over the picture's edge.
  [[nodiscard]] bool view_is_going() const {
    return options_.stand_when_covered && since_good_s_ && *since_good_s_ > 0.0 &&
           *since_good_s_ <= options_.going_within_s + kTimeSlack_s && VanishedInPlace();
  }
  [[nodiscard]] double unsure_s() const { return unsure_s_; }  // since it was last sure
  // Tells that the view as a whole, and not the segment's features, shows that the robot is on the
  // path.
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
  std::optional<double> carried_at_m_;  // distance driven when it was carried off, if it was
  int carries_ = 0;                     // number of times before it had settled after the last
  // These count since it was last sure.
  double unsure_m_ = 0.0;
  double unsure_s_ = 0.0;
  bool recognised_only_ = false;
  bool covered_ = false;
  std::optional<double> since_covered_s_;
  std::optional<double> since_good_s_;  // since a good view; empty if there was none
  int good_features_ = 0;               // in that view
  int vanished_ = 0;                    // since then
};

}  // namespace trailcast::agent
