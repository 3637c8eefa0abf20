#include "tests/soak/soak.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "services/dds/dds_exchange.h"
#include "services/store/route_store.h"

namespace trailcast::soak {
namespace {

using exchange::Topic;

// Returns a bystander's exchange, which hears everything, and asks for it as a follower does.
std::unique_ptr<exchange::RouteExchange> Listen() {
  dds::DdsOptions options;
  options.network_interface = "air";
  options.self = AgentId("auditor");
  auto opened = dds::OpenDdsExchange(
      options, {.write = {Topic::kSegmentRequests},
                .read = {Topic::kRoutes, Topic::kSegments, Topic::kReceipts, Topic::kAgents}});
  if (!opened) throw std::runtime_error(opened.error().message);
  return std::move(*opened);
}

}  // namespace

Soak::Soak(const SoakOptions& options)
    : options_(options),
      disk_(options.folder / "disk"),
      fleet_(lab_, options.folder, disk_.folder()),
      faults_(options.seed, fleet_),
      casualties_(lab_, options.folder),
      exchange_(Listen()) {
  report_.seed = options_.seed;
  faults_.OnServerKilled([this] { CheckStore(); });
  if (!options_.csv.empty()) {
    std::ofstream(options_.csv) << "seconds,memory_kb,threads,descriptors,spared\n";
  }
}

Report Soak::Run(const std::function<bool()>& stop) {
  fleet_.StartServer();
  for (int number = 1; !stop() && Clock::now() < began_ + options_.length; ++number) {
    if (Clock::now() >= began_ + options_.length / 2) faults_.SpareServer();
    RunCycle(number, stop);
  }
  End();
  return report_;
}

void Soak::RunCycle(int number, const std::function<bool()>& stop) {
  const Errand errand{fmt::format("lap-{}", number),
                      options_.folder / fmt::format("lap-{}", number),
                      options_.seed + static_cast<std::uint64_t>(number)};
  Cycle cycle(errand, fleet_, ledger_, *exchange_, live_);
  cycle_ = &cycle;
  casualties_.Begin(errand.route, errand.folder);
  while (!cycle.done() && !stop()) {
    const auto now = Clock::now();
    Hear(now);
    faults_.Tick(now);
    cycle.Tick(now);
  }
  if (!stop()) CalmDown();
  casualties_.End();
  cycle_ = nullptr;
  if (stop()) return;
  report_.Add(cycle.outcome());
  TellCycle(cycle.outcome());
  std::filesystem::remove_all(errand.folder);
}

void Soak::Hear(Clock::time_point now) {
  constexpr std::chrono::milliseconds kWait{20};
  for (const exchange::Message& message : exchange_->Take(kWait)) {
    if (const auto* receipt = std::get_if<exchange::Receipt>(&message)) ledger_.Note(*receipt);
    if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
      fleet_.Hear(*status, now);
    }
    casualties_.Handle(message);
    if (cycle_ != nullptr) cycle_->Handle(message, now);
  }
  if (now >= sample_at_) SampleServer(now);
}

// Until nothing is wrong any more, and everybody was heard since.
void Soak::CalmDown() {
  faults_.Hold(true);
  while (!faults_.calm()) {
    const auto now = Clock::now();
    Hear(now);
    faults_.Tick(now);
  }
  faults_.Hold(false);
}

// While no server has it open.
void Soak::CheckStore() {
  const auto store = store::OpenSqliteStore(fleet_.ServersStore());
  if (!store) {
    report_.failures.push_back("the server's store: " + store.error().message);
    return;
  }
  ++report_.store_checks;
  for (std::string& lost : ledger_.LostIn(**store)) {
    report_.failures.push_back("receipted, and lost: " + lost);
  }
  for (std::string& left : ledger_.UndeletedIn(**store)) {
    report_.failures.push_back("deleted, and there again: " + left);
  }
}

void Soak::SampleServer(Clock::time_point now) {
  constexpr std::chrono::seconds kEvery{1};
  sample_at_ = now + kEvery;
  if (!fleet_.server().running()) return;
  const auto vitals = VitalsOf(fleet_.server().pid());
  if (!vitals) return;
  if (faults_.spares_server()) sampled_.push_back(*vitals);
  if (options_.csv.empty()) return;
  std::ofstream(options_.csv, std::ios::app) << fmt::format(
      "{:.0f},{},{},{},{}\n", std::chrono::duration<double>(now - began_).count(),
      vitals->memory_kb, vitals->threads, vitals->descriptors, faults_.spares_server() ? 1 : 0);
}

void Soak::TellCycle(const Cycle::Outcome& outcome) {
  fmt::print("{:>6.0f} s: cycle {}, {} segments, {} arrived; {} faults so far{}\n",
             std::chrono::duration<double>(Clock::now() - began_).count(), report_.cycles,
             outcome.segments, outcome.arrived, faults_.recoveries().size(),
             outcome.failures.empty() ? "" : "; FAILED");
  std::fflush(stdout);
}

void Soak::End() {
  if (!fleet_.server().running()) {
    report_.failures.push_back("the server ended by itself:\n" + fleet_.server().LastWords());
  } else if (fleet_.server().Stop() != 0) {
    report_.failures.push_back("the server did not end well:\n" + fleet_.server().LastWords());
  }
  CheckStore();
  for (std::string& failure : faults_.TakeFailures()) report_.failures.push_back(failure);
  for (std::string& failure : casualties_.TakeFailures()) report_.failures.push_back(failure);
  report_.casualties = casualties_.struck();
  report_.took = Clock::now() - began_;
  report_.recoveries = faults_.recoveries();
  report_.receipted = ledger_.receipted();
  report_.checked = ledger_.checked();
  // Until then it fills what it keeps anyway: indices, caches, pools.
  const std::size_t warm_up = sampled_.size() / 3;
  report_.server.assign(sampled_.begin() + static_cast<std::ptrdiff_t>(warm_up), sampled_.end());
  if (const auto growth = GrowthOf(report_.server); growth && !IsFlat(*growth)) {
    report_.failures.push_back("the server has grown");
  }
}

}  // namespace trailcast::soak
