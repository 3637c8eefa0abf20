#include "services/lab/trial/recording/disturbance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "services/base/number.h"

namespace trailcast::trial {
namespace {

struct Known {
  ChangeKind kind;
  const char* name;
  double value;  // where none is given
  double least;
  double most;
  bool whole;
  const char* help;
};

constexpr std::array kKnown{
    Known{ChangeKind::kEvery, "every", 3, 2, 1000, true,
          "every so many frames only: a robot that is so much faster"},
    Known{ChangeKind::kSlower, "slower", 3, 2, 1000, true,
          "each frame so many times: a robot that is so much slower"},
    Known{ChangeKind::kReverse, "reverse", 0, 0, 0, true, "from the last frame to the first"},
    Known{ChangeKind::kSkip, "skip", 50, 1, 1e6, true,
          "leaves so many frames out, at up to three places"},
    Known{ChangeKind::kJump, "jump", 3, 1, 100, true,
          "goes on elsewhere in the recording, so many times"},
    Known{ChangeKind::kFrom, "from", 0.5, 0, 0.95, false,
          "begins so far into the recording: a robot that is set down on the way"},
    Known{ChangeKind::kCamera, "camera", 1.3, 0.25, 4, false,
          "another camera: so much more magnification, 1.25 times the pixels, barrel, gamma 0.7"},
    Known{ChangeKind::kGamma, "gamma", 0.5, 0.1, 10, false,
          "grey levels to this power: below 1 brightens"},
    Known{ChangeKind::kNoise, "noise", 12, 0, 255, false, "noise of so many grey levels"},
    Known{ChangeKind::kJpeg, "jpeg", 30, 1, 100, true, "stored as JPEG of this quality"},
    Known{ChangeKind::kSmear, "smear", 0.2, 0.01, 1, false,
          "a smear on the lens, its radius so much of the picture's width"},
    Known{ChangeKind::kCrop, "crop", 0.15, 0.01, 0.8, false,
          "a mount that was moved: without so much of the left and lower side"},
};

std::string Names() {
  std::string names;
  for (const Known& known : kKnown) names += (names.empty() ? "" : ", ") + std::string(known.name);
  return names;
}

Result<Change> ParseChange(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  const auto known = std::find_if(kKnown.begin(), kKnown.end(),
                                  [&](const Known& each) { return each.name == name; });
  if (known == kKnown.end()) {
    return Fail(ErrorCode::kInvalidArgument, "there is no disturbance '{}'; there are: {}", name,
                Names());
  }
  Change change{known->kind, known->value};
  if (equals == std::string_view::npos) return change;
  const std::string_view value = text.substr(equals + 1);
  const auto number = ParseNumber<double>(value);
  const bool whole = number && (!known->whole || *number == std::floor(*number));
  if (!whole || !(*number >= known->least && *number <= known->most)) {
    return Fail(ErrorCode::kInvalidArgument,
                "the disturbance '{}' takes a {}number from {} to {}, not '{}'", name,
                known->whole ? "whole " : "", known->least, known->most, value);
  }
  change.value = *number;
  return change;
}

bool Has(const Disturbance& disturbance, ChangeKind kind) {
  return std::any_of(disturbance.begin(), disturbance.end(),
                     [kind](const Change& change) { return change.kind == kind; });
}

}  // namespace

Result<Disturbance> ParseDisturbance(const std::string& text) {
  Disturbance disturbance;
  if (text.empty() || text == "none") return disturbance;
  for (std::size_t from = 0;;) {
    const std::size_t plus = text.find('+', from);
    const auto change = ParseChange(std::string_view(text).substr(from, plus - from));
    if (!change) return tl::unexpected(change.error());
    disturbance.push_back(*change);
    if (plus == std::string::npos) return disturbance;
    from = plus + 1;
  }
}

std::string ChangeHelp() {
  std::string help;
  for (const Known& known : kKnown) {
    const std::string usage = known.most > 0.0 ? fmt::format("{}={:g}", known.name, known.value)
                                               : std::string(known.name);
    help += fmt::format("  {:<11} {}\n", usage, known.help);
  }
  return help;
}

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
