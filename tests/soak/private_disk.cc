#include "tests/soak/private_disk.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mount.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace trailcast::soak {

PrivateDisk::PrivateDisk(std::filesystem::path folder) : folder_(std::move(folder)) {
  const auto check = [](int result, const char* doing) {
    if (result != 0) throw std::system_error(errno, std::generic_category(), doing);
  };
  std::filesystem::create_directories(folder_);
  check(unshare(CLONE_NEWNS), "making a mount namespace");
  check(mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr), "making mounts private");
  check(mount("tmpfs", folder_.c_str(), "tmpfs", 0, fmt::format("size={}m", kMegabytes).c_str()),
        "mounting the server's disk");
}

PrivateDisk::~PrivateDisk() { umount2(folder_.c_str(), MNT_DETACH); }

}  // namespace trailcast::soak
