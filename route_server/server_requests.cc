// This part of the server handles members' questions, edits and missions.
#include "route_server/server.h"
#include "services/base/unix_time.h"
#include "services/catalog/catalog.h"
#include "services/exchange/bounds.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Everything else waits for so long, and for the request that is being answered then.
constexpr milliseconds kRequestsASlice{20};
// A commit has at most so many missions, so that it is no longer than a slice either.
constexpr std::size_t kMostMissionsACommit = 64;

exchange::Message Refusal(const exchange::Message& request, const AgentId& self,
                          const std::string& why) {
  const auto refusal = [&](const auto& refused, auto reply) {
    reply.server = self;
    reply.client = refused.client;
    reply.request = refused.request;
    reply.error = why;
    return exchange::Message(std::move(reply));
  };
  if (const auto* mission = std::get_if<mission::Mission>(&request)) return PutOff(*mission, why);
  if (const auto* query = std::get_if<exchange::MissionRequest>(&request)) {
    return refusal(*query, exchange::MissionReply{});
  }
  if (const auto* query = std::get_if<exchange::CatalogRequest>(&request)) {
    return refusal(*query, exchange::CatalogReply{});
  }
  if (const auto* edit = std::get_if<exchange::RouteEditRequest>(&request)) {
    return refusal(*edit, exchange::CatalogReply{});
  }
  if (const auto* edit = std::get_if<exchange::NetworkEdit>(&request)) {
    return refusal(*edit, exchange::NetworkReply{});
  }
  return refusal(std::get<exchange::NetworkRequest>(request), exchange::NetworkReply{});
}

}  // namespace

// A mission that another server passes on is kept by that one. A server that keeps none leaves
// missions to the others.
bool Server::IsRequest(const exchange::Message& message) const {
  if (const auto* mission = std::get_if<mission::Mission>(&message)) {
    return missions_ && !mission->relayed;
  }
  return std::holds_alternative<exchange::CatalogRequest>(message) ||
         std::holds_alternative<exchange::RouteEditRequest>(message) ||
         std::holds_alternative<exchange::NetworkRequest>(message) ||
         std::holds_alternative<exchange::NetworkEdit>(message) ||
         std::holds_alternative<exchange::MissionRequest>(message);
}

// A wrong request is refused at once, which costs nothing and keeps the queue small.
void Server::ReceiveRequest(const exchange::Message& request) {
  const auto* mission = std::get_if<mission::Mission>(&request);
  if (mission != nullptr && missions_->Refuses(*mission)) return;
  Result<void> possible;
  if (const auto* query = std::get_if<exchange::CatalogRequest>(&request)) {
    possible = exchange::CheckQuery(query->query);
  } else if (const auto* edit = std::get_if<exchange::RouteEditRequest>(&request)) {
    possible = exchange::CheckEdit(edit->edit);
  }
  if (!possible) {
    keeper_->Handle(request, steady_clock::now());
  } else if (const auto added = Enqueue(request); !added) {
    replies_.push_back(Refusal(request, presence_.status().agent, added.error().message));
  }
}

Result<void> Server::Enqueue(const exchange::Message& request) {
  if (quotas_) {
    auto allowed = quotas_->TakeRequest(MemberOf(request), steady_clock::now());
    if (!allowed) {
      ++metrics_.over_quota.requests;
      return allowed;
    }
  }
  auto added = requests_.Add(request);
  if (!added) ++metrics_.requests_refused;
  return added;
}

// Serves at least one request, and no more than fit into the slice. It stores missions in one
// commit.
void Server::ServeRequests() {
  const auto until = steady_clock::now() + kRequestsASlice;
  std::vector<mission::Mission> missions;
  while (auto request = requests_.Next()) {
    if (auto* mission = std::get_if<mission::Mission>(&*request)) {
      missions.push_back(std::move(*mission));
    } else {
      Serve(*request);
    }
    if (missions.size() == kMostMissionsACommit || steady_clock::now() >= until) break;
  }
  if (missions_) missions_->Take(missions, steady_clock::now(), NowUnixMs());
}

void Server::Serve(const exchange::Message& request) {
  if (ServeSchedules(request) || AnswerPhotos(request)) return;
  const auto* question = std::get_if<exchange::NetworkRequest>(&request);
  const auto* edit = std::get_if<exchange::NetworkEdit>(&request);
  const auto since_unix_ms =
      question == nullptr ? std::nullopt : network::ParseChangesSince(question->words);
  if (std::holds_alternative<exchange::MissionRequest>(request)) {
    if (missions_) {
      missions_->Handle(request, steady_clock::now(), NowUnixMs());
    } else {
      replies_.push_back(
          Refusal(request, presence_.status().agent,
                  "keeps no missions: its log says why, or it was given no --missions"));
    }
  } else if (question == nullptr && edit == nullptr) {
    keeper_->Handle(request, steady_clock::now());
    NoteDone(MemberOf(request).value());
  } else if (since_unix_ms) {
    AnswerHistory(*question, *since_unix_ms);
  } else if (!network_) {
    replies_.push_back(
        Refusal(request, presence_.status().agent,
                "keeps no network of routes: its log says why, or it was given no --junctions"));
  } else if (question != nullptr) {
    replies_.emplace_back(network_->Answer(*question));
  } else {
    exchange::NetworkReply reply = network_->Change(*edit, NowUnixMs());
    NoteMade();
    if (reply.error.empty() && replanning_) {
      const auto now = steady_clock::now();
      for (const auto& lines : {replanning_->LookAtAll(now), lanes_->LookAtAll(now)}) {
        for (const std::string& line : lines) {
          if (reply.lines.size() < exchange::kMaxNetworkLines) reply.lines.push_back(line);
        }
      }
    }
    replies_.emplace_back(std::move(reply));
  }
}

exchange::CatalogReply Server::AnswerCatalog(const AgentId& name,
                                             const exchange::CatalogRequest& request) {
  const auto begin = steady_clock::now();
  exchange::CatalogReply reply = request.query.view.empty()
                                     ? catalog::Answer(request, name, *store_)
                                     : views_.Answer(request, name);
  reply.holdings = holders_.Of(reply.page.routes, begin);
  reply.lacking = upkeep_->LackingOf(reply.page.routes);
  const std::chrono::duration<double> took = steady_clock::now() - begin;
  metrics_.queries[KindOf(request.query)].Note(took.count());
  return reply;
}

}  // namespace trailcast::server
