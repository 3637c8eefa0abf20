#include "services/lab/trial/align/src/feature_file.h"

#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <system_error>
#include <type_traits>

namespace trailcast::trial {
namespace {

static_assert(std::is_trivially_copyable_v<SceneFeature>);

// Repeats a call until everything is done, because the kernel may do a part at a time. Returns
// false if it fails.
template <typename Call>
bool All(std::size_t size, const Call& call) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t now = call(done, size - done);
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) return false;
    done += static_cast<std::size_t>(now);
  }
  return true;
}

std::string Why() { return std::generic_category().message(errno); }

}  // namespace

Result<FeatureFile> FeatureFile::Make() {
  std::FILE* const file = std::tmpfile();
  if (file == nullptr) {
    return Fail(ErrorCode::kUnavailable, "cannot make a temporary file: {}", Why());
  }
  return FeatureFile(file);
}

Result<void> FeatureFile::Append(const SceneFeatures& scene) {
  const auto* const bytes = reinterpret_cast<const char*>(scene.features.data());
  const std::size_t size = scene.features.size() * sizeof(SceneFeature);
  const bool written = All(size, [&](std::size_t done, std::size_t left) {
    return pwrite(fileno(file_.get()), bytes + done, left, end_ + static_cast<off_t>(done));
  });
  if (!written) {
    return Fail(ErrorCode::kUnavailable,
                "cannot keep the features of frame {} in the temporary folder: {}", places_.size(),
                Why());
  }
  places_.push_back({end_, scene.features.size(), scene.width_px});
  end_ += static_cast<std::int64_t>(size);
  return {};
}

Result<SceneFeatures> FeatureFile::Read(std::size_t index) const {
  const Place& place = places_[index];
  SceneFeatures scene{place.width_px, std::vector<SceneFeature>(place.count)};
  auto* const bytes = reinterpret_cast<char*>(scene.features.data());
  const bool read = All(place.count * sizeof(SceneFeature), [&](std::size_t done,
                                                                std::size_t left) {
    return pread(fileno(file_.get()), bytes + done, left, place.offset + static_cast<off_t>(done));
  });
  if (!read) {
    return Fail(ErrorCode::kUnavailable, "cannot read the temporary file of features: {}", Why());
  }
  return scene;
}

}  // namespace trailcast::trial
