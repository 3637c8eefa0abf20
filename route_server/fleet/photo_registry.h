#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "route_server/fleet/photo_writer.h"
#include "services/base/newest_map.h"
#include "services/exchange/messages.h"
#include "services/photos/photo_folder.h"

namespace trailcast::server {

// Keeps the photos that robots take on missions, and gives them to operators. A robot hears of each
// piece which byte comes next, and that its photo is kept once it is on the disk. A piece that is
// lost or that comes twice, and a robot or a server that starts again, cost that piece or that
// photo's pieces, and no photo.
class PhotoRegistry {
 public:
  // Strangers can make up robots, so the photo that got no piece for longest is forgotten.
  static constexpr std::size_t kMostUnderWay = 64;
  static constexpr std::size_t kMostAPage = 200;

  PhotoRegistry(AgentId server, std::unique_ptr<photos::PhotoFolder> folder)
      : server_(std::move(server)), folder_(std::move(folder)), writer_(*folder_) {}

  // Takes a piece, and returns what its robot is told at once: nothing if it is for another server,
  // or if its photo is whole and being written, of which TakeKept tells.
  [[nodiscard]] std::optional<exchange::PhotoRequest> Take(const exchange::PhotoPiece& piece);
  // Returns what robots are told of the photos that have been written since the last call, or could
  // not be written.
  [[nodiscard]] std::vector<exchange::PhotoRequest> TakeKept();
  // Returns the piece that an operator asks for. Nothing if another server is asked.
  [[nodiscard]] std::optional<exchange::PhotoPiece> Give(const exchange::PhotoRequest& request);
  // Answers a question in words (photos::AsksForPhotos): a line for each photo, the last taken
  // first.
  [[nodiscard]] exchange::NetworkReply Answer(const exchange::NetworkRequest& request) const;
  // Returns lines for the log.
  [[nodiscard]] std::vector<std::string> TakeNotes() { return std::exchange(notes_, {}); }
  [[nodiscard]] const photos::PhotoFolder& folder() const { return *folder_; }

 private:
  struct UnderWay {
    std::string id{};
    std::vector<std::uint8_t> bytes{};
  };

  AgentId server_;
  std::unique_ptr<photos::PhotoFolder> folder_;
  NewestMap<AgentId, UnderWay> under_way_{kMostUnderWay};
  std::vector<std::string> notes_;
  PhotoWriter writer_;  // ends first
};

}  // namespace trailcast::server
