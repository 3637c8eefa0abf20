#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/places.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"

namespace trailcast::test {

// This runs the programs as a user would, each test in a folder and a DDS network of its own.
class ProgramsTest : public testing::Test {
 protected:
  using Words = std::vector<std::string>;
  static constexpr int kTaughtFrames = 150;
  // A virtual robot's larger pictures take four times as long to draw, and most of its time is
  // spent on that. Tests that do not measure following have these.
  static constexpr const char* kSmallPictures = "webcam+width=160+height=120";
  // The last milestone lies at the taught end, and followers walk a little further.
  static constexpr int kFollowerFrames = 220;

  std::unique_ptr<Process> Start(const std::string& program, const Words& words,
                                 const std::string& log) {
    Words argv{ProgramsDir() + "/" + program, "--dds-tag", tag_, "--network-interface", "lo"};
    argv.insert(argv.end(), words.begin(), words.end());
    return std::make_unique<Process>(argv, Path(log + ".log"));
  }
  std::unique_ptr<Process> Agent(const Words& words, const std::string& log = "agent") {
    return Start("trailcast-agent", words, log);
  }
  // Returns a server that runs and answers.
  std::unique_ptr<Process> Server(const std::string& store = "server.db",
                                  const std::string& log = "server") {
    auto server = Start("trailcast-server", {"--store", Path(store)}, log);
    EXPECT_TRUE(server->WaitForOutput("ready")) << server->output();
    return server;
  }
  struct Ended {
    int status = -1;
    std::string output;
  };
  static Ended End(Process& process) {
    const auto status = process.Wait();
    return {status.value_or(-1), process.output()};
  }
  Ended RunAgent(const Words& words) { return End(*Agent(words)); }

  [[nodiscard]] std::string Path(const std::string& name) const {
    return (folder_ / name).string();
  }
  // Returns a folder of pictures of one walk.
  std::string Walk(const std::string& name, int frames) {
    WriteWalk(folder_ / name, frames);
    return Path(name);
  }
  Words TeachWords(const std::string& frames, const std::string& store) {
    return {"teach", "--frames", frames, "--route", "hall", "--store", Path(store)};
  }
  Words ReplayWords(const std::string& frames, const std::string& store) {
    return {"replay", "--frames", frames, "--route", "hall", "--store", Path(store)};
  }
  static Words With(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  TempDir folder_;
  std::string tag_ = "scenario-" + std::to_string(getpid());  // of programs started from now on
};

}  // namespace trailcast::test
