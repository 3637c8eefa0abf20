#pragma once

namespace trailcast::program {

// Turns SIGINT, SIGTERM and SIGHUP (the terminal is gone) into a flag, so that a process ends by
// its own code and stops a robot first. Signals that are ignored from the start stay so (nohup). A
// third signal kills, in case that code hangs. There is one per process, in main.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  // Returns how often the process was asked to stop. Any thread may call it.
  [[nodiscard]] static int count();
  [[nodiscard]] static bool requested() { return count() > 0; }
};

}  // namespace trailcast::program
