#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/durable_file.h"
#include "services/base/result.h"
#include "services/photos/photo.h"

namespace trailcast::photos {

// Photos on a disk: ID.jpg is the picture and ID.photo what is known of it. The folder has a
// bounded size, and the photos that it has had for longest make room for others. A photo
// that Add has kept outlasts a loss of power. It may be used from any thread, and a disk that is
// slow to write keeps nobody waiting but the thread that calls Add or Remove.
class PhotoFolder {
 public:
  static constexpr std::size_t kMostPhotos = 100'000;
  // Returns once the file outlasts a loss of power.
  using Write = std::function<Result<void>(const std::filesystem::path&, const std::string&)>;

  // Makes the folder if it is missing, and finds what an earlier process has left. A picture of
  // which nothing is known, because the power was lost meanwhile, is removed. Fails with
  // kUnavailable if nothing can be written there.
  [[nodiscard]] static Result<std::unique_ptr<PhotoFolder>> Open(
      std::filesystem::path folder, std::uint64_t most_bytes,
      Write write = [](const auto& file, const auto& text) { return ReplaceFile(file, text); });

  // Keeps a photo, and returns those that had to go for it. One that is there already stays as it
  // is. Fails with kUnavailable if it cannot be written.
  [[nodiscard]] Result<std::vector<Photo>> Add(const Photo& photo,
                                               std::span<const std::uint8_t> jpeg);
  // Returns those that match, the last taken first.
  [[nodiscard]] std::vector<Photo> Find(const PhotoQuery& query) const;
  [[nodiscard]] std::optional<Photo> Get(const std::string& id) const;
  // Returns the one that it has had for longest.
  [[nodiscard]] std::optional<Photo> First() const;
  // Returns so many bytes of a picture from `offset` on, or those that there are.
  [[nodiscard]] Result<std::vector<std::uint8_t>> Read(const std::string& id, std::uint32_t offset,
                                                       std::size_t most) const;
  void Remove(const std::string& id);
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  PhotoFolder(std::filesystem::path folder, std::uint64_t most_bytes, Write write)
      : folder_(std::move(folder)), most_bytes_(most_bytes), write_(std::move(write)) {}
  void Load();
  [[nodiscard]] std::filesystem::path Picture(const std::string& id) const;
  [[nodiscard]] std::filesystem::path Words(const std::string& id) const;
  void RemoveFiles(const std::string& id) const;
  // Callers hold mutex_.
  void Note(Photo photo);
  bool Forget(const std::string& id);  // false if there is none

  const std::filesystem::path folder_;
  const std::uint64_t most_bytes_;
  const Write write_;
  mutable std::mutex mutex_;  // guards what follows
  std::map<std::string, Photo> photos_;
  std::map<std::uint64_t, std::string> order_;  // their ids, the first one kept first
  std::map<std::string, std::uint64_t> turns_;  // the key of each in that
  std::uint64_t next_turn_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace trailcast::photos
