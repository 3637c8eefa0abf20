#include "services/belief/route_belief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace trailcast::belief {
namespace {

constexpr double kSamePlace = 1e-3;  // of key views no further apart the robot turned on the spot
constexpr double kGrows = 0.01;  // from station to station: less does not tell how far a view is
constexpr std::size_t kMagnificationsKept = 60;
constexpr double kFewestMagnifications = 3.0;  // sum of the independence of looks
constexpr double kSureMagnification = 5.0;     // the same, to tell how far away a view is
constexpr double kKnownMagnification = 10.0;   // the same, of what an earlier run found

constexpr double kGrowthLearns = 0.15;  // for each look
constexpr double kShrinks = -0.003;     // for each look: below it the robot drives backwards

// Returns the value with half of the weight below it.
double WeightedMedian(const std::deque<std::pair<double, double>>& values_and_weights) {
  std::vector<std::pair<double, double>> sorted(values_and_weights.begin(),
                                                values_and_weights.end());
  std::sort(sorted.begin(), sorted.end());
  double left = 0.0;
  for (const auto& [value, weight] : sorted) left += 0.5 * weight;
  for (const auto& [value, weight] : sorted) {
    left -= weight;
    if (left <= 0.0) return value;
  }
  return sorted.back().first;
}

int Median(const std::deque<int>& values) {
  std::vector<int> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace

void RouteBelief::Extend(double length, std::span<const ViewPlace> views) {
  for (const ViewPlace& view : views) {
    const double at = length_ + view.at;
    views_.push_back({at, view.growth, view.own});
    if (stations_.empty() || at - stations_.back().at >= kSamePlace) {
      stations_.push_back({at, view.growth});
    }
    station_of_.push_back(stations_.size() - 1);
  }
  length_ += length;
  const auto cells = static_cast<std::size_t>(std::floor(length_ / options_.cell)) + 1;
  for (Witness& witness : witnesses_) {
    CellGrid& grid = witness.grid().cells();
    grid.Grow(cells - grid.size());
  }
}

void RouteBelief::StartAt(double along, double sigma) {
  if (cells() == 0) return;
  constexpr double kReach = 5.0;  // standard deviations
  const double width = std::max(sigma, 0.5 * options_.cell);
  for (Witness& witness : witnesses_) {
    MovedGrid& grid = witness.grid();
    grid.cells().Reset(0.0);
    const std::size_t last = grid.CellOf(along + kReach * width);
    for (std::size_t i = grid.CellOf(along - kReach * width); i <= last; ++i) {
      const double off = (grid.PlaceOf(i) - along) / width;
      grid.cells().Set(i, std::exp(-0.5 * off * off));
    }
    grid.cells().Scale((1.0 - options_.starts_off) / (grid.cells().Sum() * each()));
  }
  off_ = options_.starts_off;
  start_ = along;
  Locate();
}

void RouteBelief::StartAnywhere() {
  if (cells() == 0) return;
  constexpr double kOn = 0.1;
  for (Witness& witness : witnesses_) witness.grid().cells().Reset(kOn / each());
  off_ = 1.0 - kOn;
  start_.reset();
  Locate();
}

void RouteBelief::KnowMagnification(double log_magnification) {
  magnifications_.assign(1, {log_magnification, kKnownMagnification});
  log_magnification_ = log_magnification;
  magnification_is_sure_ = true;
}

// Returns the mass of all witnesses together.
CellGrid RouteBelief::Together() const {
  CellGrid all = witnesses_.front().grid().cells();
  for (std::size_t i = 1; i < witnesses_.size(); ++i) {
    all.Add(witnesses_[i].grid().cells(), 1.0);
  }
  return all;
}

// Sets the number of witnesses. The mass belongs to all of them alike, since it holds whichever of
// them is right.
void RouteBelief::Hear(std::size_t witnesses) {
  if (witnesses_.size() == witnesses) return;
  Witness one(options_.cell);
  one.grid() = witnesses_.front().grid();
  one.grid().cells() = Together();
  one.grid().cells().Scale(1.0 / static_cast<double>(witnesses));
  witnesses_.assign(witnesses, one);
}

void RouteBelief::Move(std::span<const Motion> told) {
  if (cells() == 0) return;
  Hear(told.size());
  is_sensed_ =
      std::any_of(told.begin(), told.end(), [](const Motion& each) { return each.sensed; });
  for (std::size_t i = 0; i < told.size(); ++i) witnesses_[i].Move(told[i], options_.diffusion);
  // A guessed motion tells less of the place than the next look does.
  if (std::any_of(told.begin(), told.end(), [](const Motion& each) { return !each.guessed; })) {
    Locate();
  }
}

void RouteBelief::Contradict(std::size_t witness, double share) {
  if (witnesses_.size() == 1) return;
  const CellGrid wrong = witnesses_[witness].grid().cells();
  for (std::size_t i = 0; i < witnesses_.size(); ++i) {
    CellGrid& cells = witnesses_[i].grid().cells();
    if (i == witness) {
      cells.Scale(1.0 - share);
    } else {
      cells.Add(wrong, share / (each() - 1.0));
    }
  }
}

double RouteBelief::Trust(std::size_t witness) const {
  double most = 0.0;
  for (const Witness& each : witnesses_) most = std::max(most, each.grid().cells().Sum());
  return most > 0.0 ? witnesses_[witness].grid().cells().Sum() / most : 1.0;
}

// Shifts mass between witnesses, since another one may be the better by now.
void RouteBelief::SwitchWitnesses(double independent) {
  if (witnesses_.size() == 1) return;
  const double changes = options_.witness_changes * independent;
  const CellGrid all = Together();
  for (Witness& witness : witnesses_) {
    witness.grid().cells().Scale(1.0 - changes);
    witness.grid().cells().Add(all, changes / each());
  }
}

// Equation (5).
RouteBelief::Counted RouteBelief::Count(const ComparedView& view) const {
  const double features = std::max(options_.features, static_cast<double>(view.features));
  const double each = std::pow(options_.features / features, options_.chance_grows);
  return {view.view, static_cast<int>(std::lround(each * view.agreed)), view.log_scale};
}

// Returns the log-likelihood ratio of that many agreeing features: equation (6).
double RouteBelief::Alike(int agreed, int best) const {
  const double ratio =
      std::clamp(options_.gain * (agreed - options_.neutral), options_.least, options_.most);
  const double behind = options_.behind_best * (agreed - std::max<double>(best, options_.neutral));
  return ratio + std::max(options_.behind_best_least, behind);
}

// Returns the log-likelihood ratio of their size. The scout would have seen them larger by `growth`
// than in the view itself.
double RouteBelief::SizeFits(const Counted& view, double growth) const {
  const double off = (view.log_scale - *log_magnification_ - growth) / options_.log_scale_sigma;
  return std::max(options_.log_scale_least, -0.5 * off * off);
}

double RouteBelief::AmongStations(double along) const {
  const auto after =
      std::upper_bound(stations_.begin(), stations_.end(), along,
                       [](double place, const Station& station) { return place < station.at; });
  const auto next = static_cast<std::size_t>(std::distance(stations_.begin(), after));
  if (next == 0) return 0.0;
  const auto before = static_cast<double>(next - 1);
  if (next == stations_.size()) return before;
  const double from = stations_[next - 1].at;
  return before + (along - from) / (stations_[next].at - from);
}

std::optional<double> RouteBelief::Growth(double from, double to) const {
  if (from > to) {
    const auto back = Growth(to, from);
    return back ? std::optional(-*back) : std::nullopt;
  }
  double grown = 0.0;
  for (auto before = static_cast<std::size_t>(from); static_cast<double>(before) < to; ++before) {
    const auto here = static_cast<double>(before);
    const double share = std::min(to, here + 1.0) - std::max(from, here);
    const std::optional<double>& growth = stations_[before + 1].growth;
    if (!growth) return std::nullopt;
    grown += share * *growth;
  }
  return grown;
}

double RouteBelief::SeenFrom(std::size_t station, double larger) const {
  const bool back = larger < 0.0;
  double left = std::abs(larger);
  std::size_t here = station;
  while (left > 0.0 && (back ? here > 0 : here + 1 < stations_.size())) {
    const std::optional<double>& growth = stations_[back ? here : here + 1].growth;
    if (!growth || *growth < kGrows) break;
    if (left < *growth) return static_cast<double>(here) + (back ? -left : left) / *growth;
    left -= *growth;
    here = back ? here - 1 : here + 1;
  }
  return static_cast<double>(here);
}

// A view counts most where its size says that it is seen from, and not at all a station further:
// equation (7).
void RouteBelief::WeighCellsAbout(const Counted& view, int best, double independent,
                                  MovedGrid& grid) {
  const std::size_t station = station_of_[view.view];
  const auto own = static_cast<double>(station);
  const bool tells_distance = is_sensed_ && magnification_is_sure_ &&
                              std::abs(*log_magnification_) >= options_.other_lens &&
                              view.agreed >= options_.agreed_for_distance;
  const double centre =
      tells_distance ? SeenFrom(station, view.log_scale - *log_magnification_) : own;
  const bool sized = log_magnification_ && view.agreed >= options_.agreed_for_scale;
  const double alike = Alike(view.agreed, best);
  const auto at = [&](double place) { return stations_[static_cast<std::size_t>(place)].at; };
  const auto last_station = static_cast<double>(stations_.size() - 1);
  const std::size_t first = centre < 1.0 ? 0 : grid.CellOf(at(std::floor(centre - 1.0)));
  const std::size_t last =
      centre > last_station - 1.0 ? cells() - 1 : grid.CellOf(at(std::ceil(centre + 1.0)));
  std::vector<double> factors(last - first + 1, 1.0);
  for (std::size_t i = first; i <= last; ++i) {
    const double along = grid.PlaceOf(i);
    const double place = AmongStations(along);
    // Nobody has seen how things grow before the first view and after the last one.
    const bool between = along >= stations_.front().at && along < stations_.back().at;
    const double share = std::max(0.0, 1.0 - std::abs(place - centre));
    const std::optional<double> growth = sized && between ? Growth(own, place) : std::nullopt;
    const double ratio = growth ? alike + SizeFits(view, *growth) : alike;
    factors[i - first] = std::exp(independent * share * ratio);
  }
  grid.cells().Multiply(first, factors);
}

// The weight falls with the distance, as between two views.
void RouteBelief::WeighCellsAbout(const TrackedPlace& tracked, int best, double independent,
                                  MovedGrid& grid) {
  const double ratio = Alike(tracked.agreed, best);
  const std::size_t first = grid.CellOf(tracked.along - options_.window);
  const std::size_t last = grid.CellOf(tracked.along + options_.window);
  std::vector<double> factors(last - first + 1, 1.0);
  for (std::size_t i = first; i <= last; ++i) {
    const double off = std::abs(grid.PlaceOf(i) - tracked.along) / options_.window;
    factors[i - first] = std::exp(independent * std::max(0.0, 1.0 - off) * ratio);
  }
  grid.cells().Multiply(first, factors);
}

void RouteBelief::Weigh(std::span<const ComparedView> compared, double independent,
                        const std::optional<TrackedPlace>& tracked) {
  if (cells() == 0 || compared.empty()) return;
  Leave(independent);
  SwitchWitnesses(independent);
  std::vector<Counted> ordered;
  ordered.reserve(compared.size());
  int best = tracked ? tracked->agreed : 0;
  for (const ComparedView& view : compared) {
    ordered.push_back(Count(view));
    best = std::max(best, ordered.back().agreed);
  }
  std::sort(ordered.begin(), ordered.end(),
            [](const auto& a, const auto& b) { return a.view < b.view; });
  // The best recognised one counts of those that share a place.
  for (auto view = ordered.begin(); view != ordered.end();) {
    const double at = views_[view->view].at;
    const auto end = std::find_if(view, ordered.end(), [&](const Counted& other) {
      return views_[other.view].at - at >= kSamePlace;
    });
    const Counted& likest = *std::max_element(
        view, end, [](const auto& a, const auto& b) { return a.agreed < b.agreed; });
    for (Witness& each : witnesses_) WeighCellsAbout(likest, best, independent, each.grid());
    view = end;
  }
  for (Witness& each : witnesses_) {
    if (tracked) WeighCellsAbout(*tracked, best, independent, each.grid());
  }
  Normalise();
  Locate();
  NoteLook(ordered, independent, tracked);
}

void RouteBelief::Leave(double independent) {
  const double leaves = options_.leaves * independent;
  const double returns = options_.returns * independent;
  const double returned = off_ * returns / each();
  const double evenly = start_ ? options_.starts_elsewhere : 1.0;
  for (Witness& witness : witnesses_) {
    MovedGrid& grid = witness.grid();
    grid.cells().Scale(1.0 - leaves);
    grid.cells().AddEvenly(evenly * returned);
    if (!start_) continue;
    const std::size_t first = grid.CellOf(*start_ - options_.window);
    const std::size_t last = grid.CellOf(*start_ + options_.window);
    const double each_cell = (1.0 - evenly) * returned / static_cast<double>(last - first + 1);
    for (std::size_t i = first; i <= last; ++i) {
      grid.cells().Set(i, grid.cells().at(i) + each_cell);
    }
  }
  off_ += leaves * (1.0 - off_) - returns * off_;
}

void RouteBelief::Normalise() {
  constexpr double kNegligible = 1e-6;
  double sum = off_;
  for (const Witness& witness : witnesses_) sum += witness.grid().cells().Sum();
  for (Witness& witness : witnesses_) {
    witness.grid().cells().Scale(1.0 / sum);
    witness.grid().cells().Forget(kNegligible);
  }
  off_ /= sum;
}

// This is the mass around a place, with its first two moments.
struct RouteBelief::Window {
  double middle = 0.0;
  double mass = 0.0;
  double first = 0.0;
  double second = 0.0;
};

RouteBelief::Window RouteBelief::WindowAbout(double middle) const {
  Window window{middle};
  for (const Witness& witness : witnesses_) {
    const MovedGrid& grid = witness.grid();
    const std::size_t last = grid.CellOf(middle + options_.window);
    for (std::size_t i = grid.CellOf(middle - options_.window); i <= last; ++i) {
      const double off = grid.PlaceOf(i) - middle;
      const double mass = grid.cells().at(i);
      window.mass += mass;
      window.first += mass * off;
      window.second += mass * off * off;
    }
  }
  return window;
}

void RouteBelief::Locate() {
  Window likeliest;
  for (const Witness& witness : witnesses_) {
    const MovedGrid& grid = witness.grid();
    const Window window = WindowAbout(grid.PlaceOf(grid.cells().Peak()));
    if (window.mass > likeliest.mass) likeliest = window;
  }
  place_.here = likeliest.mass;
  place_.off_route = off_;
  if (likeliest.mass <= 0.0) return;
  const double mean = likeliest.first / likeliest.mass;
  place_.along = std::clamp(likeliest.middle + mean, 0.0, length_);
  place_.sigma = std::sqrt(std::max(0.0, likeliest.second / likeliest.mass - mean * mean));
}

std::vector<double> RouteBelief::Likeliest(std::size_t most, double least, double apart) const {
  std::vector<double> places;
  const CellGrid all = Together();
  std::vector<double> left(all.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = all.at(i);
  while (places.size() < most && !left.empty()) {
    const auto peak = std::max_element(left.begin(), left.end());
    const auto at = static_cast<std::size_t>(peak - left.begin());
    const auto within = [&](double reach) {
      const auto cells = static_cast<std::size_t>(reach / options_.cell);
      return std::pair(peak - static_cast<std::ptrdiff_t>(std::min(at, cells)),
                       peak + static_cast<std::ptrdiff_t>(std::min(left.size() - at, cells + 1)));
    };
    const auto [first, end] = within(options_.window);
    if (*peak <= 0.0 || std::accumulate(first, end, 0.0) < least) break;
    places.push_back(std::clamp(witnesses_.front().grid().PlaceOf(at), 0.0, length_));
    const auto [cleared, cleared_end] = within(std::max(apart, options_.window));
    std::fill(cleared, cleared_end, 0.0);
  }
  return places;
}

void RouteBelief::NoteGrowth(std::span<const Counted> counted) {
  std::vector<Counted> well;
  double grown = 0.0;
  int count = 0;
  for (const Counted& view : counted) {
    if (view.agreed < options_.agreed_for_scale) continue;
    well.push_back(view);
    for (const Counted& before : well_recognised_) {
      if (before.view != view.view) continue;
      grown += view.log_scale - before.log_scale;
      ++count;
    }
  }
  if (count > 0) growth_ += kGrowthLearns * (grown / count - growth_);
  well_recognised_ = std::move(well);
}

void RouteBelief::NoteLook(std::span<const Counted> counted, double independent,
                           const std::optional<TrackedPlace>& tracked) {
  NoteGrowth(counted);
  const Counted* nearest = nullptr;
  for (const Counted& view : counted) {
    if (std::abs(views_[view.view].at - place_.along) > options_.window) continue;
    if (nearest == nullptr || view.agreed > nearest->agreed) nearest = &view;
  }
  if (nearest == nullptr) return;
  const bool is_tracked = tracked && std::abs(tracked->along - place_.along) <= options_.window;
  agreed_.push_back(is_tracked ? std::max(nearest->agreed, tracked->agreed) : nearest->agreed);
  if (agreed_.size() > options_.looks) agreed_.pop_front();
  place_.agreed = Median(agreed_);
  const bool was_held = place_.held;
  place_.held = place_.here >= options_.sure && place_.agreed >= options_.least_agreed;
  if (place_.held) start_.reset();
  NoteWay(was_held);
  if (place_.held && nearest->agreed >= options_.agreed_for_scale) {
    NoteMagnification(*nearest, independent);
  }
}

void RouteBelief::NoteWay(bool was_held) {
  const double come = place_.along - std::exchange(held_along_, place_.along);
  const bool jumped = std::abs(come) >= options_.window;
  const bool goes_on = place_.held && was_held && !jumped;
  if (jumped) place_.come = 0.0;
  if (goes_on) place_.come += come;
  for (std::size_t i = 0; i < witnesses_.size(); ++i) {
    if (goes_on) {
      witnesses_[i].NoteWay(come, growth_ < kShrinks, Trust(i));
    } else {
      witnesses_[i].NoteGap(place_.held);
    }
  }
}

// This part of the nearest view's magnification comes from where the view was taught.
void RouteBelief::NoteMagnification(const Counted& nearest, double independent) {
  const auto own = static_cast<double>(station_of_[nearest.view]);
  const double place = std::clamp(AmongStations(place_.along), own - 1.0, own + 1.0);
  const double grown = Growth(own, place).value_or(0.0);
  magnifications_.emplace_back(nearest.log_scale - grown, independent);
  if (magnifications_.size() > kMagnificationsKept) magnifications_.pop_front();
  double independent_looks = 0.0;
  for (const auto& [magnification, weight] : magnifications_) independent_looks += weight;
  if (independent_looks >= kFewestMagnifications) {
    log_magnification_ = WeightedMedian(magnifications_);
  }
  magnification_is_sure_ = magnification_is_sure_ || independent_looks >= kSureMagnification;
}

std::vector<std::size_t> RouteBelief::Around(double along, std::size_t most) const {
  const auto before = [](const ViewPlace& view, double place) { return view.at < place; };
  const auto next = static_cast<std::size_t>(
      std::distance(views_.begin(), std::lower_bound(views_.begin(), views_.end(), along, before)));
  std::size_t first = next;
  for (std::size_t own = 0; first > 0 && own < most / 2;) own += views_[--first].own ? 1 : 0;
  std::size_t after = first;
  for (std::size_t own = 0; after < views_.size() && (own < most || !views_[after].own); ++after) {
    own += views_[after].own ? 1 : 0;
  }
  std::vector<std::size_t> around(after - first);
  std::iota(around.begin(), around.end(), first);
  return around;
}

std::vector<std::size_t> RouteBelief::WorthComparing(std::size_t near, std::size_t others) {
  std::vector<std::size_t> worth = Around(place_.along, near);
  const std::size_t first = worth.empty() ? 0 : worth.front();
  const std::size_t rest = views_.size() - worth.size();
  for (std::size_t i = 0; i < std::min(others, rest); ++i) {
    const std::size_t turn = turn_++ % rest;
    worth.push_back(turn < first ? turn : turn + (views_.size() - rest));
  }
  return worth;
}

}  // namespace trailcast::belief
