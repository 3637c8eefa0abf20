#pragma once

#include <signal.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {

// A PostgreSQL of the test's own, reached by a socket in a temporary folder, gone when the test is
// over. Run by root, it runs as the user `postgres` that Debian's package makes. Throws
// std::runtime_error, saying why, when it cannot be started.
class PostgresServer {
 public:
  // Whether its commits wait for the disk; without, what it loses is lost with the machine alone.
  enum class Sync : std::uint8_t { kOn, kOff };

  explicit PostgresServer(Sync sync = Sync::kOff);
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  // One for all tests of a program, as starting takes a second or two.
  static PostgresServer& Shared();

  static constexpr const char* kPassword = "open-sesame";
  [[nodiscard]] std::string Url(const std::string& database,
                                const std::string& password = kPassword) const;
  // A new, empty one; its URL.
  [[nodiscard]] std::string CreateDatabase(const std::string& options = "");
  // In the database of this URL.
  static void Execute(const std::string& url, const std::string& sql);

  // SIGINT: disconnects all and writes everything; SIGKILL: a crash.
  void Stop(int signal);
  void Start();
  // All of its processes stand still, and the connections to them stay; until thawed.
  void Freeze() { SignalAll(SIGSTOP); }
  void Thaw() { SignalAll(SIGCONT); }

 private:
  void SignalAll(int signal) const;
  [[nodiscard]] std::vector<std::string> AsItsUser(std::vector<std::string> words) const;
  void Initialise();

  TempDir folder_;
  std::filesystem::path programs_;
  Sync sync_;
  int databases_ = 0;
  std::unique_ptr<Process> process_;
};

}  // namespace trailcast::test
