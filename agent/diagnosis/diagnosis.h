#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "agent/diagnosis/run_log.h"
#include "agent/diagnosis/run_mcap.h"
#include "agent/diagnosis/run_recorder.h"

namespace trailcast::agent {

class RunMcapFile;

struct DiagnosisOptions {
  std::filesystem::path log{};   // an MCAP file; empty for none
  std::filesystem::path view{};  // a folder for pictures of the frames; empty for none
  int view_every = 1;            // frames
  // Waits for a slow disk instead of leaving frames out of the log, because nothing drives here.
  bool patient = false;
  double picture_every_s = kEveryPicture_s;  // in the log; 0 for none
  // Beyond this size a log gets no more frames, and says so; 0 for no bound.
  std::uint64_t most_log_bytes = 0;
  Fields header{};  // of the log, in addition to the known facts of the run
};

// Writes a replay's log, and pictures of what it saw, while it runs. A disk that fails stops
// neither the robot nor the loop; the error comes at the end. The caller's thread draws and writes
// pictures, for robots that have the time: recorded and simulated ones.
class Diagnosis {
 public:
  ~Diagnosis();
  Diagnosis(Diagnosis&&) noexcept;
  Diagnosis& operator=(Diagnosis&&) noexcept;

  // Errors: the log's file or the pictures' folder cannot be made.
  [[nodiscard]] static Result<Diagnosis> Open(const DiagnosisOptions& options);

  void Begin(const RunFacts& facts);
  // Must be called after each Observe or Pass, while the session's frame is still there.
  void Add(const RunFrame& seen, const ReplaySession& session, const ReplayStep& step);
  void Note(const std::string& what, const std::string& text);
  [[nodiscard]] Result<void> End(const std::string& state, const std::string& reason);

 private:
  explicit Diagnosis(DiagnosisOptions options);
  void Log(const RunFrame& seen, const ReplaySession& session, const ReplayStep& step);
  [[nodiscard]] bool HasRoom();
  void Draw(const ReplaySession& session, const ReplayStep& step);

  DiagnosisOptions options_;
  std::unique_ptr<RunMcapFile> log_;
  RunRecorder recorder_;
  bool begun_ = false;
  bool full_ = false;
  int frames_ = 0;
  Result<void> view_result_;
};

}  // namespace trailcast::agent
