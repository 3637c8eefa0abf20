// A server that looks for junctions beside its work: how soon those of a new route are found among
// many segments, and for how long at once it does nothing else.
//
//   bench_junction_search SEGMENTS ELSEWHERE STORE FILE
//
// STORE's routes are taught to a server whose store FILE, made if it is not there, has SEGMENTS of
// ELSEWHERE's views, some kilobytes each.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "route_server/junctions/junction_finder.h"
#include "services/base/cpu_time.h"
#include "services/program/command_line.h"
#include "services/route/digest.h"
#include "services/store/route_store.h"
#include "tests/bench/must.h"
#include "tests/bench/taught_routes.h"
#include "tests/bench/view_corpus.h"

namespace trailcast::bench {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::uint32_t kSegmentsARoute = 30;

double MsSince(steady_clock::time_point then) {
  return std::chrono::duration<double, std::milli>(steady_clock::now() - then).count();
}

// Complete routes that robots follow.
void FillStore(const fs::path& file, const std::vector<route::Segment>& apart,
               std::uint32_t segments) {
  const auto store = Must(
      store::OpenSqliteStore(file, {.durability = store::SqliteOptions::Durability::kWithRoutes}));
  for (std::uint32_t at = 0; at < segments; at += kSegmentsARoute) {
    const route::RouteKey key{RouteId(fmt::format("{:032x}", at)), TeachingId(1)};
    std::vector<route::SegmentPiece> pieces;
    std::vector<route::Digest> digests;
    route::RouteInfo info{.key = key,
                          .name = fmt::format("elsewhere-{}", at),
                          .revision = RevisionNumber(1),
                          .scout = AgentId("nobody"),
                          .camera = "webcam 320x240",
                          .image_width_px = 320,
                          .image_height_px = 240,
                          .taught_unix_ms = 1'000 + at,
                          .state = route::RouteState::kComplete,
                          .segment_count = kSegmentsARoute,
                          .length_m = 1.0 * kSegmentsARoute};
    info.standing = route::Standing::kActive;
    for (std::uint32_t i = 0; i < kSegmentsARoute; ++i) {
      route::Segment segment = Distractor(apart, at + i);
      segment.index = SegmentIndex(i);
      pieces.push_back(route::MakePiece(key, segment));
      digests.push_back(pieces.back().digest);
      info.bytes += pieces.back().bytes.size();
    }
    info.manifest_digest = route::ManifestDigest(digests);
    if (!store->AppendSegments(pieces) || !store->PutRoute(info)) std::abort();
  }
}

struct Turns {
  std::vector<double> took_ms;  // of processor time
  void Print(const char* what) {
    std::sort(took_ms.begin(), took_ms.end());
    double sum_ms = 0.0;
    for (const double each : took_ms) sum_ms += each;
    fmt::print("{}: {} turns, {:.2f} ms each, p99 {:.1f} ms, the longest {:.1f} ms\n", what,
               took_ms.size(), sum_ms / static_cast<double>(took_ms.size()),
               took_ms[took_ms.size() * 99 / 100], took_ms.back());
  }
};

class Bench {
 public:
  Bench(store::RouteStore& store, std::vector<Taught> routes)
      : store_(store),
        views_(store, {.most_bytes = 1'000'000'000}),
        desk_(store, views_, [this](const auto& key) { return !new_.contains(key); }),
        routes_(std::move(routes)) {
    while (!views_.Filled()) {
      if (!views_.Fill(1'000)) std::abort();
    }
    fmt::print("{} segments are indexed\n", views_.index().size());
  }

  // One after the other: told of crossings while it is taught, then looked for.
  void Run() {
    for (const Taught& route : routes_) {
      Teach(route);
      const auto began = steady_clock::now();
      const double cpu_ms = ThreadCpuMs();
      std::size_t meetings = 0;
      std::vector<route::RouteKey> searched;
      while (searched.empty()) {
        Turn(searches_);
        meetings += desk_.TakeMeetings().size();
        searched = desk_.TakeSearched();
      }
      fmt::print("{}: {} segments, {} meetings found in {:.0f} ms, {:.0f} of the server's thread\n",
                 route.info.name, route.pieces.size(), meetings, MsSince(began),
                 ThreadCpuMs() - cpu_ms);
    }
    searches_.Print("searching");
    crossing_.Print("looking at segments as they come");
  }

 private:
  void Teach(const Taught& route) {
    route::RouteInfo info = route.info;
    info.state = route::RouteState::kTeaching;
    info.standing = route::Standing::kStaged;
    Put(info);
    std::size_t crossings = 0;
    double longest_ms = 0.0;
    for (const route::SegmentPiece& piece : route.pieces) {
      if (!store_.AppendSegments({&piece, 1}) || !views_.Add(piece)) std::abort();
      const auto stored = steady_clock::now();
      desk_.NoteStored(piece.key, piece.index);
      do {
        Turn(crossing_);
      } while (desk_.due());
      longest_ms = std::max(longest_ms, MsSince(stored));
      crossings += desk_.TakeCrossings().size();
    }
    fmt::print("{}: {} crossings while it was taught, {:.0f} ms after a segment at most\n",
               info.name, crossings, longest_ms);
    info.state = route::RouteState::kComplete;
    info.standing = route::Standing::kActive;
    Put(info);
    new_.insert(info.key);
    desk_.Note(info);
  }
  void Put(const route::RouteInfo& info) {
    if (const auto put = store_.PutRoute(info); !put) {
      std::cerr << put.error().message << '\n';
      std::abort();
    }
  }
  void Turn(Turns& turns) {
    if (const auto due = desk_.due()) std::this_thread::sleep_until(*due);
    const double began_ms = ThreadCpuMs();
    if (const auto turned = desk_.Turn(steady_clock::now()); !turned) {
      std::cerr << turned.error().message << '\n';
      std::abort();
    }
    turns.took_ms.push_back(ThreadCpuMs() - began_ms);
    if (!desk_.due()) std::this_thread::sleep_for(milliseconds(1));
  }

  store::RouteStore& store_;
  catalog::ViewCatalog views_;
  std::set<route::RouteKey> new_;
  server::JunctionFinder desk_;
  std::vector<Taught> routes_;
  Turns searches_;
  Turns crossing_;
};

int Run(const std::vector<std::string>& words) {
  if (words.size() != 4) {
    std::cerr << "usage: bench_junction_search SEGMENTS ELSEWHERE STORE FILE\n";
    return program::kExitUsage;
  }
  const fs::path file = words[3];
  if (!fs::exists(file)) {
    FillStore(file, ViewsApart(TaughtIn(words[1])),
              static_cast<std::uint32_t>(std::stoul(words[0])));
  }
  const auto store = Must(store::OpenSqliteStore(file));
  Bench(*store, TaughtIn(words[2])).Run();
  return program::kExitOk;
}

}  // namespace
}  // namespace trailcast::bench

int main(int argc, char** argv) {
  return trailcast::program::RunMain("bench_junction_search", [&] {
    return trailcast::bench::Run({argv + 1, argv + argc});
  });
}
