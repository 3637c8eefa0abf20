#include "agent/diagnosis/seen_features.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "agent/diagnosis/src/protobuf_reader.h"
#include "agent/diagnosis/src/verdict_color.h"

namespace trailcast::agent {
namespace {

using replay::FeatureVerdict;
using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kMostFeatures = 1000;

struct Point {
  double x = NAN;
  double y = NAN;
};

Point ReadPoint(Bytes message) {
  ProtobufReader reader(message);
  Point point;
  while (const auto field = reader.Next()) {
    if (field->number == 1) point.x = field->real;
    if (field->number == 2) point.y = field->real;
  }
  return point;
}

// Returns the verdict whose colour is the most similar.
FeatureVerdict ReadVerdict(Bytes message) {
  std::array<double, 3> seen{};
  ProtobufReader reader(message);
  while (const auto field = reader.Next()) {
    if (field->number >= 1 && field->number <= seen.size()) seen[field->number - 1] = field->real;
  }
  const auto unlike = [&](FeatureVerdict verdict) {
    const image::Color color = VerdictColor(verdict);
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) sum += std::abs(seen[i] - color[i] / 255.0);
    return sum;
  };
  FeatureVerdict best = FeatureVerdict::kInside;
  for (const auto verdict :
       {FeatureVerdict::kAsksRight, FeatureVerdict::kAsksLeft, FeatureVerdict::kRejected}) {
    if (unlike(verdict) < unlike(best)) best = verdict;
  }
  return best;
}

SeenFeature ReadDisc(Bytes message) {
  SeenFeature feature;
  Point at;
  ProtobufReader reader(message);
  while (const auto field = reader.Next()) {
    if (field->number == 2) at = ReadPoint(field->bytes);
    if (field->number == 5) feature.verdict = ReadVerdict(field->bytes);
  }
  feature.u_px = at.x;
  feature.v_px = at.y;
  return feature;
}

std::vector<Point> ReadLines(Bytes message) {
  std::vector<Point> points;
  ProtobufReader reader(message);
  while (const auto field = reader.Next()) {
    if (field->number == 3 && points.size() < 2 * kMostFeatures) {
      points.push_back(ReadPoint(field->bytes));
    }
  }
  return points;
}

}  // namespace

std::vector<SeenFeature> ReadFeatures(Bytes message) {
  std::vector<SeenFeature> features;
  std::vector<Point> ends;
  ProtobufReader reader(message);
  while (const auto field = reader.Next()) {
    if (field->number == 1 && features.size() < kMostFeatures) {
      features.push_back(ReadDisc(field->bytes));
    }
    if (field->number == 2) ends = ReadLines(field->bytes);
  }
  features.resize(std::min(features.size(), ends.size() / 2));
  for (std::size_t i = 0; i < features.size(); ++i) {
    features[i].to_u_px = ends[2 * i + 1].x;
    features[i].to_v_px = ends[2 * i + 1].y;
  }
  std::erase_if(features, [](const SeenFeature& each) {
    return !std::isfinite(each.u_px + each.v_px + each.to_u_px + each.to_v_px);
  });
  return features;
}

}  // namespace trailcast::agent
