// This part of the server handles photos that robots take on missions.
#include <spdlog/spdlog.h>

#include "route_server/server.h"

namespace trailcast::server {

void Server::KeepPhotos(std::unique_ptr<photos::PhotoFolder> folder) {
  photos_.emplace(presence_.status().agent, std::move(folder));
}

bool Server::ServePhotos(const exchange::Message& message) {
  const auto* piece = std::get_if<exchange::PhotoPiece>(&message);
  const auto* request = std::get_if<exchange::PhotoRequest>(&message);
  if (piece == nullptr && request == nullptr) return false;
  if (!photos_) return true;
  if (piece != nullptr) {
    if (auto answer = photos_->Take(*piece)) replies_.emplace_back(*std::move(answer));
  } else if (auto answer = photos_->Give(*request)) {
    replies_.emplace_back(*std::move(answer));
  }
  return true;
}

void Server::TellKeptPhotos() {
  if (!photos_) return;
  for (exchange::PhotoRequest& kept : photos_->TakeKept()) replies_.emplace_back(std::move(kept));
  for (const std::string& note : photos_->TakeNotes()) spdlog::info("{}", note);
}

bool Server::AnswerPhotos(const exchange::Message& request) {
  const auto* question = std::get_if<exchange::NetworkRequest>(&request);
  if (question == nullptr || !photos::AsksForPhotos(question->words)) return false;
  if (photos_) {
    replies_.emplace_back(photos_->Answer(*question));
  } else {
    replies_.emplace_back(exchange::NetworkReply{
        .server = presence_.status().agent,
        .client = question->client,
        .request = question->request,
        .error = "keeps no photos: its log says why, or it was given no --photos"});
  }
  return true;
}

}  // namespace trailcast::server
