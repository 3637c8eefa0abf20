#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "services/base/result.h"

namespace trailcast::store {

// Puts another file in a store's place, in steps between which the process may be killed and the
// power may fail. Either the old store is there with its log, or the new one without that log,
// which would be applied to it. The caller holds the store's lock.
class Replacement {
 public:
  explicit Replacement(const std::filesystem::path& store);

  [[nodiscard]] const std::filesystem::path& made() const { return made_; }  // the new store
  // Returns the former file afterwards; its log has the same name with "-wal".
  [[nodiscard]] const std::filesystem::path& kept() const { return kept_; }

  using Step = std::function<Result<void>()>;
  // Returns the steps in the order in which they must be done.
  [[nodiscard]] std::vector<Step> steps() const;

  // Says whether a replacement was interrupted after the step from which on the new store counts.
  [[nodiscard]] bool IsBegun() const;
  [[nodiscard]] Result<void> Finish() const;

 private:
  [[nodiscard]] Result<void> Keep() const;
  [[nodiscard]] Result<void> Begin() const;
  [[nodiscard]] Result<void> DropLog() const;
  [[nodiscard]] Result<void> Put() const;
  [[nodiscard]] Result<void> Ended(const std::error_code& error) const;

  std::filesystem::path store_;
  std::filesystem::path made_;
  std::filesystem::path begun_;  // the new store's name once it counts
  std::filesystem::path kept_;
};

}  // namespace trailcast::store
