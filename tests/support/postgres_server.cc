#include "tests/support/postgres_server.h"
#include "tests/support/await.h"

#include <fmt/format.h>
#include <pwd.h>
#include <signal.h>

#include <fstream>
#include <pqxx/pqxx>

namespace trailcast::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUser = "trailcast";
constexpr const char* kSystemUser = "postgres";

[[noreturn]] void Give(const std::string& why) {
  throw std::runtime_error("cannot start a PostgreSQL for tests: " + why);
}

// Debian keeps them apart by version, and out of PATH.
fs::path FindPrograms() {
  fs::path newest;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator("/usr/lib/postgresql", missing)) {
    if (fs::exists(entry.path() / "bin/initdb")) newest = std::max(newest, entry.path() / "bin");
  }
  if (newest.empty()) Give("there is no /usr/lib/postgresql/*/bin/initdb; ./run test installs it");
  return newest;
}

bool IsRoot() { return geteuid() == 0; }

}  // namespace

PostgresServer::PostgresServer(Sync sync) : programs_(FindPrograms()), sync_(sync) {
  Initialise();
  Start();
}

PostgresServer::~PostgresServer() {
  if (process_ == nullptr) return;
  process_->Signal(SIGINT);
  (void)process_->Wait(std::chrono::seconds(10));  // then it is killed
}

PostgresServer& PostgresServer::Shared() {
  static PostgresServer server;
  return server;
}

std::string PostgresServer::Url(const std::string& database, const std::string& password) const {
  return fmt::format("postgresql://{}:{}@/{}?host={}", kUser, password, database,
                     folder_.path().string());
}

std::string PostgresServer::CreateDatabase(const std::string& options) {
  const std::string name = fmt::format("routes{}", ++databases_);
  Execute(Url("postgres"), fmt::format("CREATE DATABASE {} {}", name, options));
  return Url(name);
}

void PostgresServer::Execute(const std::string& url, const std::string& sql) {
  pqxx::connection connection(url);
  pqxx::nontransaction(connection).exec(sql);
}

void PostgresServer::Stop(int signal) {
  process_->Signal(signal);
  if (!process_->Wait()) Give("it does not stop");
  process_.reset();
}

void PostgresServer::SignalAll(int signal) const {
  process_->Signal(signal);
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", process_->pid()));
  for (pid_t child = 0; children >> child;) kill(child, signal);
}

void PostgresServer::Start() {
  const fs::path log = folder_ / "log";
  const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
  do {  // after a crash, until the last of the old processes has noticed
    process_ = std::make_unique<Process>(
        AsItsUser({programs_ / "postgres", "-D", folder_ / "data", "-k", folder_.path(), "-c",
                   "listen_addresses=", "-c", sync_ == Sync::kOn ? "fsync=on" : "fsync=off"}),
        log);
    if (process_->WaitForOutput("ready to accept connections")) return;
  } while (std::chrono::steady_clock::now() < deadline);
  Give(process_->output());
}

std::vector<std::string> PostgresServer::AsItsUser(std::vector<std::string> words) const {
  if (!IsRoot()) return words;
  std::vector<std::string> as_user{"/usr/bin/setpriv", "--reuid",       kSystemUser,   "--regid",
                                   kSystemUser,        "--init-groups", "--pdeathsig", "KILL"};
  as_user.insert(as_user.end(), words.begin(), words.end());
  return as_user;
}

void PostgresServer::Initialise() {
  const fs::path password = folder_ / "password";
  std::ofstream(password) << kPassword << '\n';
  if (IsRoot()) {
    const passwd* user = getpwnam(kSystemUser);  // NOLINT(concurrency-mt-unsafe)
    if (user == nullptr) Give("root cannot run it, and there is no user postgres");
    for (const fs::path& path : {folder_.path(), password}) {
      if (chown(path.c_str(), user->pw_uid, user->pw_gid) != 0) Give("chown " + path.string());
    }
  }
  Process initdb(AsItsUser({programs_ / "initdb", "-D", folder_ / "data", "-U", kUser,
                            "--auth=scram-sha-256", "--pwfile=" + password.string(),
                            "--encoding=UTF8", "--locale=C.UTF-8", "--no-sync"}),
                 folder_ / "initdb.log");
  if (initdb.Wait() != 0) Give(initdb.output());
}

}  // namespace trailcast::test
