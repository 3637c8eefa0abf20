// The catalog asked by view, over a hundred thousand stored segments: is the right one found first,
// is nothing found of other worlds, and how long does it take.
//
//   bench_view [segments [folder of recorded runs]]

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "services/base/cpu_time.h"
#include "services/catalog/view_catalog.h"
#include "services/program/command_line.h"
#include "services/route/digest.h"
#include "tests/bench/view_corpus.h"
#include "tests/support/places.h"
#include "tests/support/temp_dir.h"

namespace trailcast::bench {
namespace {

constexpr std::uint32_t kSegmentsARoute = 30;
constexpr std::size_t kSlice = 100;  // as the server fills

template <typename Value>
void Check(const Result<Value>& result) {
  if (result) return;
  std::cerr << result.error().message << '\n';
  std::abort();
}

double Share(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(values.size() - 1) * share);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

route::RouteKey KeyOf(std::uint32_t number) {
  return {RouteId(fmt::format("{:032x}", number)), TeachingId(1)};
}

void Put(store::RouteStore& store, std::uint32_t number, const std::string& name,
         const std::vector<route::Segment>& segments) {
  route::RouteInfo info;
  info.key = KeyOf(number);
  info.name = name;
  info.scout = AgentId("bench");
  info.segment_count = static_cast<std::uint32_t>(segments.size());
  std::vector<route::SegmentPiece> pieces;
  pieces.reserve(segments.size());
  for (const route::Segment& segment : segments) {
    pieces.push_back(route::MakePiece(info.key, segment));
  }
  Check(store.AppendSegments(pieces));
  Check(store.PutRoute(info));
}

void PutDistractors(store::RouteStore& store, const Corpus& corpus, std::uint32_t count) {
  const auto first_route = static_cast<std::uint32_t>(corpus.walks.size());
  std::vector<route::Segment> segments;
  for (std::uint32_t i = 0; i < count; ++i) {
    segments.push_back(Distractor(corpus.elsewhere, i));
    segments.back().index = SegmentIndex(i % kSegmentsARoute);
    if (segments.size() < kSegmentsARoute && i + 1 < count) continue;
    Put(store, first_route + i / kSegmentsARoute, "elsewhere", segments);
    segments.clear();
  }
}

// The segment itself, one that borders it, or one no further than half a metre along the path; the
// laps begin where they end.
bool IsRight(const Walk& walk, const HeldView& held, const route::FoundPlace& found) {
  constexpr double kNear_m = 0.5;
  if (found.key != KeyOf(held.walk)) return false;
  const std::size_t from = std::min(found.segment, held.segment).value();
  const std::size_t to = std::max(found.segment, held.segment).value();
  if (to - from <= 1 || (walk.is_lap && from == 0 && to + 1 >= walk.segments.size())) return true;
  if (!walk.segments.front().has_odometry) return false;
  double between_m = 0.0;
  for (std::size_t i = from + 1; i < to; ++i) between_m += walk.segments[i].length_m;
  return between_m <= kNear_m;
}

struct Tally {
  int asked = 0;
  int found = 0;
  int right = 0;
};

class Bench {
 public:
  Bench(const Corpus& corpus, store::RouteStore& store) : corpus_(corpus), views_(store) {}

  void Fill() {
    const double began_ms = ThreadCpuMs();
    double longest_ms = 0.0;
    while (!views_.Filled()) {
      const double slice_ms = ThreadCpuMs();
      Check(views_.Fill(kSlice));
      longest_ms = std::max(longest_ms, ThreadCpuMs() - slice_ms);
    }
    const double took_s = (ThreadCpuMs() - began_ms) / 1e3;
    const auto& index = views_.index();
    fmt::print(
        "filled: {} segments in {:.1f} s, {:.0f} a second; the longest slice of {}: {:.0f} ms\n",
        index.size(), took_s, static_cast<double>(index.size()) / took_s, kSlice, longest_ms);
    fmt::print("memory: {:.1f} MB, {:.0f} bytes a segment\n",
               static_cast<double>(index.bytes()) / 1e6,
               static_cast<double>(index.bytes()) / static_cast<double>(index.size()));
  }

  void AskHeld() {
    for (const HeldView& held : corpus_.held) {
      Tally& tally = held_[held.set];
      const auto reply = Ask(held.view);
      ++tally.asked;
      if (reply.places.empty()) continue;
      ++tally.found;
      if (IsRight(corpus_.walks[held.walk], held, reply.places.front())) ++tally.right;
    }
    Print("held views", held_);
  }

  void AskStrangers() {
    for (const HeldView& stranger : corpus_.strangers) AskStranger(stranger.set, stranger.view);
    for (std::uint32_t walk = 0; walk < corpus_.walks.size(); ++walk) {
      if (corpus_.walks[walk].segments.front().has_odometry) continue;
      views_.Forget(KeyOf(walk));
    }
    for (const HeldView& held : corpus_.held) {
      const Walk& walk = corpus_.walks[held.walk];
      if (!walk.segments.front().has_odometry) AskStranger(walk.name + ", forgotten", held.view);
    }
    Print("views of other worlds", strange_);
  }

  void PrintTimes() const {
    fmt::print("a query: processor {:.1f} ms (p99 {:.1f}), wall {:.1f} ms (p99 {:.1f}), of {}\n",
               Share(processor_ms_, 0.5), Share(processor_ms_, 0.99), Share(wall_ms_, 0.5),
               Share(wall_ms_, 0.99), wall_ms_.size());
  }

 private:
  exchange::CatalogReply Ask(const route::View& view) {
    const auto began = std::chrono::steady_clock::now();
    const double began_ms = ThreadCpuMs();
    auto reply = views_.Answer({AgentId("bench"), 1, {.view = view}}, AgentId("server"));
    processor_ms_.push_back(ThreadCpuMs() - began_ms);
    wall_ms_.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began)
            .count());
    if (!reply.error.empty()) {
      std::cerr << reply.error << '\n';
      std::abort();
    }
    return reply;
  }

  void AskStranger(const std::string& set, const route::View& view) {
    Tally& tally = strange_[set];
    ++tally.asked;
    if (!Ask(view).places.empty()) ++tally.found;
  }

  static void Print(const char* title, const std::map<std::string, Tally>& sets) {
    const auto percent = [](int part, int of) { return 100.0 * part / std::max(1, of); };
    fmt::print("{:<32} {:>6} {:>8} {:>8}\n", title, "asked", "found %", "right %");
    for (const auto& [name, tally] : sets) {
      fmt::print("{:<32} {:>6} {:>8.1f} {:>8.1f}\n", name, tally.asked,
                 percent(tally.found, tally.asked), percent(tally.right, tally.asked));
    }
  }

  const Corpus& corpus_;
  catalog::ViewCatalog views_;
  std::map<std::string, Tally> held_;
  std::map<std::string, Tally> strange_;
  std::vector<double> processor_ms_;
  std::vector<double> wall_ms_;
};

int Run(std::uint32_t segments, const std::filesystem::path& data) {
  const Corpus corpus = MakeCorpus(data);
  const test::TempDir dir;
  auto store = store::OpenSqliteStore(dir / "routes.db");
  Check(store);
  for (std::uint32_t walk = 0; walk < corpus.walks.size(); ++walk) {
    Put(**store, walk, corpus.walks[walk].name, corpus.walks[walk].segments);
  }
  std::cerr << "storing " << segments << " segments from elsewhere\n";
  PutDistractors(**store, corpus, segments);
  Bench bench(corpus, **store);
  bench.Fill();
  bench.AskHeld();
  bench.AskStrangers();
  bench.PrintTimes();
  return 0;
}

}  // namespace
}  // namespace trailcast::bench

int main(int argc, char** argv) {
  return trailcast::program::RunMain("bench_view", [&] {
    const auto segments = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100'000UL;
    const std::filesystem::path data =
        argc > 2 ? argv[2]
                 : std::filesystem::path(trailcast::SourceDir()) / ".." / "shared" / "data";
    return trailcast::bench::Run(static_cast<std::uint32_t>(segments), data);
  });
}
