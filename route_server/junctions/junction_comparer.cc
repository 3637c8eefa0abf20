#include "route_server/junctions/junction_comparer.h"

#include <chrono>
#include <utility>

#include "services/base/cpu_time.h"
#include "services/base/give_way.h"
#include "services/base/guarded.h"

namespace trailcast::server {

std::vector<junctions::Junction> JunctionComparer::FindAll(
    const Views& a, const Views& b, bool same_camera, const junctions::JunctionOptions& options) {
  return b ? junctions::FindJunctions(*a, *b, same_camera, options)
           : junctions::FindLoops(*a, options);
}

JunctionComparer::JunctionComparer(Find find)
    : find_(std::move(find)), thread_([this] { Run(); }) {}

JunctionComparer::~JunctionComparer() {
  ending_ = true;
  bell_.Ring();
  thread_.join();
}

std::optional<std::uint64_t> JunctionComparer::TryPut(Views a, Views b, bool same_camera) {
  const std::uint64_t number = jobs_put_ + 1;
  if (!jobs_.TryPut({number, std::move(a), std::move(b), same_camera})) return std::nullopt;
  bell_.Ring();
  jobs_put_ = number;
  return number;
}

void JunctionComparer::Run() {
  constexpr int kNiceness = 10;
  constexpr std::chrono::milliseconds kLookEvery{1000};
  GiveWay(kNiceness);
  while (!ending_) {
    const auto job = jobs_.TryGet();
    if (!job) {
      bell_.Wait(kLookEvery);
      continue;
    }
    // The queue has room, because nobody puts in more than it holds without taking some out.
    (void)done_.TryPut(Compare(*job));
  }
}

JunctionComparer::Done JunctionComparer::Compare(const Job& job) const {
  const double until_ms = ThreadCpuMs() + kMost_ms;
  junctions::JunctionOptions options;
  options.give_up = [&] { return ending_ || ThreadCpuMs() > until_ms; };
  return {job.number, Guarded("the thread that looks for junctions",
                              [&]() -> Result<std::vector<junctions::Junction>> {
                                return find_(job.a, job.b, job.same_camera, options);
                              })};
}

}  // namespace trailcast::server
