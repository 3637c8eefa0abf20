#include "agent/session/src/place/recogniser.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::agent {

const Look::Recognised* Look::Best() const {
  const auto best =
      std::max_element(views.begin(), views.end(), [](const Recognised& a, const Recognised& b) {
        return a.comparison.likeness < b.comparison.likeness;
      });
  return best == views.end() ? nullptr : &*best;
}

std::vector<std::optional<double>> Recogniser::Learn(std::span<const route::KeyView> views) {
  constexpr int kEnough = 8;
  std::vector<std::optional<double>> growths;
  growths.reserve(views.size());
  for (const route::KeyView& view : views) {
    keys_.push_back(view::Tabulate(view.features, scout_width_px_));
    std::optional<double>& growth = growths.emplace_back();
    if (view.missed) continue;
    const auto before = std::exchange(last_own_, keys_.size() - 1);
    if (!before) continue;
    const view::Comparison comparison = view::Compare(keys_[*before], keys_.back());
    if (comparison.agreed() >= kEnough) growth = std::log(comparison.scale);
  }
  return growths;
}

Look Recogniser::LookAt(const image::GrayImage& picture, int width_px,
                        std::span<const std::size_t> views) {
  return Compare(view::Tabulate(describer_.Describe(picture), picture.width), width_px, views);
}

Look Recogniser::Glance(const image::GrayImage& picture, std::span<const std::size_t> views) const {
  vision::ViewDescriber describer;
  return Compare(view::Tabulate(describer.Describe(picture), picture.width), picture.width, views);
}

Look Recogniser::Compare(view::ViewTable seen, int width_px,
                         std::span<const std::size_t> views) const {
  Look look;
  look.width_px = width_px;
  look.seen = std::move(seen);
  look.views.reserve(views.size());
  for (const std::size_t key : views) {
    look.views.push_back({key, view::Compare(keys_[key], look.seen)});
  }
  return look;
}

std::vector<belief::ComparedView> Recogniser::Compared(const Look& look) const {
  std::vector<belief::ComparedView> compared;
  compared.reserve(look.views.size());
  for (const Look::Recognised& each : look.views) {
    compared.push_back({each.view, each.comparison.agreed(), std::log(each.comparison.scale),
                        static_cast<int>(keys_[each.view].size())});
  }
  return compared;
}

vision::ViewFit Recogniser::FitOf(const Look& look, const view::Comparison& comparison) const {
  const double half_width_px = 0.5 * look.width_px;
  return {comparison.scale * look.width_px / scout_width_px_, half_width_px * comparison.shift_u,
          half_width_px * comparison.shift_v};
}

}  // namespace trailcast::agent
