#include "services/program/stop_signal.h"

#include <atomic>
#include <csignal>

namespace trailcast::program {
namespace {

constexpr int kPatience = 2;
std::atomic<int> g_count{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch such");

extern "C" void OnStopSignal(int signal) {
  if (g_count.fetch_add(1) + 1 >= kPatience) std::signal(signal, SIG_DFL);
}

void Handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // A program started with nohup must ignore the hang-up. A script's shell ignores SIGINT for
    // programs in the background, but a teaching must be ended by it nevertheless.
    if (signal != SIGHUP || before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

}  // namespace

StopSignal::StopSignal() {
  g_count = 0;
  Handle(OnStopSignal);
}

StopSignal::~StopSignal() { Handle(SIG_DFL); }

int StopSignal::count() { return g_count.load(); }

}  // namespace trailcast::program
