#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "services/tool/checkup.h"
#include "services/tool/command.h"

namespace trailcast::tool {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  trailcast doctor\n"
    "  trailcast doctor --network-interface wlan0 --folder /var/lib/trailcast\n"
    "Exit status: 1 if anything is BAD.";

int Run(const program::CommonOptions& common, const std::string& folder) {
  const std::vector<Finding> findings = ExamineMachine(folder, common.network_interface);
  std::fputs(CheckupText(findings).c_str(), stdout);
  const bool bad = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.grade == Finding::Grade::kBad;
  });
  return bad ? program::kExitFailure : program::kExitOk;
}

}  // namespace

Command AddDoctorCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto folder = std::make_shared<std::string>(".");
  CLI::App* app = parent.add_subcommand(
      "doctor", "Look whether this machine is fit to share routes, and say what to change");
  app->footer(kExamples);
  app->add_option("--folder", *folder, "Where routes are to be kept")->capture_default_str();
  return {app, [folder, &common] { return Run(common, *folder); }};
}

}  // namespace trailcast::tool
