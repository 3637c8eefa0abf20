#include "services/users/user_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "services/base/durable_file.h"

namespace trailcast::users {
namespace {

constexpr std::size_t kMostBytes = 1U << 20U;

// Locks a folder for one process at a time.
class Lock {
 public:
  explicit Lock(const std::filesystem::path& folder)
      : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    holds_ = descriptor_ >= 0 && flock(descriptor_, LOCK_EX) == 0;
  }
  ~Lock() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  [[nodiscard]] bool holds() const { return holds_; }

 private:
  int descriptor_;
  bool holds_ = false;
};

// Root adds users to a service's folder, and the service has to read them.
Result<void> GiveToOwner(const std::filesystem::path& file) {
  if (geteuid() != 0) return {};
  struct stat folder {};
  if (stat(FolderOf(file).c_str(), &folder) == 0 &&
      chown(file.c_str(), folder.st_uid, folder.st_gid) == 0) {
    return {};
  }
  const std::error_code error(errno, std::generic_category());
  return Fail(ErrorCode::kUnavailable, "cannot give {} to the owner of its folder: {}",
              file.string(), error.message());
}

}  // namespace

Result<Users> LoadUsers(const std::filesystem::path& file) {
  const auto text = ReadBoundedFile(file, kMostBytes);
  if (!text) return tl::unexpected(text.error());
  auto users = ParseUsers(*text);
  if (!users) return Wrap(users.error(), file.string());
  return users;
}

Result<void> ChangeUsers(const std::filesystem::path& file,
                         const std::function<Result<void>(Users&)>& change) {
  const Lock lock(FolderOf(file));
  if (!lock.holds()) {
    return Fail(ErrorCode::kUnavailable, "cannot write into the folder of {}", file.string());
  }
  Users users;
  if (std::filesystem::exists(file)) {
    auto loaded = LoadUsers(file);
    if (!loaded) return tl::unexpected(loaded.error());
    users = *std::move(loaded);
  }
  if (auto changed = change(users); !changed) return changed;
  if (users.size() > kMostUsers) {
    return Fail(ErrorCode::kInvalidArgument, "more than {} users are too many", kMostUsers);
  }
  if (auto written = ReplaceFile(file, TextOf(users), 0600); !written) return written;
  return GiveToOwner(file);
}

WatchedUsers::WatchedUsers(std::filesystem::path file, Users users)
    : file_(std::move(file)), users_(std::move(users)) {}

const Users& WatchedUsers::At(Time now, const std::function<void(const Error&)>& complain) {
  if (looked_at_ && now < *looked_at_ + kLookEvery) return users_;
  looked_at_ = now;
  std::string version = Version();
  if (version == version_) return users_;
  version_ = std::move(version);
  auto users = LoadUsers(file_);
  if (users) {
    users_ = *std::move(users);
  } else {
    complain(users.error());
  }
  return users_;
}

std::string WatchedUsers::Version() const {
  struct stat status {};
  if (stat(file_.c_str(), &status) != 0) return "none";
  return fmt::format("{}.{}.{}.{}", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                     status.st_mtim.tv_nsec);
}

}  // namespace trailcast::users
