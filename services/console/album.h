#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/base/result.h"
#include "services/console/desk.h"
#include "services/fleet/photo_client.h"
#include "services/image/image.h"
#include "services/photos/compare.h"
#include "services/photos/photo.h"

namespace trailcast::console {

// These are the photos that robots took on missions, as all route servers keep them. It keeps what
// was looked at last, because a page asks for the same photos again and again.
// It may be used from any thread.
class Album {
 public:
  static constexpr std::size_t kMostBytes = 64U << 20U;  // of pictures that it keeps
  static constexpr std::size_t kMostKnown = 20'000;
  static constexpr std::size_t kMostCompared = 8;
  static constexpr std::size_t kMostListed = 20'000;
  static constexpr std::size_t kMostAPage = 200;
  // So many callers may wait for a picture, or for a comparison. More are refused.
  static constexpr int kMostWaiting = 12;

  explicit Album(Desk& desk) : desk_(desk) {}

  struct Page {
    std::vector<fleet::KnownPhoto> photos{};  // the last taken first
    std::uint32_t next = 0;                   // of the next page; 0 if there is none
    std::vector<AgentId> silent{};            // servers whose photos are not among them
  };
  // Returns at most so many photos, without the `first` of all. Fails with kInvalidArgument beyond
  // kMostListed.
  [[nodiscard]] Result<Page> List(const photos::PhotoQuery& query, std::uint32_t first,
                                  std::size_t most = kMostAPage);
  // Says of a page with `silent` servers which these are.
  [[nodiscard]] static std::string SilentText(const Page& page);
  // Fails with kNotFound if no server has such a photo.
  [[nodiscard]] Result<fleet::KnownPhoto> Find(const std::string& id);
  // Returns the other photos of its spot, the last taken first.
  [[nodiscard]] Result<std::vector<fleet::KnownPhoto>> Visits(const fleet::KnownPhoto& of);

  using Jpeg = std::shared_ptr<const std::vector<std::uint8_t>>;
  [[nodiscard]] Result<Jpeg> Picture(const fleet::KnownPhoto& known);

  // This is an earlier photo, laid over a later one, and what has changed since.
  struct Changes {
    photos::Comparison comparison{};
    Jpeg earlier{};
  };
  // Fails with kConflict, and says why, if the two do not align.
  [[nodiscard]] Result<std::shared_ptr<const Changes>> Compare(const fleet::KnownPhoto& earlier,
                                                               const fleet::KnownPhoto& later);

 private:
  using Compared = Result<std::shared_ptr<const Changes>>;

  struct Gathered {
    std::vector<fleet::KnownPhoto> photos{};  // the last taken first
    bool more = false;                        // a server has more
    std::set<AgentId> silent{};
  };
  // Returns the last `enough` photos of each server, or all that it has.
  [[nodiscard]] Result<Gathered> Gather(const photos::PhotoQuery& query, std::size_t enough);
  [[nodiscard]] Compared Work(const fleet::KnownPhoto& earlier, const fleet::KnownPhoto& later);

  Desk& desk_;
  std::mutex mutex_;  // guards what follows
  int waiting_ = 0;
  NewestMap<std::string, fleet::KnownPhoto> known_{kMostKnown};
  std::deque<std::pair<std::string, Jpeg>> pictures_;  // the last used last
  std::size_t bytes_ = 0;
  NewestMap<std::string, std::optional<Compared>> compared_{kMostCompared};
  std::mutex comparing_;  // one comparison at a time
};

}  // namespace trailcast::console
