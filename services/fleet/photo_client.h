#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"
#include "services/photos/photo.h"

namespace trailcast::fleet {

// This is a photo, and the server that keeps it.
struct KnownPhoto {
  AgentId server{};
  photos::Photo photo{};
};

// Reads a server's lines. Lines of a later server that are no photos are left out.
[[nodiscard]] std::vector<KnownPhoto> PhotosIn(const AgentId& server,
                                               const std::vector<std::string>& lines);

// Returns at most `limit` photos of all servers that answer within a second after the first, the
// last taken first. Fails with kUnavailable if none answers within `timeout`, or if those that do
// keep no photos.
[[nodiscard]] Result<std::vector<KnownPhoto>> AskForPhotos(exchange::RouteExchange& exchange,
                                                           const AgentId& client,
                                                           const photos::PhotoQuery& query,
                                                           std::size_t limit,
                                                           std::chrono::milliseconds timeout);

// This fetches one photo from its server. It has no I/O and no clock: Asks is to be published
// repeatedly, and whenever Hear has taken a piece.
class PhotoFetch {
 public:
  PhotoFetch(AgentId client, KnownPhoto known);

  [[nodiscard]] exchange::PhotoRequest Asks() const;
  // Returns whether the message was a piece of it that was lacking, or says why there is none.
  bool Hear(const exchange::Message& message);
  // Returns its JPEG, or why there is none, once that is known.
  [[nodiscard]] const std::optional<Result<std::vector<std::uint8_t>>>& outcome() const {
    return outcome_;
  }

 private:
  AgentId client_;
  KnownPhoto known_;
  std::vector<std::uint8_t> jpeg_;
  std::optional<Result<std::vector<std::uint8_t>>> outcome_;
};

// Returns a photo's JPEG. Fails with kUnavailable if its server does not answer for `timeout`, and
// with kNotFound if it has it no more.
[[nodiscard]] Result<std::vector<std::uint8_t>> FetchPhoto(exchange::RouteExchange& exchange,
                                                           const AgentId& client,
                                                           const KnownPhoto& known,
                                                           std::chrono::milliseconds timeout);

// Returns the name of its file in a folder for people: "2026-11-30T09-15-02Z-dock-robot2-4f2a.jpg".
[[nodiscard]] std::string FileNameOf(const photos::Photo& photo);
// Returns photos.csv, which lies in the folder with them: a row for each, with its file's name.
[[nodiscard]] std::string PhotosCsv(std::span<const KnownPhoto> photos);

// Returns a table for people, and an array of objects for programs.
[[nodiscard]] std::string PhotosTable(std::span<const KnownPhoto> photos);
[[nodiscard]] nlohmann::ordered_json PhotoJson(const KnownPhoto& known);
[[nodiscard]] nlohmann::ordered_json PhotosJson(std::span<const KnownPhoto> photos);

}  // namespace trailcast::fleet
