#pragma once

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/await.h"

namespace trailcast::test {

// This is a process under test, with stdout and stderr together in a file. It is killed when the
// test is over.
class Process {
 public:
  Process(std::vector<std::string> argv, std::filesystem::path output)
      : output_(std::move(output)) {
    std::vector<char*> words;
    words.reserve(argv.size() + 1);
    for (std::string& word : argv) words.push_back(word.data());
    words.push_back(nullptr);
    const int log = open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (log < 0) throw std::runtime_error("cannot write " + output_.string());
    pid_ = fork();
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      dup2(log, STDOUT_FILENO);
      dup2(log, STDERR_FILENO);
      execv(words.front(), words.data());
      _exit(127);
    }
    close(log);
    if (pid_ < 0) throw std::runtime_error("cannot start " + argv.front());
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (status_) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  [[nodiscard]] pid_t pid() const { return pid_; }
  void Signal(int signal) const {
    if (!status_) kill(pid_, signal);
  }

  [[nodiscard]] std::string output() const {
    std::ifstream stream(output_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  // Waits until the output holds `text`. Returns false if it does not within the bound, or the
  // process ended without it.
  [[nodiscard]] bool WaitForOutput(const std::string& text) {
    return WaitUntil([&] {
             const bool ended = Ended();
             return output().find(text) != std::string::npos || ended;
           }) &&
           output().find(text) != std::string::npos;
  }

  // Returns the exit status, or 128 and the signal that ended it, or nothing if it goes on beyond
  // the bound.
  [[nodiscard]] std::optional<int> Wait(std::chrono::seconds bound = kLongEnough) {
    (void)WaitUntil([&] { return Ended(); }, bound);
    return status_;
  }
  [[nodiscard]] bool Ended() {
    int status = 0;
    if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) {
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return status_.has_value();
  }

 private:
  std::filesystem::path output_;
  pid_t pid_ = -1;
  std::optional<int> status_;
};

}  // namespace trailcast::test
