#include "agent/diagnosis/src/verdict_color.h"

namespace trailcast::agent {

using replay::FeatureVerdict;

image::Color VerdictColor(FeatureVerdict verdict) {
  switch (verdict) {
    case FeatureVerdict::kInside:
      return {0, 200, 120};
    case FeatureVerdict::kAsksRight:
      return {255, 150, 0};
    case FeatureVerdict::kAsksLeft:
      return {70, 170, 255};
    case FeatureVerdict::kRejected:
      break;
  }
  return {230, 40, 40};
}

}  // namespace trailcast::agent
