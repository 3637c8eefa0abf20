#include "services/photos/photo_folder.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

namespace trailcast::photos {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPictureEnding = ".jpg";
constexpr const char* kWordsEnding = ".photo";

}  // namespace

Result<std::unique_ptr<PhotoFolder>> PhotoFolder::Open(fs::path folder, std::uint64_t most_bytes,
                                                       Write write) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || ::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) {
    return Fail(ErrorCode::kUnavailable, "no photos are kept: nothing can be written in {}",
                folder.string());
  }
  std::unique_ptr<PhotoFolder> opened(
      new PhotoFolder(std::move(folder), most_bytes, std::move(write)));
  opened->Load();
  return opened;
}

fs::path PhotoFolder::Picture(const std::string& id) const {
  return folder_ / (id + kPictureEnding);
}

fs::path PhotoFolder::Words(const std::string& id) const { return folder_ / (id + kWordsEnding); }

void PhotoFolder::Load() {
  struct Found {
    fs::file_time_type written;
    Photo photo;
  };
  std::vector<Found> found;
  std::vector<std::string> pictures;
  std::error_code failed;
  for (fs::directory_iterator entry(folder_, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const fs::path& file = entry->path();
    const std::string id = file.stem().string();
    std::error_code gone;
    if (!IsPhotoId(id) || !fs::is_regular_file(entry->symlink_status(gone))) continue;
    if (file.extension() == kPictureEnding) pictures.push_back(id);
    if (file.extension() != kWordsEnding) continue;
    std::ifstream stream(file);
    std::string words;
    std::getline(stream, words);
    auto photo = ParsePhoto(words);
    if (!photo || photo->id != id || fs::file_size(Picture(id), gone) != photo->bytes) continue;
    const auto written = entry->last_write_time(gone);
    if (!gone) found.push_back({written, *std::move(photo)});
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::pair(a.written, a.photo.taken_unix_ms) <
           std::pair(b.written, b.photo.taken_unix_ms);
  });
  for (Found& each : found) Note(std::move(each.photo));
  for (const std::string& id : pictures) {
    std::error_code stays;
    if (!photos_.contains(id)) fs::remove(Picture(id), stays);
  }
}

void PhotoFolder::Note(Photo photo) {
  bytes_ += photo.bytes;
  turns_[photo.id] = next_turn_;
  order_[next_turn_++] = photo.id;
  photos_[photo.id] = std::move(photo);
}

bool PhotoFolder::Forget(const std::string& id) {
  const auto photo = photos_.find(id);
  if (photo == photos_.end()) return false;
  bytes_ -= photo->second.bytes;
  order_.erase(turns_.at(id));
  turns_.erase(id);
  photos_.erase(photo);
  return true;
}

// The words go first, so that a picture without them is known to be no photo any more.
void PhotoFolder::RemoveFiles(const std::string& id) const {
  std::error_code stays;
  fs::remove(Words(id), stays);
  fs::remove(Picture(id), stays);
}

Result<std::vector<Photo>> PhotoFolder::Add(const Photo& photo,
                                            std::span<const std::uint8_t> jpeg) {
  if (jpeg.size() > most_bytes_) {
    return Fail(ErrorCode::kUnavailable, "a photo of {} bytes is larger than all photos may be: {}",
                jpeg.size(), most_bytes_);
  }
  std::vector<Photo> gone;
  {
    const std::scoped_lock lock(mutex_);
    if (photos_.contains(photo.id)) return gone;
    while (!order_.empty() &&
           (bytes_ + jpeg.size() > most_bytes_ || photos_.size() >= kMostPhotos)) {
      gone.push_back(photos_.at(order_.begin()->second));
      Forget(gone.back().id);
    }
  }
  for (const Photo& each : gone) RemoveFiles(each.id);
  auto kept = write_(Picture(photo.id), {jpeg.begin(), jpeg.end()});
  if (kept) kept = write_(Words(photo.id), ToText(photo) + "\n");
  if (!kept) {
    RemoveFiles(photo.id);
    return tl::unexpected(kept.error());
  }
  const std::scoped_lock lock(mutex_);
  Note(photo);
  return gone;
}

std::vector<Photo> PhotoFolder::Find(const PhotoQuery& query) const {
  std::vector<Photo> found;
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& [id, photo] : photos_) {
      if (Matches(query, photo)) found.push_back(photo);
    }
  }
  std::sort(found.begin(), found.end(), [](const Photo& a, const Photo& b) {
    return std::pair(a.taken_unix_ms, a.id) > std::pair(b.taken_unix_ms, b.id);
  });
  return found;
}

std::optional<Photo> PhotoFolder::Get(const std::string& id) const {
  const std::scoped_lock lock(mutex_);
  const auto found = photos_.find(id);
  return found == photos_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Photo> PhotoFolder::First() const {
  const std::scoped_lock lock(mutex_);
  if (order_.empty()) return std::nullopt;
  return photos_.at(order_.begin()->second);
}

Result<std::vector<std::uint8_t>> PhotoFolder::Read(const std::string& id, std::uint32_t offset,
                                                    std::size_t most) const {
  const auto photo = Get(id);
  if (!photo) return Fail(ErrorCode::kNotFound, "there is no photo {} here, or no longer", id);
  std::vector<std::uint8_t> bytes(
      offset < photo->bytes ? std::min<std::size_t>(most, photo->bytes - offset) : 0);
  std::ifstream file(Picture(id), std::ios::binary);
  file.seekg(offset);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) {
    return Fail(ErrorCode::kUnavailable, "photo {} cannot be read from {}", id, folder_.string());
  }
  return bytes;
}

void PhotoFolder::Remove(const std::string& id) {
  const bool was_there = [&] {
    const std::scoped_lock lock(mutex_);
    return Forget(id);
  }();
  if (was_there) RemoveFiles(id);
}

std::size_t PhotoFolder::size() const {
  const std::scoped_lock lock(mutex_);
  return photos_.size();
}

std::uint64_t PhotoFolder::bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

}  // namespace trailcast::photos
