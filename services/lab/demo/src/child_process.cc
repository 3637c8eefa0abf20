#include "services/lab/demo/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

namespace trailcast::demo {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(10);
constexpr auto kKillOnDestruction = std::chrono::milliseconds(3000);
constexpr int kExecFailed = 127;

// Runs in the child, between fork and exec, where only async-signal-safe calls are allowed.
[[noreturn]] void Become(char* const* argv, int log, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kExecFailed);  // the parent died before the line above
  const int empty = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(empty, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  execv(argv[0], argv);
  _exit(kExecFailed);
}

std::string SystemMessage(int error) { return std::generic_category().message(error); }

}  // namespace

std::string ToString(const ExitStatus& status) {
  if (status.signal != 0) return fmt::format("ended by signal {}", status.signal);
  return fmt::format("ended with exit code {}", status.code);
}

Result<ChildProcess> ChildProcess::Start(const std::vector<std::string>& argv,
                                         const std::filesystem::path& log) {
  if (access(argv.front().c_str(), X_OK) != 0) {
    return Fail(ErrorCode::kNotFound, "cannot run {}: {}; it is built by ./run build", argv.front(),
                SystemMessage(errno));
  }
  std::vector<std::string> copies = argv;
  std::vector<char*> pointers;
  pointers.reserve(copies.size() + 1);
  for (std::string& copy : copies) pointers.push_back(copy.data());
  pointers.push_back(nullptr);
  const int descriptor = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return Fail(ErrorCode::kUnavailable, "cannot write {}: {}", log.string(), SystemMessage(errno));
  }
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) Become(pointers.data(), descriptor, parent);
  const int error = errno;
  close(descriptor);
  if (pid < 0) {
    return Fail(ErrorCode::kUnavailable, "cannot start {}: {}", argv.front(), SystemMessage(error));
  }
  setpgid(pid, pid);  // the child does so itself; whichever comes first counts
  return ChildProcess(pid, log);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), status_(other.status_), log_(std::move(other.log_)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(status_, other.status_);
  std::swap(log_, other.log_);
  return *this;
}

ChildProcess::~ChildProcess() {
  Terminate();
  Reap(kKillOnDestruction);
}

std::optional<ExitStatus> ChildProcess::Poll() {
  if (status_ || pid_ < 0) return status_;
  int raw = 0;
  if (waitpid(pid_, &raw, WNOHANG) != pid_) return std::nullopt;
  status_ = WIFSIGNALED(raw) ? ExitStatus{0, WTERMSIG(raw)} : ExitStatus{WEXITSTATUS(raw), 0};
  return status_;
}

void ChildProcess::Terminate() {
  if (pid_ > 0 && !Poll()) kill(pid_, SIGTERM);
}

void ChildProcess::Reap(std::chrono::milliseconds bound) {
  if (pid_ < 0) return;
  const auto deadline = std::chrono::steady_clock::now() + bound;
  while (!Poll()) {
    if (std::chrono::steady_clock::now() > deadline) kill(-pid_, SIGKILL);
    std::this_thread::sleep_for(kPollInterval);
  }
}

std::vector<std::string> LastLines(const std::filesystem::path& file, std::size_t count) {
  std::ifstream in(file);
  std::deque<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
    if (lines.size() > count) lines.pop_front();
  }
  return {lines.begin(), lines.end()};
}

}  // namespace trailcast::demo
