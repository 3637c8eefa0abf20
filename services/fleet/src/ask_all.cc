#include "services/fleet/src/ask_all.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "services/base/time.h"
#include "services/fleet/draw.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

// Other servers answer within this time of the first.
constexpr milliseconds kOthersAnswer{1000};
constexpr milliseconds kAskAllAgain{500};
constexpr milliseconds kListen{100};

using Replies = std::map<AgentId, exchange::NetworkReply>;

// Returns the page from that line on of each of these servers that answers. Without any, it listens
// to all that there are.
Replies AskForPage(exchange::RouteExchange& exchange, const AgentId& client,
                   const std::string& words, std::uint32_t first, const std::set<AgentId>& servers,
                   milliseconds timeout) {
  const exchange::NetworkRequest question{
      .client = client, .request = DrawNumber(), .words = words, .first = first};
  Replies replies;
  auto until = SteadyClock::now() + timeout;
  auto ask_at = SteadyClock::now();
  while (SteadyClock::now() < until && (servers.empty() || replies.size() < servers.size())) {
    if (SteadyClock::now() >= ask_at) {
      ask_at = SteadyClock::now() + kAskAllAgain;
      (void)exchange.Publish(question);  // repeated if it could not be sent
    }
    for (exchange::Message& message : exchange.Take(kListen)) {
      auto* reply = std::get_if<exchange::NetworkReply>(&message);
      if (reply == nullptr || reply->client != client || reply->request != question.request) {
        continue;
      }
      if (!servers.empty() && !servers.contains(reply->server)) continue;
      if (replies.empty()) until = std::min(until, SteadyClock::now() + kOthersAnswer);
      replies.try_emplace(reply->server, std::move(*reply));
    }
  }
  return replies;
}

}  // namespace

Result<std::map<AgentId, std::vector<std::string>>> AskAllForLines(
    exchange::RouteExchange& exchange, const AgentId& client, const std::string& words,
    milliseconds timeout, std::size_t enough) {
  std::map<AgentId, std::vector<std::string>> lines;
  std::string refused;
  std::uint32_t first = 0;
  std::set<AgentId> servers;  // those that have more; nobody knows at first which there are
  do {
    Replies replies = AskForPage(exchange, client, words, first, servers, timeout);
    servers.clear();
    std::uint32_t next = 0;
    for (auto& [server, reply] : replies) {
      if (!reply.error.empty()) {
        refused = fmt::format("server '{}' {}", server.value(), reply.error);
        continue;
      }
      std::vector<std::string>& of_server = lines[server];
      std::move(reply.lines.begin(), reply.lines.end(), std::back_inserter(of_server));
      if (reply.next <= first || of_server.size() >= enough) continue;
      servers.insert(server);
      next = std::max(next, reply.next);
    }
    first = next;
  } while (!servers.empty());
  if (lines.empty() && !refused.empty()) return Fail(ErrorCode::kUnavailable, "{}", refused);
  if (lines.empty()) {
    return Fail(ErrorCode::kUnavailable,
                "no route server answered within {:.1f} s: is trailcast-server running, with the "
                "same domain, tag and network interface?",
                Seconds(timeout));
  }
  return lines;
}

}  // namespace trailcast::fleet
