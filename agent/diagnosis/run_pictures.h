#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "agent/diagnosis/seen_features.h"
#include "services/bag/bag.h"
#include "services/base/result.h"

namespace trailcast::agent {

// Finds the pictures of a replay's log by the times of frames. It is not thread-safe.
class RunPictures {
 public:
  // Larger pictures are not returned.
  static constexpr std::size_t kMostPictureBytes = 4U << 20U;

  // Errors: the file is no MCAP file, or has no pictures and features.
  [[nodiscard]] static Result<std::unique_ptr<RunPictures>> Open(const std::filesystem::path& file);

  // Returns the features of the frame of that time, if the log has any.
  [[nodiscard]] Result<std::vector<SeenFeature>> FeaturesAt(double t_s);
  struct Picture {
    double t_s = 0.0;  // of its frame
    std::vector<std::uint8_t> jpeg;
  };
  // Returns the last picture up to that time.
  [[nodiscard]] Result<std::optional<Picture>> PictureUntil(double t_s);

 private:
  explicit RunPictures(std::unique_ptr<bag::Bag> bag);
  [[nodiscard]] Result<std::optional<bag::Message>> NextUntil(std::chrono::nanoseconds until);

  std::unique_ptr<bag::Bag> bag_;
  const bag::Topic* pictures_ = nullptr;
  const bag::Topic* features_ = nullptr;
};

}  // namespace trailcast::agent
