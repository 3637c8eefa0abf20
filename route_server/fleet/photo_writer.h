#pragma once

#include <atomic>
#include <cstdint>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "services/base/mailbox.h"
#include "services/base/result.h"
#include "services/photos/photo_folder.h"

namespace trailcast::server {

// Writes photos into a folder on a thread of its own, one after the other, so that a slow disk
// holds up no messages. One other thread hands them over and takes what became of them; it never
// waits.
class PhotoWriter {
 public:
  static constexpr std::size_t kMostWaiting = 16;  // 16 MB

  explicit PhotoWriter(photos::PhotoFolder& folder);
  // Waits for the photo that is being written. Robots still have those that wait behind it.
  ~PhotoWriter();
  PhotoWriter(const PhotoWriter&) = delete;
  PhotoWriter& operator=(const PhotoWriter&) = delete;

  [[nodiscard]] bool full() const { return waiting_.size() == kMostWaiting; }
  [[nodiscard]] bool IsWaiting(const std::string& id) const { return waiting_.contains(id); }
  // Hands a photo over. Callers have seen that it is not full, and that no such photo waits.
  void Put(photos::Photo photo, std::vector<std::uint8_t> jpeg);

  struct Written {
    photos::Photo photo{};
    Result<std::vector<photos::Photo>> gone{};  // PhotoFolder::Add's answer
  };
  // Returns what has been written, or could not be written, since the last call.
  [[nodiscard]] std::vector<Written> TakeWritten();

 private:
  struct Item {
    photos::Photo photo{};
    std::vector<std::uint8_t> jpeg{};
  };
  void Run();

  photos::PhotoFolder& folder_;
  std::set<std::string> waiting_;  // ids that were put and not yet taken; of the caller's thread
  // No more than that are in either, so both have room for whatever is put.
  Mailbox<Item> items_{kMostWaiting};
  Mailbox<Written> written_{kMostWaiting};
  Bell handed_over_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace trailcast::server
