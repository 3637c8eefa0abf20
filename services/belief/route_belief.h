#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "services/belief/moved_grid.h"
#include "services/belief/witness.h"

namespace trailcast::belief {

// A key view's place.
struct ViewPlace {
  double at = 0.0;  // from the beginning of the part it comes with, in the route's units
  // By how much larger things are in it than in the view before, as a natural logarithm, to the
  // scout's camera; nothing where the two have too little in common to tell.
  std::optional<double> growth;
  bool own = true;  // false: how the place of the one before it looked later
};

// A stored view that was compared with what the camera sees.
struct ComparedView {
  std::size_t view = 0;    // position among the route's key views
  int agreed = 0;          // features that look alike and lie where one magnification puts them
  double log_scale = 0.0;  // natural logarithm of that magnification, if they are enough to tell it
};

// A place that is known otherwise: by so many features that are tracked and lie where odometry and
// the taught geometry have them.
struct TrackedPlace {
  double along = 0.0;
  int agreed = 0;
};

struct RouteBeliefOptions {
  double cell = 0.1;    // of the grid; the route's units
  double window = 1.0;  // to either side of the likeliest place: what counts as one place
  // Log-likelihood ratio of being at a view, against being off the route, by how many features
  // agree: rising by `gain` a feature from zero at `neutral`. A view that nothing agrees with is no
  // proof of being elsewhere, for somebody may stand before the camera; nor is one of a full house.
  double gain = 1.0;
  double neutral = 4.5;
  double least = -1.2;
  double most = 6.0;
  // And less by how many agree with the best view of this look: other speeds break it otherwise.
  double behind_best = 0.2;
  double behind_best_least = -3.0;
  // Things are as large as this camera has shown them so far, and as the scout saw them grow
  // between one view and the next.
  double log_scale_sigma = 0.05;
  double log_scale_least = -2.0;
  int agreed_for_scale = 12;
  // Chance of leaving the route, and of coming upon it again somewhere, for each independent look.
  double leaves = 0.003;
  double returns = 0.002;
  double starts_off = 0.1;         // chance that a robot that is said to be at a place is not
  double starts_elsewhere = 0.01;  // and that it comes upon the route somewhere else then
  // Chance that another witness of how the robot moves is the better one, for each independent
  // look.
  double witness_changes = 0.02;
  double diffusion = 0.02;  // of the place, per root unit along, besides the motion's own sigma
  // Off the route, there is no place: `here` of the mass has to be about one place and so many
  // features to agree there, in the median of the last looks, for the place to be held. A handful
  // agree in any picture of any building.
  double sure = 0.8;
  int least_agreed = 5;
  std::size_t looks = 10;
};

// Where along a route a robot is, or that it is off it: a discrete Bayes filter (a histogram
// filter; Thrun et al., Probabilistic Robotics, ch. 4; over the views of a route as in hidden
// Markov models of place recognition) over all of the route, moved by odometry or by a broad prior,
// weighed by the key views that are recognised. No vision, no clock, no DDS. The route's units are
// metres, or whatever it was measured in where it was taught without odometry.
class RouteBelief {
 public:
  explicit RouteBelief(const RouteBeliefOptions& options = {})
      : options_(options), witnesses_(1, Witness(options.cell)) {}

  // The route grows at its end: by so much, with key views at these places from the new part's
  // beginning, in rising order.
  void Extend(double length, std::span<const ViewPlace> views);
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] std::size_t views() const { return views_.size(); }
  [[nodiscard]] double view_at(std::size_t view) const { return views_[view].at; }

  // Once something of the route is known.
  void StartAt(double along, double sigma);
  void StartAnywhere();

  // Of a run that goes on: what the one before knew of the magnification, as its logarithm.
  void KnowMagnification(double log_magnification);

  // How the robot moved, by each of those who can tell: the same ones, in the same order, at each
  // call. Where they differ, what is recognised decides between them.
  void Move(std::span<const Motion> told);
  void Move(const Motion& told) { Move({&told, 1}); }
  // Something else than the views says that this witness is wrong: such a share of its mass goes to
  // the others, if there are any.
  void Contradict(std::size_t witness, double share);
  // `independent`: how much of a new look it is, 0 to 1: a robot that stands sees the same again.
  void Weigh(std::span<const ComparedView> compared, double independent,
             const std::optional<TrackedPlace>& tracked = std::nullopt);

  struct Place {
    double along = 0.0;
    double sigma = 0.0;      // within the window
    double here = 0.0;       // probability of the window around it
    double off_route = 0.0;  // probability
    int agreed = 0;          // median over the last looks of the most that agreed there
    bool held = false;       // sure of it
    double come = 0.0;       // along the route while held, since it last jumped
  };
  [[nodiscard]] const Place& place() const { return place_; }
  // How likely it is that this one of Move's witnesses tells how the robot moves, against the
  // likeliest of them: 1 for that one, and for all that agree with it. And how far the robot comes
  // for each unit that this one tells.
  [[nodiscard]] double Trust(std::size_t witness) const;
  [[nodiscard]] double ScaleOf(std::size_t witness) const { return witnesses_[witness].scale(); }
  // How much larger this camera shows things than the scout's, as a natural logarithm: the median
  // of what was seen at held places; nothing before.
  [[nodiscard]] std::optional<double> log_magnification() const { return log_magnification_; }

  // The likeliest places, each more than `apart` from the others, at most so many; none of which
  // the window has less than this probability.
  [[nodiscard]] std::vector<double> Likeliest(std::size_t most, double least, double apart) const;

  // The views before and after a place, at most so many that are its own in all, in order.
  [[nodiscard]] std::vector<std::size_t> Around(double along, std::size_t most) const;
  // Which views to compare next, at most so many: those about the held place, then the others by
  // turns.
  [[nodiscard]] std::vector<std::size_t> WorthComparing(std::size_t near, std::size_t others);

 private:
  struct Neighbours;
  [[nodiscard]] std::size_t cells() const { return witnesses_.front().grid().cells().size(); }
  [[nodiscard]] double each() const { return static_cast<double>(witnesses_.size()); }
  [[nodiscard]] double Alike(int agreed, int best) const;
  [[nodiscard]] double SizeFits(const ComparedView& view, double growth) const;
  [[nodiscard]] Neighbours NeighboursOf(std::size_t view) const;
  void WeighCellsAbout(const ComparedView& view, int best, double independent, MovedGrid& grid);
  void WeighCellsAbout(const TrackedPlace& tracked, int best, double independent, MovedGrid& grid);
  [[nodiscard]] CellGrid Together() const;
  void Hear(std::size_t witnesses);
  void SwitchWitnesses(double independent);
  void Leave(double independent);
  void Normalise();
  struct Window;
  [[nodiscard]] Window WindowAbout(double middle) const;
  void Locate();
  void NoteGrowth(std::span<const ComparedView> compared);
  void NoteLook(std::span<const ComparedView> compared, double independent,
                const std::optional<TrackedPlace>& tracked);
  void NoteWay(bool was_held);
  void NoteMagnification(const ComparedView& nearest, double independent);

  RouteBeliefOptions options_;
  std::vector<ViewPlace> views_;  // from the route's beginning, rising
  double length_ = 0.0;
  std::vector<Witness> witnesses_;  // at least one; their masses and off_ add up to 1
  double off_ = 1.0;
  std::optional<double> start_;  // where it was said to be, until it is held somewhere
  Place place_;
  std::deque<int> agreed_;  // at the likeliest place, of the last looks
  // At held places: the logarithm of the magnification, and how much of a new look it was.
  std::deque<std::pair<double, double>> magnifications_;
  std::optional<double> log_magnification_;
  double held_along_ = 0.0;
  // What was recognised well in the last look, and by how much of its logarithm the magnification
  // of a view has grown from look to look, lately: it falls when a robot drives backwards.
  std::vector<ComparedView> well_recognised_;
  double growth_ = 0.0;
  std::size_t turn_ = 0;
};

}  // namespace trailcast::belief
