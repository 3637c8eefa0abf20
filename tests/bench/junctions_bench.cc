// Junctions of each route of some stores with all the others, found among a hundred thousand
// segments from elsewhere: how long it takes, and whether it finds what comparing every two routes
// does.
//
//   bench_junctions SEGMENTS ELSEWHERE STORE...
//
// ELSEWHERE is a store of routes in other places, of whose views those segments are made.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "services/base/cpu_time.h"
#include "services/junctions/find_junctions.h"
#include "services/junctions/near_routes.h"
#include "services/program/command_line.h"
#include "tests/bench/must.h"
#include "tests/bench/taught_routes.h"
#include "tests/bench/view_corpus.h"

namespace trailcast::bench {
namespace {

constexpr std::uint32_t kSegmentsARoute = 30;
constexpr int kWidth_px = 320;

junctions::RouteViews Tabulate(const std::vector<route::Segment>& segments, int width_px) {
  junctions::RouteViews views(width_px);
  for (const route::Segment& segment : segments) views.Add(segment);
  return views;
}

class Bench {
 public:
  Bench(std::vector<Taught> routes, const std::vector<Taught>& elsewhere, std::uint32_t distractors)
      : routes_(std::move(routes)), apart_(ViewsApart(elsewhere)) {
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      const Taught& route = routes_[i];
      numbers_[route.info.key] = i;
      segments_.push_back(route.Segments());
      for (const route::Segment& segment : segments_.back()) Add(route.info.key, segment);
      views_.push_back(Tabulate(segments_.back(), route.info.image_width_px));
    }
    for (std::uint32_t i = 0; i < distractors; ++i) {
      route::Segment segment = Distractor(apart_, i);
      segment.index = SegmentIndex(i % kSegmentsARoute);
      Add(KeyOfDistractors(i / kSegmentsARoute), segment);
    }
  }

  void Run() {
    double near_ms = 0.0, compared_ms = 0.0, longest_ms = 0.0;
    std::size_t near_routes = 0, found = 0, strange = 0, there = 0;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      const double began_ms = ThreadCpuMs();
      const auto near = junctions::NearRoutes(index_, routes_[i].info.key.route, segments_[i]);
      const double took_ms = ThreadCpuMs() - began_ms;
      double compare_ms = 0.0;
      for (const junctions::NearRoute& each : near) {
        const junctions::RouteViews views = ViewsOf(each.key);
        const double compares_ms = ThreadCpuMs();
        const bool joined =
            !junctions::FindJunctions(views_[i], views, SameCamera(i, each.key)).empty();
        compare_ms += ThreadCpuMs() - compares_ms;
        (numbers_.contains(each.key) ? found : strange) += joined ? 1 : 0;
      }
      near_routes += near.size();
      near_ms += took_ms;
      compared_ms += compare_ms;
      longest_ms = std::max(longest_ms, took_ms + compare_ms);
      for (std::size_t j = 0; j < routes_.size(); ++j) {
        const bool same = SameCamera(i, routes_[j].info.key);
        if (j != i && !junctions::FindJunctions(views_[i], views_[j], same).empty()) ++there;
      }
    }
    const auto routes = static_cast<double>(routes_.size());
    fmt::print("{} routes against {} segments ({:.0f} MB)\n", routes_.size(), index_.size(),
               static_cast<double>(index_.bytes()) / 1e6);
    fmt::print(
        "a route: {:.0f} ms for {:.1f} routes near it, {:.1f} ms to compare them; the "
        "longest {:.0f} ms\n",
        near_ms / routes, static_cast<double>(near_routes) / routes, compared_ms / routes,
        longest_ms);
    fmt::print("a route and a thousand segments: {:.2f} ms\n",
               1e3 * (near_ms + compared_ms) / routes / static_cast<double>(index_.size()));
    fmt::print(
        "joined routes: {} of the {} that comparing every two finds; {} with routes from "
        "elsewhere\n",
        found, there, strange);
  }

 private:
  static route::RouteKey KeyOfDistractors(std::uint32_t number) {
    return {RouteId(fmt::format("{:032x}", number)), TeachingId(1)};
  }
  void Add(const route::RouteKey& key, const route::Segment& segment) {
    if (index_.Add(key, segment)) return;
    std::cerr << "the index is full\n";
    std::abort();
  }

  [[nodiscard]] bool SameCamera(std::size_t i, const route::RouteKey& key) const {
    const auto known = numbers_.find(key);
    return known != numbers_.end() && routes_[known->second].info.camera == routes_[i].info.camera;
  }
  [[nodiscard]] junctions::RouteViews ViewsOf(const route::RouteKey& key) const {
    const auto known = numbers_.find(key);
    if (known != numbers_.end()) return views_[known->second];
    const auto number = static_cast<std::uint32_t>(std::stoul(key.route.value(), nullptr, 16));
    std::vector<route::Segment> segments;
    for (std::uint32_t k = 0; k < kSegmentsARoute; ++k) {
      segments.push_back(Distractor(apart_, number * kSegmentsARoute + k));
    }
    return Tabulate(segments, kWidth_px);
  }

  std::vector<Taught> routes_;
  std::vector<std::vector<route::Segment>> segments_;  // of these
  std::vector<route::Segment> apart_;
  view::ViewIndex index_;
  std::map<route::RouteKey, std::size_t> numbers_;
  std::vector<junctions::RouteViews> views_;
};

int Run(std::uint32_t distractors, const std::string& elsewhere,
        const std::vector<std::string>& files) {
  std::vector<Taught> routes;
  for (const std::string& file : files) {
    for (Taught& route : TaughtIn(file)) routes.push_back(std::move(route));
  }
  Bench(std::move(routes), TaughtIn(elsewhere), distractors).Run();
  return 0;
}

}  // namespace
}  // namespace trailcast::bench

int main(int argc, char** argv) {
  return trailcast::program::RunMain("bench_junctions", [&] {
    if (argc < 4) {
      std::cerr << "usage: bench_junctions SEGMENTS ELSEWHERE STORE...\n";
      return trailcast::program::kExitUsage;
    }
    return trailcast::bench::Run(static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)),
                                 argv[2], {argv + 3, argv + argc});
  });
}
