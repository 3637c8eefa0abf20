#include "services/lab/trial/teachings.h"

#include <algorithm>

#include "services/lab/sim/core/random.h"

namespace trailcast::trial {

TrialSeeds SeedsOf(const TrialOptions& options, int trial) {
  const std::uint64_t seed = SeedOf(options, trial);
  return {sim::Random(seed, "scout").Bits(), sim::Random(seed, "follower").Bits()};
}

Teachings::Teachings(const TrialSetup& setup, const TrialOptions& options)
    : setup_(setup), options_(options) {
  for (const TrialCase& each : setup.cases) {
    if (CutOf(each.method) == cuts_.size()) cuts_.push_back(each.method);
  }
}

std::size_t Teachings::CutOf(agent::ReplayMethod method) const {
  const auto found = std::find_if(cuts_.begin(), cuts_.end(), [&](agent::ReplayMethod each) {
    return agent::AsPrinted(each) == agent::AsPrinted(method);
  });
  return static_cast<std::size_t>(found - cuts_.begin());
}

const TaughtRoute& Teachings::RouteFor(agent::ReplayMethod method, const Taught& taught) const {
  return taught.routes[CutOf(method)];
}

Result<std::shared_ptr<const Taught>> Teachings::Get(const TrialCase& trial_case, int trial,
                                                     const TrialProgress& on_progress) {
  Drive* drive = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    drive = &drives_[{trial_case.scout_camera.name, trial}];
  }
  std::call_once(drive->once, [&] {
    std::vector<agent::TeachOptions> teachings;
    teachings.reserve(cuts_.size());
    for (const agent::ReplayMethod method : cuts_) {
      teachings.push_back(TeachingFor(method));
      teachings.back().intake.roll_deg = setup_.scout_roll_deg;
    }
    auto taught = TeachOnce(setup_, trial_case.scout_camera, teachings,
                            SeedsOf(options_, trial).scout, on_progress);
    if (taught) {
      drive->taught = std::make_shared<const Taught>(std::move(*taught));
    } else {
      drive->taught = tl::unexpected(taught.error());
    }
  });
  return drive->taught;
}

}  // namespace trailcast::trial
