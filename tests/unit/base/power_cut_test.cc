// This tests what a loss of power, or a call to the disk that fails, leaves of a file that is
// replaced. The program is linked so that ReplaceFile's calls come here (CMakeLists.txt).
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cstdarg>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "services/base/durable_file.h"
#include "tests/support/temp_dir.h"

namespace trailcast {
namespace {

namespace fs = std::filesystem;

enum class Fate : std::uint8_t { kPowerGoes, kCallFails };

// While this exists, it notes what the disk has of the files below a folder: what was synced, and
// what may have got there anyhow. One of the calls fails, or all from that one on.
class Platter {
 public:
  Platter(const fs::path& folder, Fate fate, int at_call)
      : folder_(folder.string()), fate_(fate), at_call_(at_call) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      std::ifstream stream(entry.path());
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      names_[entry.path().string()] = std::make_shared<Contents>(Contents{text, text});
    }
    synced_names_ = names_;
    current = this;
  }
  ~Platter() { current = nullptr; }
  Platter(const Platter&) = delete;
  Platter& operator=(const Platter&) = delete;

  // Returns whether its call has come.
  [[nodiscard]] bool struck() const { return calls_ > at_call_; }
  // Returns all that may be found of a file once the power is back: names and contents reach the
  // disk in any order, but for what was waited for. A file that is not there is found as "absent".
  [[nodiscard]] std::set<std::string> Found(const std::string& path) const {
    std::set<std::string> found;
    for (const auto& names : {names_, synced_names_}) {
      const auto at = names.find(path);
      if (at == names.end()) {
        found.insert("absent");
      } else {
        found.insert({at->second->written, at->second->synced});
      }
    }
    return found;
  }

  // Returns true if the call fails instead.
  bool Strikes() {
    const int call = calls_++;
    return call == at_call_ || (call > at_call_ && fate_ == Fate::kPowerGoes);
  }
  [[nodiscard]] bool IsHere(const std::string& path) const { return path.starts_with(folder_); }
  void Opened(int descriptor, const std::string& path, int flags) {
    if ((flags & O_CREAT) != 0) names_[path] = std::make_shared<Contents>();
    open_[descriptor] = path;
  }
  void Wrote(int descriptor, const std::string& text) {
    if (const auto at = open_.find(descriptor); at != open_.end()) {
      names_.at(at->second)->written += text;
    }
  }
  [[nodiscard]] bool Has(int descriptor) const { return open_.contains(descriptor); }
  void Synced(int descriptor) {
    const std::string& path = open_.at(descriptor);
    if (path == folder_) {
      synced_names_ = names_;
    } else {
      names_.at(path)->synced = names_.at(path)->written;
    }
  }
  void Renamed(const std::string& from, const std::string& to) {
    names_[to] = names_.at(from);
    names_.erase(from);
  }
  void Unlinked(const std::string& path) { names_.erase(path); }
  void Closed(int descriptor) { open_.erase(descriptor); }

  static Platter* current;

 private:
  struct Contents {
    std::string written{};
    std::string synced{};
  };
  const std::string folder_;
  const Fate fate_;
  const int at_call_;
  int calls_ = 0;
  std::map<std::string, std::shared_ptr<Contents>> names_;
  std::map<std::string, std::shared_ptr<Contents>> synced_names_;
  std::map<int, std::string> open_;
};

Platter* Platter::current = nullptr;

// Does a call to a path or a descriptor that is the platter's, or fails it.
template <typename Work>
int Try(bool is_ours, const Work& work) {
  if (is_ours && Platter::current->Strikes()) {
    errno = EIO;
    return -1;
  }
  return work();
}

bool IsOurs(const char* path) {
  return Platter::current != nullptr && Platter::current->IsHere(path);
}
bool IsOurs(int descriptor) {
  return Platter::current != nullptr && Platter::current->Has(descriptor);
}

}  // namespace
}  // namespace trailcast

extern "C" {
int __real_open(const char* path, int flags, ...);
ssize_t __real_write(int descriptor, const void* bytes, size_t size);
int __real_fsync(int descriptor);
int __real_rename(const char* from, const char* to);
int __real_unlink(const char* path);
int __real_close(int descriptor);

int __wrap_open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  const bool is_ours = trailcast::IsOurs(path);
  return trailcast::Try(is_ours, [&] {
    const int descriptor = __real_open(path, flags, mode);
    if (is_ours && descriptor >= 0) trailcast::Platter::current->Opened(descriptor, path, flags);
    return descriptor;
  });
}
ssize_t __wrap_write(int descriptor, const void* bytes, size_t size) {
  const bool is_ours = trailcast::IsOurs(descriptor);
  return trailcast::Try(is_ours, [&] {
    const auto written = static_cast<int>(__real_write(descriptor, bytes, size));
    if (is_ours && written > 0) {
      trailcast::Platter::current->Wrote(
          descriptor, {static_cast<const char*>(bytes), static_cast<size_t>(written)});
    }
    return written;
  });
}
int __wrap_fsync(int descriptor) {
  const bool is_ours = trailcast::IsOurs(descriptor);
  return trailcast::Try(is_ours, [&] {
    if (is_ours) trailcast::Platter::current->Synced(descriptor);
    return 0;
  });
}
int __wrap_rename(const char* from, const char* to) {
  const bool is_ours = trailcast::IsOurs(from);
  return trailcast::Try(is_ours, [&] {
    const int renamed = __real_rename(from, to);
    if (is_ours && renamed == 0) trailcast::Platter::current->Renamed(from, to);
    return renamed;
  });
}
int __wrap_unlink(const char* path) {
  const bool is_ours = trailcast::IsOurs(path);
  return trailcast::Try(is_ours, [&] {
    const int unlinked = __real_unlink(path);
    if (is_ours && unlinked == 0) trailcast::Platter::current->Unlinked(path);
    return unlinked;
  });
}
int __wrap_close(int descriptor) {
  if (trailcast::IsOurs(descriptor)) trailcast::Platter::current->Closed(descriptor);
  return __real_close(descriptor);
}
}

namespace trailcast {
namespace {

TEST(PowerCut, OfAFileThatIsReplacedTheOldOrTheNewIsThere) {
  for (const std::string old : {"old", "absent"}) {
    for (const Fate fate : {Fate::kPowerGoes, Fate::kCallFails}) {
      bool struck = true;
      int call = 0;
      for (; struck; ++call) {
        const test::TempDir folder;
        const fs::path file = folder / "alerts";
        if (old != "absent") std::ofstream(file) << old;
        SCOPED_TRACE(fmt::format("{}, {} at call {}", old,
                                 fate == Fate::kPowerGoes ? "power goes" : "fails", call));
        Platter platter(folder.path(), fate, call);
        const auto replaced = ReplaceFile(file, "new");
        struck = platter.struck();
        EXPECT_TRUE(replaced || struck);
        EXPECT_TRUE(replaced || replaced.error().message.find(file.string()) != std::string::npos);
        const auto found = platter.Found(file.string());
        if (replaced) {
          EXPECT_THAT(found, testing::ElementsAre("new"));
        } else {
          EXPECT_THAT(found, testing::IsSubsetOf({old, std::string("new")}));
        }
        if (fate == Fate::kPowerGoes || !struck) continue;
        ASSERT_TRUE(ReplaceFile(file, "newer")) << "the disk is well again";
        EXPECT_THAT(platter.Found(file.string()), testing::ElementsAre("newer"));
      }
      constexpr int kLeast = 7;  // makes, writes, syncs and renames it, and syncs its folder
      EXPECT_GT(call, kLeast) << "its calls do not come here";
    }
  }
}

}  // namespace
}  // namespace trailcast
