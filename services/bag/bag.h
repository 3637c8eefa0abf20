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

// Drives that a robot's own tools recorded: rosbag2's SQLite files (.db3) and MCAP files, one or a
// folder of them, as they are or compressed. Read with no ROS installed.
namespace trailcast::bag {

struct Topic {
  std::string name;      // "/camera/image_raw"
  std::string type;      // "sensor_msgs/msg/Image"
  std::string encoding;  // of its messages: "cdr" on ROS 2
  std::uint64_t messages = 0;
};

struct Message {
  std::chrono::nanoseconds logged_at{};  // by the recorder's clock
  std::span<const std::uint8_t> bytes;   // until the next message is asked for
};

// One topic at a time is read, as often as wanted. What is damaged is passed over and noted, so
// that a file that was cut off, or has bad bytes in it, gives what is whole.
class Bag {
 public:
  // Told what takes a while: files that are unpacked first, files without a list of contents.
  using Tell = std::function<void(const std::string& what)>;

  // kNotFound, kInvalidArgument: there is no such recording, or none of these formats.
  // `most_growth`: of an MCAP's chunks no more is unpacked, each time it is read, than that many
  // times its size and kFreeBytes; what more there is counts as damage. Nothing: any amount.
  [[nodiscard]] static Result<std::unique_ptr<Bag>> Open(
      const std::filesystem::path& file_or_folder, const Tell& tell,
      std::optional<std::uint64_t> most_growth = std::nullopt);
  static constexpr std::uint64_t kFreeBytes = std::uint64_t{64} << 20U;
  ~Bag();
  Bag(const Bag&) = delete;
  Bag& operator=(const Bag&) = delete;

  // In the order of their names. Two types under one name are two topics.
  [[nodiscard]] const std::vector<Topic>& topics() const { return topics_; }

  // From now on Next gives that topic's messages, from the first that was recorded then or later;
  // what lies before is not unpacked.
  void Begin(const Topic& topic, std::chrono::nanoseconds from = {});
  // In the order in which they were recorded; nothing at the end. An error: a file that cannot be
  // read any more.
  [[nodiscard]] Result<std::optional<Message>> Next();

  // When the last message of all was recorded.
  [[nodiscard]] std::chrono::nanoseconds last_at() const;

  // What was found damaged so far, or otherwise than a folder's metadata.yaml has it, a line each:
  // file, place, what. At most kMostDamage of them.
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
