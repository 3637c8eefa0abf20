#include "services/lab/trial/src/trial_log.h"

#include <fmt/format.h>

#include <string>

#include "services/base/file_name.h"

namespace trailcast::trial {
std::filesystem::path TrialLogName(const TrialSetup& setup, const TrialCase& trial_case, int trial,
                                   int visit) {
  const std::string push =
      trial_case.push_m != 0.0 ? fmt::format("-push{:g}", trial_case.push_m) : "";
  const std::string flaw = trial_case.flaw.empty() ? "" : "-" + trial_case.flaw;
  const std::string start = trial_case.start > 0 ? fmt::format("-start{}", trial_case.start) : "";
  const std::string cell =
      trial_case.cell ? fmt::format("-cell{}", NumberOf(*trial_case.cell)) : "";
  const std::string visited = visit > 0 ? fmt::format("-visit{}", visit) : "";
  const char* const served = trial_case.through_server ? "-served" : "";
  const char* const same = setup.same_robot ? "-same" : "";
  return fmt::format("{}-{}-{}-{}{}{}{}{}{}-trial{}{}{}.mcap", ForFileName(setup.scenario),
                     agent::ToString(trial_case.method), ForFileName(trial_case.scout_camera.name),
                     ForFileName(trial_case.follower_camera.name), push, served, same, flaw, cell,
                     trial, start, visited);
}

Result<agent::Diagnosis> OpenTrialLog(const TrialSetup& setup, const TrialCase& trial_case,
                                      const TrialOptions& options, int trial, int visit,
                                      const route::RouteInfo& route) {
  // The log may take its time, because nobody waits for a simulated robot.
  agent::DiagnosisOptions files{.patient = true, .picture_every_s = 0.0};
  const std::filesystem::path folder = options.log_folder;
  if (!folder.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    files.log = folder / TrialLogName(setup, trial_case, trial, visit);
  }
  auto diagnosis = agent::Diagnosis::Open(files);
  if (!diagnosis) return diagnosis;
  agent::RunFacts facts{route, fmt::format("trial {}", trial), trial_case.follower_camera.name,
                        agent::ToString(trial_case.method)};
  facts.route.name = setup.scenario;
  facts.route.scout = AgentId("scout");
  facts.route.camera = trial_case.scout_camera.name;
  diagnosis->Begin(facts);
  return diagnosis;
}

}  // namespace trailcast::trial
