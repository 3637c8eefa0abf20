#pragma once

namespace trailcast::program {

// SIGINT, SIGTERM and SIGHUP (the terminal is gone) turned into a flag, so that a process ends by
// its own code and a robot is stopped first. Signals ignored from the start stay so (nohup). A
// third signal kills, in case that code hangs. One per process, in main.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  // How often we were asked to stop. Any thread.
  [[nodiscard]] static int count();
  [[nodiscard]] static bool requested() { return count() > 0; }
};

}  // namespace trailcast::program
