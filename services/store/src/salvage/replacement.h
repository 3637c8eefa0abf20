#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "services/base/result.h"

namespace trailcast::store {

// Another file in a store's place, in steps between any two of which the process may be killed and
// the disk's power fail: then the old store is there with its log, or the new one without that log,
// which would be applied to it. The store's lock is held by the caller.
class Replacement {
 public:
  explicit Replacement(const std::filesystem::path& store);

  [[nodiscard]] const std::filesystem::path& made() const { return made_; }  // the new store
  // What was there before, afterwards; its log has the same name with "-wal".
  [[nodiscard]] const std::filesystem::path& kept() const { return kept_; }

  using Step = std::function<Result<void>()>;
  // To be done in this order.
  [[nodiscard]] std::vector<Step> steps() const;

  // One that was interrupted after the step from which on the new store counts. False: there is
  // none.
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
