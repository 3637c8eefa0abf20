#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"

// This library reads drives that a robot's own tools recorded: one or a folder of rosbag2's SQLite
// files (.db3) or MCAP files, compressed or not. It needs no ROS.
namespace trailcast::bag {

struct Topic {
  std::string name;      // "/camera/image_raw"
  std::string type;      // "sensor_msgs/msg/Image"
  std::string encoding;  // of its messages: "cdr" on ROS 2
  std::uint64_t messages = 0;
};

struct Message {
  std::chrono::nanoseconds logged_at{};  // by the recorder's clock
  std::span<const std::uint8_t> bytes;   // valid until the next message is asked for
};

// Reads one topic at a time, as often as wanted. It passes over damage and notes it, so that a file
// that was cut off or has bad bytes still gives all that is whole.
class Bag {
 public:
  // Called with what takes a while: unpacking a file, or reading one that has no list of contents.
  using Tell = std::function<void(const std::string& what)>;

  // Errors: kNotFound if there is no such recording, kInvalidArgument if it has none of these
  // formats. `most_growth` bounds how much of an MCAP's chunks each reading unpacks: that many
  // times the file's size, and kFreeBytes. Anything beyond counts as damage. Without it there is no
  // bound.
  [[nodiscard]] static Result<std::unique_ptr<Bag>> Open(
      const std::filesystem::path& file_or_folder, const Tell& tell,
      std::optional<std::uint64_t> most_growth = std::nullopt);
  static constexpr std::uint64_t kFreeBytes = std::uint64_t{64} << 20U;
  ~Bag();
  Bag(const Bag&) = delete;
  Bag& operator=(const Bag&) = delete;

  // The topics in the order of their names. Two types under one name are two topics.
  [[nodiscard]] const std::vector<Topic>& topics() const { return topics_; }

  // Makes Next give that topic's messages, from the first that was recorded at `from` or later.
  // Earlier ones are not unpacked.
  void Begin(const Topic& topic, std::chrono::nanoseconds from = {});
  // Returns messages in the order in which they were recorded, and nothing at the end. A file that
  // cannot be read any more is an error.
  [[nodiscard]] Result<std::optional<Message>> Next();

  // Returns when the last message of all topics was recorded.
  [[nodiscard]] std::chrono::nanoseconds last_at() const;

  // Returns the damage found so far, and differences from a folder's metadata.yaml, as lines with
  // file, place and finding. There are at most kMostDamage of them.
  [[nodiscard]] const std::vector<std::string>& damage() const { return damage_; }
  static constexpr std::size_t kMostDamage = 20;

 private:
  struct Part;
  Bag();
  Result<std::filesystem::path> Unpack(Part& part, const Tell& tell);
  Result<std::filesystem::path> CutToPages(Part& part, const std::filesystem::path& plain,
                                           const Tell& tell);
  static Result<std::filesystem::path> InScratch(Part& part, const std::filesystem::path& name);
  Result<void> Add(const std::filesystem::path& file, const Tell& tell,
                   std::optional<std::uint64_t> most_growth);
  void Collect();
  void NoteDamage(Part& part);
  void Note(std::string line);

  std::vector<Part> parts_;  // by the time of their first message
  std::vector<Topic> topics_;
  std::vector<std::string> damage_;
  std::size_t current_ = 0;
};

}  // namespace trailcast::bag
