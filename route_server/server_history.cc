// This part of the server records changes.
#include <spdlog/spdlog.h>

#include "route_server/server.h"
#include "services/base/unix_time.h"

namespace trailcast::server {
namespace {

void Warn(const Result<void>& noted) {
  if (!noted) spdlog::warn("what was changed is not in the history: {}", noted.error().message);
}

}  // namespace

Result<void> Server::KeepHistory(std::unique_ptr<store::HistoryStore> store) {
  auto history = History::Open(presence_.status().agent, std::move(store), *store_, NowUnixMs());
  if (!history) return tl::unexpected(history.error());
  history_ = std::move(*history);
  return {};
}

void Server::NoteAnnounced(const std::vector<exchange::Message>& outgoing) {
  if (!history_) return;
  std::vector<route::RouteInfo> infos;
  for (const exchange::Message& message : outgoing) {
    const auto* announced = std::get_if<exchange::RouteAnnouncement>(&message);
    if (announced != nullptr) infos.push_back(announced->info);
  }
  Warn(history_->Note(infos, "", NowUnixMs()));
}

// Notes the state before an edit, so that its changes can be told.
void Server::NotePlanned(std::span<const route::RouteInfo> planned) {
  planned_.clear();
  for (const route::RouteInfo& info : planned) planned_.push_back(info.key);
  if (history_) Warn(history_->NoteStored(planned_, "", NowUnixMs()));
}

void Server::NoteDone(const std::string& by) {
  if (history_) Warn(history_->NoteStored(planned_, by, NowUnixMs()));
  planned_.clear();
}

void Server::NoteMade() {
  const std::vector<network::Change> made = network_->TakeMade();
  if (history_) Warn(history_->Add(made));
}

void Server::AnswerHistory(const exchange::NetworkRequest& request, std::int64_t since_unix_ms) {
  replies_.emplace_back(
      history_ ? history_->Answer(request, since_unix_ms, NowUnixMs())
               : exchange::NetworkReply{
                     .server = presence_.status().agent,
                     .client = request.client,
                     .request = request.request,
                     .error = "keeps no history: its log says why, or it was given no --history"});
}

}  // namespace trailcast::server
