#include "services/view/any_camera.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "services/view/key_views.h"
#include "services/view/src/likest.h"
#include "services/view/src/spanned_width.h"

namespace trailcast::view {
namespace {

// These limit the magnifications that are tried, as natural logarithms. An omnidirectional mirror
// shows things a fifth as large as a webcam does, and a narrow lens, seen by a wide one, three
// times as large.
constexpr double kLeastLogScale = -1.6;
constexpr double kMostLogScale = 1.1;
constexpr double kStep = 0.2;
// The size of a feature, and the magnification of a pair of features, may be off by these.
constexpr double kSizeBand = 0.25;
constexpr double kScaleBand = 0.22;
constexpr int kMostBits = 72;
constexpr double kRatio = 0.9;  // best to second best that is elsewhere
// These are in half widths of the key view's picture, as it is magnified. kLeastTolerance limits
// that, as in a picture in which all is small a pixel is a large error.
constexpr double kElsewhere = 0.03;
constexpr double kAgreeU = 0.10;
constexpr double kAgreeV = 0.04;
constexpr double kLeastTolerance = 0.3;
constexpr double kShortestBase = 0.2;
constexpr std::size_t kFewestPairs = 4;
// One view in a hundred of other worlds is so similar to any of 100 000 segments. Fewer
// magnifications have fewer chances, so less is enough for cameras much like the scout's, which are
// also the likely ones.
constexpr double kEnoughLikeness = 5.5;
constexpr double kEnoughOfLikeCameras = 4.5;
constexpr double kLeastLogScaleOfLike = -0.5;
constexpr double kMostLogScaleOfLike = 0.2;

// Features seen again differ in some forty bits, and the most similar of many unrelated ones in
// some seventy.
double Weight(int bits) { return std::min(1.0, (76.0 - bits) / 40.0); }

struct Pair : Comparison::Pair {
  int bits = 0;
};

class Magnified {
 public:
  Magnified(const ViewTable& key, const ViewTable& seen) : key_(key), seen_(seen) {
    // A second best with more bits than this does not refute a best that is similar enough.
    const int most = static_cast<int>(kMostBits / kRatio);
    alike_.resize(key.size());
    for (std::size_t i = 0; i < key.size(); ++i) {
      for (std::size_t j = 0; j < seen.size(); ++j) {
        const int bits = Hamming(key.bits[i], seen.bits[j]);
        if (bits <= most) alike_[i].push_back({j, bits});
      }
    }
    taken_.resize(seen.size(), kFree);
  }

  [[nodiscard]] ViewMatch Best() {
    ViewMatch best;
    for (double log_scale = kLeastLogScale; log_scale <= kMostLogScale; log_scale += kStep) {
      FindPairs(log_scale);
      if (pairs_.size() < kFewestPairs) continue;
      ViewMatch match;
      Improve(match, std::exp(log_scale));
      const bool like = log_scale >= kLeastLogScaleOfLike && log_scale <= kMostLogScaleOfLike;
      const double enough = like ? kEnoughOfLikeCameras : kEnoughLikeness;
      if (match.likeness >= std::max(enough, best.likeness)) best = match;
    }
    return best;
  }

 private:
  static constexpr std::size_t kFree = ~std::size_t{0};

  void FindPairs(double log_scale) {
    for (const Pair& pair : pairs_) taken_[pair.seen] = kFree;
    pairs_.clear();
    const double elsewhere = kElsewhere * std::exp(log_scale);
    for (std::size_t i = 0; i < key_.size(); ++i) {
      const auto nearest = MostAlike(i, key_.log_size[i] + log_scale, elsewhere);
      if (!nearest) continue;
      const Pair pair{{i, nearest->seen}, nearest->bits};
      std::size_t& taken = taken_[pair.seen];
      if (taken == kFree) {
        taken = pairs_.size();
        pairs_.push_back(pair);
      } else if (pair.bits < pairs_[taken].bits) {
        pairs_[taken] = pair;
      }
    }
  }

  // Returns the most similar of those seen features that are about this large.
  [[nodiscard]] std::optional<Likest::Nearest> MostAlike(std::size_t key, double log_size,
                                                         double elsewhere) const {
    Likest likest(seen_, elsewhere);
    for (const Likest::Nearest& alike : alike_[key]) {
      if (std::abs(seen_.log_size[alike.seen] - log_size) > kSizeBand) continue;
      likest.Offer(alike.seen, alike.bits);
    }
    return likest.Found(kMostBits, kRatio);
  }

  // Tries the fits of all two pairs.
  void Improve(ViewMatch& best, double about_scale) const {
    const double tolerance = std::max(about_scale, kLeastTolerance);
    for (std::size_t a = 1; a < pairs_.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const auto fit = FitTwo(key_, seen_, pairs_[a], pairs_[b], kShortestBase);
        if (!fit || std::abs(fit->scale / about_scale - 1.0) > kScaleBand) continue;
        const ViewMatch found = Agreed(*fit, tolerance);
        if (found.likeness > best.likeness) best = found;
      }
    }
  }

  [[nodiscard]] ViewMatch Agreed(const Fit& fit, double tolerance) const {
    ViewMatch match;
    for (const Pair& pair : pairs_) {
      const double off_u = seen_.u[pair.seen] - fit.scale * key_.u[pair.key] - fit.shift_u;
      const double off_v = seen_.v[pair.seen] - fit.scale * key_.v[pair.key] - fit.shift_v;
      const double off = std::max(std::abs(off_u) / kAgreeU, std::abs(off_v) / kAgreeV) / tolerance;
      if (off >= 1.0) continue;
      ++match.agreed;
      match.likeness += (1.0 - off * off) * Weight(pair.bits);
    }
    return match;
  }

  const ViewTable& key_;
  const ViewTable& seen_;
  std::vector<std::vector<Likest::Nearest>> alike_;  // by key feature
  std::vector<Pair> pairs_;
  std::vector<std::size_t> taken_;  // by seen feature: its pair
};

bool AllSized(std::span<const route::ViewFeature> view) {
  return std::all_of(view.begin(), view.end(),
                     [](const route::ViewFeature& feature) { return feature.size_px > 0.0F; });
}

}  // namespace

AnyCameraView::AnyCameraView(std::span<const route::ViewFeature> view)
    : sized_(AllSized(view)), table_(Tabulate(view, SpannedWidth_px(view))) {}

ViewMatch AnyCameraView::MatchWith(const route::Segment& segment) const {
  ViewMatch best;
  for (const route::KeyView& key : KeyViewsOf(segment)) {
    const ViewTable table = Tabulate(key.features, SpannedWidth_px(key.features));
    ViewMatch match;
    if (sized_ && AllSized(key.features)) {
      match = Magnified(table, table_).Best();
    } else {
      const Comparison comparison = Compare(table, table_);
      match = {comparison.agreed(), comparison.likeness};
    }
    if (match.likeness > best.likeness) best = match;
  }
  return best;
}

}  // namespace trailcast::view
