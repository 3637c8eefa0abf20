#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "services/base/result.h"
#include "services/console/access.h"
#include "services/console/album.h"
#include "services/console/atlas.h"
#include "services/console/command_counts.h"
#include "services/console/desk.h"
#include "services/console/network_watch.h"
#include "services/console/site.h"
#include "services/console/transfers.h"
#include "services/http/door.h"
#include "services/http/server.h"

namespace trailcast::console {

class Runs;

// This serves the page and openapi.yaml's API over HTTP.
class Web {
 public:
  // A browser has one for each of its tabs.
  static constexpr int kMostStreams = 16;
  static constexpr std::chrono::seconds kAliveEvery{5};

  // `desk`, `atlas`, `site` and `runs` outlive this; the last two may be null. Port 0 is any that
  // is free. `names` are this host's names besides localhost, in lower case. `join` is how files of
  // routes get into the fleet; without it none are transferred. Fails with kUnavailable when the
  // port cannot be listened on.
  [[nodiscard]] static Result<std::unique_ptr<Web>> Open(Desk& desk, Atlas& atlas, Site* site,
                                                         const std::string& host, int port,
                                                         std::set<std::string> names,
                                                         Entry entry = {},
                                                         Transfers::Join join = {},
                                                         Runs* runs = nullptr);
  [[nodiscard]] int port() const { return server_.port(); }

 private:
  Web(Desk& desk, Atlas& atlas, Site* site, Entry entry, Transfers::Join join, Runs* runs);
  void ServeFiles();
  void ServeState();
  void ServeOrders();
  void ServeMissions();
  void ServeMetrics();
  void Stream(const httplib::Request& request, httplib::Response& response);
  void Tell(exchange::NowOrder order, const fleet::NowTarget& target,
            const httplib::Request& request, httplib::Response& response);
  void Send(const std::string& robot, const httplib::Request& request, httplib::Response& response);

  Desk& desk_;
  Access access_;
  NetworkWatch network_;
  Album album_;
  std::optional<Transfers> transfers_;
  http::Door door_;
  std::atomic<int> streams_{0};
  std::atomic<std::uint64_t> streams_refused_{0};
  std::atomic<std::uint64_t> stream_bytes_{0};
  CommandCounts commands_;
  http::Server server_;  // the last member, because its threads use the others
};

}  // namespace trailcast::console
