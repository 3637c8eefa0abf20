#include "services/lab/trial/align/align.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <iterator>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "services/base/guarded.h"
#include "services/image/files.h"
#include "services/lab/trial/align/src/alignment_path.h"
#include "services/lab/trial/align/src/camera_mask.h"
#include "services/lab/trial/align/src/feature_file.h"
#include "services/lab/trial/align/src/scene_match.h"
#include "services/lab/trial/recording/ordered_frames.h"

namespace trailcast::trial {
namespace {

// A long recording's pictures are compared so far from the last place held, counted in taught
// pictures.
constexpr int kBack = 6;
constexpr int kOn = 14;
constexpr int kLostAfter = 4;     // consecutive pictures that match nothing near
constexpr int kSearchStride = 4;  // step between the taught pictures in a search of the whole route

Error Ended() { return {ErrorCode::kUnavailable, "interrupted"}; }

// Calls `use` with every n-th frame of a recording. The next readable frame replaces one that
// cannot be read. Returns lines for people about the pictures.
Result<std::vector<std::string>> ForEvery(
    const std::filesystem::path& recording, int every,
    const std::function<Result<void>(const image::GrayImage&, int)>& use) {
  auto frames = image::FrameSequence::Open(recording);
  if (!frames) return tl::unexpected(frames.error());
  int due = 0;
  while (true) {
    const auto frame = (*frames)->Next();
    if (!frame) return tl::unexpected(frame.error());
    if (!*frame) return (*frames)->TakeNews();
    for (; due <= (*frames)->number(); due += every) {
      if (auto used = use(**frame, due); !used) return tl::unexpected(used.error());
    }
  }
}

struct Described {
  FeatureFile features;
  std::vector<std::string> news;
};
// Describes a recording, after a first pass that finds the parts of its pictures that show the
// camera's own robot.
Result<Described> Describe(const std::filesystem::path& recording, int every, const char* doing,
                           const AlignProgress& on_progress) {
  const auto count = CountFrames(recording);
  if (!count) return tl::unexpected(count.error());
  CameraMask mask;
  auto looked = ForEvery(recording, every, [&](const image::GrayImage& frame, int) -> Result<void> {
    mask.Add(frame);
    return {};
  });
  if (!looked) return tl::unexpected(looked.error());
  const image::GrayImage own = mask.Find();
  auto file = FeatureFile::Make();
  if (!file) return tl::unexpected(file.error());
  auto described =
      ForEvery(recording, every, [&](const image::GrayImage& frame, int number) -> Result<void> {
        if (!on_progress(doing, static_cast<double>(number) / *count)) {
          return tl::unexpected(Ended());
        }
        return file->Append(FindSceneFeatures(frame, own));
      });
  if (!described) return tl::unexpected(described.error());
  for (std::string& each : *described) each = fmt::format("{}: {}", recording.string(), each);
  return Described{std::move(*file), std::move(*described)};
}

class Aligner {
 public:
  Aligner(const FeatureFile& teach, const FeatureFile& replay, const AlignOptions& options)
      : teach_(teach), replay_(replay), options_(options) {}

  Result<Reference> Run(const AlignProgress& on_progress) {
    for (std::size_t row = 0; row < replay_.size(); ++row) {
      const double share = static_cast<double>(row) / static_cast<double>(replay_.size());
      if (!on_progress("comparing", share)) return tl::unexpected(Ended());
      auto scene = replay_.Read(row);
      if (!scene) return tl::unexpected(scene.error());
      if (auto compared = Compare(*scene); !compared) return tl::unexpected(compared.error());
    }
    return Tell();
  }

 private:
  [[nodiscard]] int taught() const { return static_cast<int>(teach_.size()); }
  [[nodiscard]] bool small() const { return teach_.size() * replay_.size() <= options_.most_pairs; }

  Result<void> Compare(const SceneFeatures& scene) {
    std::vector<int> near = Stretch(0, taught(), 1);
    if (!small()) {
      near = path_begun_ ? Stretch(path_.Best().teach - kBack, path_.Best().teach + kOn + 1, 1)
                         : std::vector<int>();
    }
    auto candidates = Match(scene, near);
    if (!candidates) return tl::unexpected(candidates.error());
    const int best = Most(*candidates);
    unheld_ = best >= options_.good_inliers ? 0 : unheld_ + 1;
    if (!small() && (!path_begun_ || unheld_ % kLostAfter == kLostAfter - 1)) {
      if (auto searched = SearchAll(scene, *candidates); !searched) return searched;
    }
    path_.Add(*candidates);
    path_begun_ = true;
    return {};
  }

  // Adds candidates from all over the route, and everything beside the best of them.
  Result<void> SearchAll(const SceneFeatures& scene, std::vector<Candidate>& candidates) {
    auto far = Match(scene, Stretch(0, taught(), kSearchStride));
    if (!far) return tl::unexpected(far.error());
    const auto best = std::max_element(
        far->begin(), far->end(),
        [](const Candidate& a, const Candidate& b) { return a.inliers < b.inliers; });
    auto beside =
        Match(scene, Stretch(best->teach - kSearchStride + 1, best->teach + kSearchStride, 1));
    if (!beside) return tl::unexpected(beside.error());
    candidates.insert(candidates.end(), far->begin(), far->end());
    candidates.insert(candidates.end(), beside->begin(), beside->end());
    return {};
  }

  [[nodiscard]] std::vector<int> Stretch(int from, int to, int stride) const {
    std::vector<int> numbers;
    for (int i = std::max(0, from); i < std::min(to, taught()); i += stride) numbers.push_back(i);
    return numbers;
  }

  static int Most(const std::vector<Candidate>& candidates) {
    int most = 0;
    for (const Candidate& candidate : candidates) most = std::max(most, candidate.inliers);
    return most;
  }

  // Compares with these pictures, on all threads.
  Result<std::vector<Candidate>> Match(const SceneFeatures& scene, const std::vector<int>& with) {
    std::vector<Candidate> candidates(with.size());
    std::atomic<std::size_t> next{0};
    std::vector<Result<void>> ended(static_cast<std::size_t>(std::max(1, options_.jobs)));
    const auto work = [&](Result<void>& end) {
      end = Guarded("a thread that compares pictures", [&]() -> Result<void> {
        for (std::size_t i = next++; i < with.size(); i = next++) {
          const auto taught_scene = teach_.Read(static_cast<std::size_t>(with[i]));
          if (!taught_scene) {
            return Fail(ErrorCode::kUnavailable, "cannot read the temporary file of features");
          }
          candidates[i] = {with[i], MatchScenes(*taught_scene, scene).inliers};
        }
        return {};
      });
      if (!end) next = with.size();  // this ends the others, too
    };
    {
      std::vector<std::jthread> threads;
      for (std::size_t i = 1; i < ended.size(); ++i) threads.emplace_back(work, std::ref(ended[i]));
      work(ended.front());
    }
    for (const Result<void>& end : ended) {
      if (!end) return tl::unexpected(end.error());
    }
    return candidates;
  }

  // Returns the best path, and how far aside features are along it.
  Result<Reference> Tell() const {
    Reference reference;
    const std::vector<Candidate> trace = path_.Trace();
    for (std::size_t row = 0; row < trace.size(); ++row) {
      const auto taught_scene = teach_.Read(static_cast<std::size_t>(trace[row].teach));
      const auto scene = replay_.Read(row);
      if (!taught_scene || !scene) {
        return tl::unexpected(taught_scene ? scene.error() : taught_scene.error());
      }
      const SceneMatch match = MatchScenes(*taught_scene, *scene);
      reference.push_back({static_cast<int>(row) * options_.every,
                           trace[row].teach * options_.teach_every, match.inliers,
                           match.median_du_px, match.inliers >= options_.good_inliers});
    }
    return reference;
  }

  const FeatureFile& teach_;
  const FeatureFile& replay_;
  const AlignOptions& options_;
  AlignmentPath path_;
  bool path_begun_ = false;
  int unheld_ = 0;  // consecutive pictures that matched nothing near
};

}  // namespace

Result<Aligned> Align(const std::filesystem::path& teach, const std::filesystem::path& replay,
                      const AlignOptions& options, const AlignProgress& on_progress) {
  auto taught = Describe(teach, options.teach_every, "looking at the taught one", on_progress);
  if (!taught) return tl::unexpected(taught.error());
  auto replayed = Describe(replay, options.every, "looking at the replayed one", on_progress);
  if (!replayed) return tl::unexpected(replayed.error());
  if (taught->features.size() == 0 || replayed->features.size() == 0) {
    return Fail(ErrorCode::kInvalidArgument, "there is no frame to align");
  }
  auto reference = Aligner(taught->features, replayed->features, options).Run(on_progress);
  if (!reference) return tl::unexpected(reference.error());
  std::vector<std::string> news = std::move(taught->news);
  std::move(replayed->news.begin(), replayed->news.end(), std::back_inserter(news));
  return Aligned{std::move(*reference), std::move(news)};
}

}  // namespace trailcast::trial
