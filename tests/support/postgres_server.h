#pragma once

#include <signal.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {

// This is a PostgreSQL server of the test's own, reached by a socket in a temporary folder, and
// gone when the test is over. If root runs it, it runs as the user `postgres` that Debian's package
// makes. It throws std::runtime_error, which says why, when it cannot be started.
class PostgresServer {
 public:
  // This is whether commits wait for the disk. If not, they are lost only if the machine is.
  enum class Sync : std::uint8_t { kOn, kOff };

  explicit PostgresServer(Sync sync = Sync::kOff);
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  // Returns one server for all tests of a program, because starting takes a second or two.
  static PostgresServer& Shared();

  static constexpr const char* kPassword = "open-sesame";
  [[nodiscard]] std::string Url(const std::string& database,
                                const std::string& password = kPassword) const;
  // Makes a new, empty database and returns its URL.
  [[nodiscard]] std::string CreateDatabase(const std::string& options = "");
  // Executes SQL in the database of this URL.
  static void Execute(const std::string& url, const std::string& sql);

  // SIGINT disconnects all clients and writes everything. SIGKILL is a crash.
  void Stop(int signal);
  void Start();
  // Stops all of its processes, with connections to them open, until they are thawed.
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
