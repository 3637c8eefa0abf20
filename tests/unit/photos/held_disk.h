#pragma once

#include <future>
#include <string>

#include "services/photos/photo_folder.h"

namespace trailcast::photos {

// A disk on which nothing is written before the test lets it be.
class HeldDisk {
 public:
  [[nodiscard]] PhotoFolder::Write Write() const {
    return [lets = lets_](const std::filesystem::path& file, const std::string& text) {
      lets.wait();
      return ReplaceFile(file, text);
    };
  }
  void Let() { let_.set_value(); }

 private:
  std::promise<void> let_;
  std::shared_future<void> lets_ = let_.get_future().share();
};

}  // namespace trailcast::photos
