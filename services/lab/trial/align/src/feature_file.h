#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/align/src/scene_features.h"

namespace trailcast::trial {

// Keeps the features of many pictures in a private temporary file, which the destructor removes.
// The features of an hour's drive are gigabytes.
class FeatureFile {
 public:
  [[nodiscard]] static Result<FeatureFile> Make();

  // kUnavailable means that the disk is full.
  [[nodiscard]] Result<void> Append(const SceneFeatures& scene);
  [[nodiscard]] std::size_t size() const { return places_.size(); }
  // Several threads may read at once while none appends.
  [[nodiscard]] Result<SceneFeatures> Read(std::size_t index) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Place {
    std::int64_t offset = 0;
    std::size_t count = 0;
    int width_px = 0;
  };
  explicit FeatureFile(std::FILE* file) : file_(file) {}

  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t end_ = 0;
  std::vector<Place> places_;
};

}  // namespace trailcast::trial
