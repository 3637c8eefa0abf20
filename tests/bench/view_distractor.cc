#include <algorithm>
#include <utility>

#include "services/lab/sim/core/random.h"
#include "tests/bench/view_corpus.h"

namespace trailcast::bench {

route::Segment Distractor(const std::vector<route::Segment>& elsewhere, std::uint32_t number) {
  constexpr int kFlippedBits = 12;
  sim::Random random(number, "distractor");
  const auto pick = [&](std::size_t size) {
    return static_cast<std::size_t>(random.Integer(0, static_cast<int>(size) - 1));
  };
  route::Segment segment = elsewhere[pick(elsewhere.size())];
  // It has as many features as taught segments: half of them have 11 to 20, the others up to 56.
  const auto wanted = static_cast<std::size_t>(random.Uniform() < 0.5 ? random.Integer(11, 20)
                                                                      : random.Integer(21, 56));
  route::View& features = segment.key_views.front().features;
  features.clear();
  const int groups = random.Integer(2, 3);
  for (int group = 0; group < groups; ++group) {
    const route::View& from = elsewhere[pick(elsewhere.size())].key_views.front().features;
    const auto scale = static_cast<float>(random.Uniform(0.8, 1.25));
    const auto du_px = static_cast<float>(random.Uniform(-60.0, 60.0));
    for (std::size_t i = 0; i < wanted / static_cast<std::size_t>(groups); ++i) {
      route::ViewFeature feature = from[pick(from.size())];
      for (int bit = 0; bit < kFlippedBits; ++bit) {
        feature.descriptor[pick(feature.descriptor.size())] ^=
            static_cast<std::uint8_t>(1U << random.Integer(0, 7));
      }
      feature.u_px = scale * feature.u_px + du_px;
      feature.v_px *= scale;
      features.push_back(feature);
    }
  }
  return segment;
}

}  // namespace trailcast::bench
