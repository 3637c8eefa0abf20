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

// This is where a key view is along the route.
struct ViewPlace {
  double at = 0.0;  // from the beginning of the part that it comes with, in the route's units
  // This is the natural logarithm of how much larger things are in it than in the view before, to
  // the scout's camera. It is empty if the two have too little in common.
  std::optional<double> growth;
  bool own = true;  // false if it shows how the place of the view before it looked later
};

// This is a stored view that was compared with the camera's picture.
struct ComparedView {
  std::size_t view = 0;  // position among the route's key views
  int agreed = 0;        // features that look alike and that one magnification maps to their places
  double log_scale = 0.0;  // natural logarithm of that magnification, if there are enough of them
  int features = 40;       // so many it has, any of which might have agreed
};

// This is other evidence of a place: so many tracked features lie where odometry and the taught
// geometry predict them.
struct TrackedPlace {
  double along = 0.0;
  int agreed = 0;
};

struct RouteBeliefOptions {
  double cell = 0.1;    // length of the grid's cells, in the route's units
  double window = 1.0;  // to either side of the likeliest place: all of it counts as one place
  // All numbers of agreeing features below are of a view with so many features. The more it has,
  // the more of them agree by chance: their number grows with this power.
  double features = 40.0;
  double chance_grows = 0.7;
  // The log-likelihood ratio of being at a view, against being off the route, depends on how many
  // features agree. It rises by `gain` a feature from zero at `neutral`, within bounds: a view that
  // nothing agrees with does not prove that the robot is elsewhere, since a person may stand before
  // the camera, and a view that all agree with is no proof either.
  double gain = 1.0;
  double neutral = 4.5;
  double least = -1.2;
  double most = 6.0;
  // It also falls by this for each feature that the best view of the look has more. Without that,
  // replays at other speeds than the taught one fail.
  double behind_best = 0.2;
  double behind_best_least = -3.0;
  // Things appear as large as this camera has shown them so far, scaled as the scout saw them grow
  // between one view and the next.
  double log_scale_sigma = 0.05;
  double log_scale_least = -2.0;
  int agreed_for_scale = 12;
  // With so many, the size says from how far away the view is seen.
  int agreed_for_distance = 8;
  // A camera whose magnification differs by less recognises best what is near, and the size of what
  // it sees is left to tell of wheels that slip.
  double other_lens = 0.25;
  // These are the chances of leaving the route, and of coming upon it again somewhere, for each
  // independent look.
  double leaves = 0.003;
  double returns = 0.002;
  double starts_off = 0.1;         // chance that a robot is not at its stated place
  double starts_elsewhere = 0.01;  // chance that it then comes upon the route elsewhere
  // This is the chance that another witness of the robot's motion becomes the better one, for each
  // independent look.
  double witness_changes = 0.02;
  double diffusion = 0.02;  // of the place, per root unit along, beside the motion's own sigma
  // Off the route there is no place. So a place is held only if `here` of the mass is about it and
  // so many features agree there, in the median of the last looks. A handful agree in any picture
  // of any building.
  double sure = 0.8;
  int least_agreed = 5;
  std::size_t looks = 10;
};

// This estimates where along a route a robot is, or that it is off it. It is a discrete Bayes
// filter over the whole route (a histogram filter; Thrun et al., Probabilistic Robotics, ch. 4;
// over the views of a route as in hidden Markov models of place recognition). Odometry or a broad
// prior moves it, and the key views that are recognised weigh it. It uses no vision, no clock and
// no DDS. The route's units are metres, or those in which a route without odometry was measured.
class RouteBelief {
 public:
  explicit RouteBelief(const RouteBeliefOptions& options = {})
      : options_(options), witnesses_(1, Witness(options.cell)) {}

  // Extends the route at its end by `length`, with key views at these places from the new part's
  // beginning, in rising order.
  void Extend(double length, std::span<const ViewPlace> views);
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] std::size_t views() const { return views_.size(); }
  [[nodiscard]] double view_at(std::size_t view) const { return views_[view].at; }

  // This needs some of the route to be known.
  void StartAt(double along, double sigma);
  void StartAnywhere();

  // Takes over the magnification that an earlier run found, as its logarithm.
  void KnowMagnification(double log_magnification);

  // Moves the belief by what each witness tells of the robot's motion. Each call has the same
  // witnesses in the same order. Where they differ, recognised views decide between them.
  void Move(std::span<const Motion> told);
  void Move(const Motion& told) { Move({&told, 1}); }
  // Takes this share of a witness's mass and gives it to the others, if there are any, since
  // evidence other than the views contradicts it.
  void Contradict(std::size_t witness, double share);
  // `independent` says how much of a new look it is, 0 to 1: a robot that stands sees the same
  // again.
  void Weigh(std::span<const ComparedView> compared, double independent,
             const std::optional<TrackedPlace>& tracked = std::nullopt);

  struct Place {
    double along = 0.0;
    double sigma = 0.0;      // standard deviation within the window
    double here = 0.0;       // probability of the window around it
    double off_route = 0.0;  // probability
    int agreed = 0;          // median over the last looks of the most features that agreed there
    bool held = false;       // the robot is sure of the place
    double come = 0.0;       // distance along the route while held, since the last jump
  };
  [[nodiscard]] const Place& place() const { return place_; }
  // Trust returns how likely it is that this witness is right about the motion, relative to the
  // likeliest: 1 for that one and for all that agree with it. The scale is how far the robot comes
  // for each unit that this witness tells.
  [[nodiscard]] double Trust(std::size_t witness) const;
  [[nodiscard]] double ScaleOf(std::size_t witness) const { return witnesses_[witness].scale(); }
  // Returns the natural logarithm of how much larger this camera shows things than the scout's, as
  // the median over held places, or nothing before the first.
  [[nodiscard]] std::optional<double> log_magnification() const { return log_magnification_; }

  // Returns at most `most` of the likeliest places, more than `apart` from each other, each with at
  // least this probability in its window.
  [[nodiscard]] std::vector<double> Likeliest(std::size_t most, double least, double apart) const;

  // Returns the views before and after a place in order, at most `most` of them its own.
  [[nodiscard]] std::vector<std::size_t> Around(double along, std::size_t most) const;
  // Returns the views to compare next, `near` of them around the held place and `others` of the
  // remaining ones, which take turns.
  [[nodiscard]] std::vector<std::size_t> WorthComparing(std::size_t near, std::size_t others);

 private:
  // This is a view with its agreeing features as of one with so many features as options_ has them.
  struct Counted {
    std::size_t view = 0;
    int agreed = 0;
    double log_scale = 0.0;
  };
  [[nodiscard]] Counted Count(const ComparedView& view) const;
  // This is a place of key views. Views of a turn on the spot share theirs. Places between stations
  // are told by fractions: halfway from the third to the fourth is 2.5.
  struct Station {
    double at = 0.0;
    std::optional<double> growth;  // as in the first ViewPlace of it
  };
  [[nodiscard]] double AmongStations(double along) const;
  // Returns how much larger things are at one place than at another, as a logarithm, or nothing
  // where that is not known.
  [[nodiscard]] std::optional<double> Growth(double from, double to) const;
  // Returns from where a view is seen in which things are so much larger than in itself, as a
  // logarithm. It ends where they do not grow along the route.
  [[nodiscard]] double SeenFrom(std::size_t station, double larger) const;
  [[nodiscard]] std::size_t cells() const { return witnesses_.front().grid().cells().size(); }
  [[nodiscard]] double each() const { return static_cast<double>(witnesses_.size()); }
  [[nodiscard]] double Alike(int agreed, int best) const;
  [[nodiscard]] double SizeFits(const Counted& view, double growth) const;
  void WeighCellsAbout(const Counted& view, int best, double independent, MovedGrid& grid);
  void WeighCellsAbout(const TrackedPlace& tracked, int best, double independent, MovedGrid& grid);
  [[nodiscard]] CellGrid Together() const;
  void Hear(std::size_t witnesses);
  void SwitchWitnesses(double independent);
  void Leave(double independent);
  void Normalise();
  struct Window;
  [[nodiscard]] Window WindowAbout(double middle) const;
  void Locate();
  void NoteGrowth(std::span<const Counted> counted);
  void NoteLook(std::span<const Counted> counted, double independent,
                const std::optional<TrackedPlace>& tracked);
  void NoteWay(bool was_held);
  void NoteMagnification(const Counted& nearest, double independent);

  RouteBeliefOptions options_;
  std::vector<Station> stations_;        // rising
  std::vector<std::size_t> station_of_;  // each view's
  std::vector<ViewPlace> views_;         // rising, from the route's beginning
  double length_ = 0.0;
  std::vector<Witness> witnesses_;  // at least one; their masses and off_ add up to 1
  double off_ = 1.0;
  std::optional<double> start_;  // its stated place, until it is held somewhere
  Place place_;
  std::deque<int> agreed_;  // at the likeliest place, in the last looks
  // For held places, this has the logarithm of the magnification, and how much of a new look it
  // was.
  std::deque<std::pair<double, double>> magnifications_;
  std::optional<double> log_magnification_;
  // Without odometry the same views tell place and magnification, and one would pull the other
  // along.
  bool is_sensed_ = false;
  bool magnification_is_sure_ = false;  // enough to tell how far away a view is
  double held_along_ = 0.0;
  // These are the views that were recognised well in the last look, and how much the logarithm of a
  // view's magnification has lately grown from look to look: it falls when a robot drives
  // backwards.
  std::vector<Counted> well_recognised_;
  double growth_ = 0.0;
  std::size_t turn_ = 0;
};

}  // namespace trailcast::belief
