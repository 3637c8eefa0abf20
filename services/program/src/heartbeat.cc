#include "services/program/heartbeat.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <fstream>
#include <system_error>
#include <utility>

namespace trailcast::program {
namespace {

namespace fs = std::filesystem;
using exchange::AgentMode;
using exchange::AgentStatus;

// These are the file's first line.
constexpr const char* kWell = "well";
constexpr const char* kFault = "fault";

std::string Words(const AgentStatus& status) {
  std::string words = status.agent.value();
  if (!status.route.empty()) {
    words += fmt::format(": {:.0f} % of '{}'", 100.0 * status.progress, status.route);
  }
  if (!status.detail.empty()) words += ": " + status.detail;
  return words;
}

class ExchangeWithHeartbeat final : public exchange::RouteExchange {
 public:
  ExchangeWithHeartbeat(std::unique_ptr<exchange::RouteExchange> exchange, fs::path file,
                        std::shared_ptr<const exchange::NetworkState> network)
      : exchange_(std::move(exchange)), file_(std::move(file)), network_(std::move(network)) {}

  Result<void> Publish(const exchange::Message& message) override {
    if (const auto* status = std::get_if<AgentStatus>(&message)) {
      // The last status of a process that cannot go on must be known at once.
      if (status->mode != status_.mode) next_ = {};
      status_ = *status;
      Beat();
    }
    return exchange_->Publish(message);
  }
  void Gather() override { exchange_->Gather(); }
  void Flush() override { exchange_->Flush(); }
  std::vector<exchange::Message> Take(std::chrono::milliseconds max_wait) override {
    Beat();
    return exchange_->Take(max_wait);
  }
  Result<void> Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) override {
    return exchange_->Listen(topic, routes);
  }
  [[nodiscard]] std::uint64_t dropped() const override { return exchange_->dropped(); }

 private:
  void Beat() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kHeartbeatInterval;
    const bool written = Write();
    if (!written && !complained_) {
      spdlog::error("cannot write the heartbeat {}: check that its folder exists and is writable",
                    file_.string());
    }
    complained_ = !written;
  }
  // It is written under another name first, so that readers find all of it.
  [[nodiscard]] bool Write() const {
    fs::path other = file_;
    other += ".new";
    std::ofstream out(other, std::ios::trunc);
    const std::string trouble = network_ ? network_->trouble : "";
    // A robot without a network goes on by itself, but a server serves nobody.
    const bool faulty = status_.mode == AgentMode::kFault ||
                        (status_.role == exchange::AgentRole::kServer && !trouble.empty());
    out << (faulty ? kFault : kWell) << '\n'
        << Words(status_) << (trouble.empty() ? "" : "; no network: " + trouble) << '\n';
    out.close();
    std::error_code error;
    if (out) fs::rename(other, file_, error);
    return out && !error;
  }

  std::unique_ptr<exchange::RouteExchange> exchange_;
  fs::path file_;
  std::shared_ptr<const exchange::NetworkState> network_;
  AgentStatus status_;
  std::chrono::steady_clock::time_point next_{};
  bool complained_ = false;
};

}  // namespace

std::unique_ptr<exchange::RouteExchange> WithHeartbeat(
    std::unique_ptr<exchange::RouteExchange> exchange, fs::path file,
    std::shared_ptr<const exchange::NetworkState> network) {
  return std::make_unique<ExchangeWithHeartbeat>(std::move(exchange), std::move(file),
                                                 std::move(network));
}

Result<std::string> ReadHeartbeat(const fs::path& file, std::chrono::milliseconds stale_after) {
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  std::ifstream in(file);
  std::string state;
  std::string words;
  if (error || !std::getline(in, state) || !std::getline(in, words)) {
    return Fail(ErrorCode::kNotFound,
                "no heartbeat {}: does the process run, with --heartbeat and --server, as the same "
                "user?",
                file.string());
  }
  const auto age = std::chrono::duration<double>(fs::file_time_type::clock::now() - written);
  if (age > stale_after) {
    return Fail(ErrorCode::kUnavailable, "the process has not answered for {:.0f} s; it said: {}",
                age.count(), words);
  }
  if (state == kFault) return Fail(ErrorCode::kUnavailable, "{}", words);
  return words;
}

CLI::App* AddHeartbeat(CLI::App& app, CommonOptions& options) {
  app.add_option("--heartbeat", options.heartbeat,
                 "Renew this file every second while the process is well and on the network; the "
                 "command 'health' looks at it")
      ->envname("TRAILCAST_HEARTBEAT");
  CLI::App* health = app.add_subcommand(
      "health", "Tell whether the process with this --heartbeat runs and is well");
  health->fallthrough();
  health->preparse_callback(
      [store = app.get_option("--store")](std::size_t) { store->required(false); });
  return health;
}

int RunHealth(const CLI::App& app, const CommonOptions& options) {
  if (options.heartbeat.empty()) {
    fmt::print(stderr, "{}: health: give the running process's --heartbeat FILE\n", app.get_name());
    return kExitUsage;
  }
  const auto words = ReadHeartbeat(options.heartbeat);
  if (!words) return Complain(app, words.error());
  fmt::print("{}\n", *words);
  return kExitOk;
}

}  // namespace trailcast::program
