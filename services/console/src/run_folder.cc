#include "services/console/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "services/base/hex.h"
#include "services/route/digest.h"

namespace trailcast::console {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostEntries = 100'000;

std::string IdOf(const std::string& name) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(name.data());
  const auto digest = route::Sha256({bytes, name.size()});
  constexpr std::size_t kBytes = 8;
  return ToHex(std::span(digest).first(kBytes));
}

}  // namespace

OpenFile::OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) (void)::close(descriptor_);
}

fs::path OpenFile::path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

Result<std::vector<RunFile>> RunFolder::Scan() const {
  std::vector<RunFile> files;
  std::error_code failed;
  fs::recursive_directory_iterator entry(folder_, fs::directory_options::skip_permission_denied,
                                         failed);
  if (failed) {
    return Fail(ErrorCode::kUnavailable, "the folder of runs' logs cannot be read: {}",
                failed.message());
  }
  std::size_t seen = 0;
  for (const fs::recursive_directory_iterator end; entry != end && seen < kMostEntries; ++seen) {
    struct stat found {};
    const bool there = ::lstat(entry->path().c_str(), &found) == 0;
    if (there && S_ISREG(found.st_mode) && entry->path().extension() == ".mcap") {
      const std::string name = entry->path().lexically_relative(folder_).string();
      files.push_back({IdOf(name), name, static_cast<std::uint64_t>(found.st_size),
                       std::int64_t{found.st_mtim.tv_sec} * 1000 +
                           std::int64_t{found.st_mtim.tv_nsec} / 1'000'000});
    }
    if (entry.depth() >= kDeepest) entry.disable_recursion_pending();
    entry.increment(failed);
    if (failed) break;
  }
  std::sort(files.begin(), files.end(), [](const RunFile& one, const RunFile& other) {
    return std::tie(other.written_unix_ms, one.name) < std::tie(one.written_unix_ms, other.name);
  });
  files.resize(std::min(files.size(), kMostFiles));
  return files;
}

// Opens the path part by part, because none of its parts may be a link by now.
Result<OpenFile> RunFolder::Open(const RunFile& file) const {
  const auto gone = [] { return Fail(ErrorCode::kNotFound, "this log is there no more"); };
  int at = ::open(folder_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  const fs::path name(file.name);
  for (const fs::path& part : name.parent_path()) {
    const int next = ::openat(at, part.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    (void)::close(at);
    at = next;
  }
  OpenFile opened(
      ::openat(at, name.filename().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (at >= 0) (void)::close(at);
  struct stat found {};
  if (::stat(opened.path().c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return gone();
  return opened;
}

}  // namespace trailcast::console
