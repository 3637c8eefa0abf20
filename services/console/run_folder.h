#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::console {

// This is a file as it was when it was read.
struct RunFile {
  std::string id;    // 16 hexadecimal digits, made of its name
  std::string name;  // below the folder
  std::uint64_t bytes = 0;
  std::int64_t written_unix_ms = 0;

  bool operator==(const RunFile&) const = default;
};

// This is a file that is open for reading, with the name that this process has for it.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  OpenFile(OpenFile&& other) noexcept;
  OpenFile& operator=(OpenFile&&) = delete;
  ~OpenFile();
  [[nodiscard]] std::filesystem::path path() const;

 private:
  int descriptor_;
};

// This finds the files of a folder, and of folders in it, that may be logs of runs. It follows no
// links, so whoever may write there, the files that it opens do lie there.
class RunFolder {
 public:
  static constexpr std::size_t kMostFiles = 5000;  // the newest
  static constexpr int kDeepest = 2;               // nested folders

  explicit RunFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Returns the files, the newest first. Fails with kUnavailable if the folder cannot be read.
  [[nodiscard]] Result<std::vector<RunFile>> Scan() const;
  // Fails with kNotFound if the file no longer exists, or is no plain file.
  [[nodiscard]] Result<OpenFile> Open(const RunFile& file) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace trailcast::console
