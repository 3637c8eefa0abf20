#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "agent/follow/follower.h"
#include "agent/teach/scout.h"
#include "route_server/server.h"
#include "services/exchange/in_process_exchange.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/agent/walk_device.h"

namespace trailcast::test {

// These are a server, scouts and followers in one process, each with a store of its own in a
// temporary folder, on a bus without middleware.
class Swarm {
 public:
  ~Swarm() { StopServer(); }

  void StartServer(const std::string& name = "server") {
    server_stops_ = false;
    auto server =
        server::Server::Open(AgentId(name), OpenStore(name), Join(exchange::ServerTopics()));
    if (!server) throw std::runtime_error(server.error().message);
    server_thread_ = std::thread([this, running = std::move(*server)] {
      server_result = running->Run([this] { return server_stops_.load(); });
    });
  }
  void StopServer() {
    server_stops_ = true;
    if (server_thread_.joinable()) server_thread_.join();
  }

  std::unique_ptr<store::RouteStore> OpenStore(const std::string& agent) {
    auto store = store::OpenSqliteStore(StoreFile(agent));
    if (!store) throw std::runtime_error(store.error().message);
    return std::move(*store);
  }
  [[nodiscard]] std::filesystem::path StoreFile(const std::string& agent) const {
    return folder_ / (agent + ".db");
  }
  std::unique_ptr<exchange::RouteExchange> Join(const exchange::TopicUse& use) {
    return bus_.Open(program::WithAgents(use));
  }

  agent::ScoutOptions ScoutNamed(const std::string& name) const {
    agent::ScoutOptions options;
    options.route = "hall";
    options.link.agent = AgentId(name);
    options.link.store_file = StoreFile(name).string();
    return options;
  }
  agent::FollowerOptions FollowerNamed(const std::string& name) const {
    agent::FollowerOptions options;
    options.link.agent = AgentId(name);
    options.link.route = "hall";
    options.link.store_file = StoreFile(name).string();
    options.link.wait_for_route = true;
    return options;
  }

  Result<agent::Summary> Teach(agent::RobotDevice& device, const agent::ScoutOptions& options,
                               bool with_server) {
    return agent::Teach(device, options, OpenStore(options.link.agent.value()),
                        with_server ? Join(exchange::ScoutTopics()) : nullptr);
  }
  Result<agent::ReplayOutcome> Replay(agent::RobotDevice& device,
                                      const agent::FollowerOptions& options, bool with_server) {
    return agent::Replay(device, options, OpenStore(options.link.agent.value()),
                         with_server ? Join(exchange::ReplayTopics()) : nullptr);
  }

  Result<void> server_result;

 private:
  TempDir folder_;
  exchange::InProcessBus bus_;
  std::atomic<bool> server_stops_{false};
  std::thread server_thread_;
};

}  // namespace trailcast::test
