#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::console {

// A file as it was when it was looked at.
struct RunFile {
  std::string id;    // 16 hexadecimal digits, made of its name
  std::string name;  // beneath the folder
  std::uint64_t bytes = 0;
  std::int64_t written_unix_ms = 0;

  bool operator==(const RunFile&) const = default;
};

// A file that is open to be read, by the name that this process has for it.
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

// The files of a folder, and of folders in it, that may be logs of runs. What it hands out lies
// there in truth: no link is followed, whoever may write there.
class RunFolder {
 public:
  static constexpr std::size_t kMostFiles = 5000;  // the newest
  static constexpr int kDeepest = 2;               // folders in one another

  explicit RunFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // The newest first. kUnavailable: the folder cannot be read.
  [[nodiscard]] Result<std::vector<RunFile>> Scan() const;
  // kNotFound: it is there no more, or no plain file.
  [[nodiscard]] Result<OpenFile> Open(const RunFile& file) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace trailcast::console
