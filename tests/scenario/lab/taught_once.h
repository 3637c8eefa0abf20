#pragma once

#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>
#include <system_error>

#include "tests/support/places.h"

namespace trailcast::test {

// This is a scout's store that several tests, each a process of its own, begin with. It is kept in
// the build's folder for as long as the programs that taught it are those of this build.
class TaughtOnce {
 public:
  // `what` was taught, in words. As long as they are the same, the store is.
  explicit TaughtOnce(const std::string& what) : file_(Folder() / (Hash(what) + ".db")) {}

  // Returns false if that has not been taught yet.
  [[nodiscard]] bool CopyTo(const std::filesystem::path& store) const {
    std::error_code failed;
    return std::filesystem::copy_file(file_, store,
                                      std::filesystem::copy_options::overwrite_existing, failed);
  }
  // Keeps the store of an agent that has ended. Two tests that have taught the same keep the same.
  void Keep(const std::filesystem::path& store) const {
    if (std::filesystem::exists(store.string() + "-wal")) return;
    if (!std::filesystem::exists(Folder())) {
      std::filesystem::remove_all(Folder().parent_path());  // what earlier programs have taught
      std::filesystem::create_directories(Folder());
    }
    const std::string mine = file_.string() + "." + std::to_string(getpid());
    std::filesystem::copy_file(store, mine);
    std::filesystem::rename(mine, file_);
  }

 private:
  static std::string Hash(const std::string& text) {
    return std::to_string(std::hash<std::string>{}(text));
  }
  static std::filesystem::path Folder() {
    const std::filesystem::path programs(ProgramsDir());
    std::string builds;
    for (const char* file : {"trailcast", "trailcast-agent", "libtrailcast_simulated.so"}) {
      const auto built = std::filesystem::last_write_time(programs / file).time_since_epoch();
      builds += std::to_string(built.count()) + " ";
    }
    return programs.parent_path() / "taught" / Hash(builds);
  }

  std::filesystem::path file_;
};

}  // namespace trailcast::test
