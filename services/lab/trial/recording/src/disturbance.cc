#include "services/lab/trial/recording/disturbance.h"

#include <algorithm>
#include <array>

#include "services/lab/trial/recording/src/named_changes.h"

namespace trailcast::trial {
namespace {

using Known = NamedChange<ChangeKind>;

constexpr std::array kKnown{
    Known{ChangeKind::kEvery, "every", 3, 2, 1000,
          "every so many frames only: a robot that is so much faster", true},
    Known{ChangeKind::kSlower, "slower", 3, 2, 1000,
          "each frame so many times: a robot that is so much slower", true},
    Known{ChangeKind::kReverse, "reverse", 0, 0, 0, "from the last frame to the first", true},
    Known{ChangeKind::kSkip, "skip", 50, 1, 1e6, "leaves so many frames out, at up to three places",
          true},
    Known{ChangeKind::kJump, "jump", 3, 1, 100, "goes on elsewhere in the recording, so many times",
          true},
    Known{ChangeKind::kFrom, "from", 0.5, 0, 0.95,
          "begins so far into the recording: a robot that is set down on the way"},
    Known{ChangeKind::kCamera, "camera", 1.3, 0.25, 4,
          "another camera: so much more magnification, 1.25 times the pixels, barrel, gamma 0.7"},
    Known{ChangeKind::kGamma, "gamma", 0.5, 0.1, 10,
          "grey levels to this power: below 1 brightens"},
    Known{ChangeKind::kNoise, "noise", 12, 0, 255, "noise of so many grey levels"},
    Known{ChangeKind::kJpeg, "jpeg", 30, 1, 100, "stored as JPEG of this quality", true},
    Known{ChangeKind::kSmear, "smear", 0.2, 0.01, 1,
          "a smear on the lens, its radius so much of the picture's width"},
    Known{ChangeKind::kCrop, "crop", 0.15, 0.01, 0.8,
          "a mount that was moved: without so much of the left and lower side"},
    Known{ChangeKind::kBlur, "blur", 0.03, 0.001, 0.3,
          "motion blur, in each picture of another length up to so much of its width"},
    Known{ChangeKind::kFlare, "flare", 0.7, 0.05, 1,
          "a low sun that wanders through the picture, with veiling light of so much of white, a "
          "burnt-out disc, streaks, ghosts and a shorter exposure"},
};

bool Has(const Disturbance& disturbance, ChangeKind kind) {
  return std::any_of(disturbance.begin(), disturbance.end(),
                     [kind](const Change& change) { return change.kind == kind; });
}

}  // namespace

Result<Disturbance> ParseDisturbance(const std::string& text) {
  return ParseNamedChanges<Change>(text, kKnown, "disturbance");
}

std::string ChangeHelp() { return HelpOf(kKnown); }

int StrideOf(const Disturbance& disturbance) {
  int stride = 1;
  for (const Change& change : disturbance) {
    if (change.kind == ChangeKind::kEvery) stride *= static_cast<int>(change.value);
  }
  return stride;
}

bool KeepsSides(const Disturbance& disturbance) { return !Has(disturbance, ChangeKind::kCrop); }

bool KeepsSteering(const Disturbance& disturbance) {
  return !Has(disturbance, ChangeKind::kReverse);
}

}  // namespace trailcast::trial
