#include "services/archive/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace trailcast::archive {
namespace {

std::string Reason(int error) { return std::generic_category().message(error); }

class FileSource final : public ByteSource {
 public:
  FileSource(std::string name, int descriptor) : name_(std::move(name)), descriptor_(descriptor) {}
  ~FileSource() override { close(descriptor_); }

  Result<void> Measure() {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) {
      return Fail(ErrorCode::kUnavailable, "cannot read {}: {}", name_, Reason(errno));
    }
    if (!S_ISREG(status.st_mode)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "{} is a folder, a pipe or a device, expected a file", name_);
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
    return {};
  }

  const std::string& name() const override { return name_; }
  std::uint64_t size() const override { return size_; }

  Result<void> Read(std::uint64_t offset, std::span<std::uint8_t> out) const override {
    while (!out.empty()) {
      const ssize_t got = pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return Fail(ErrorCode::kUnavailable, "cannot read {}: {}", name_, Reason(errno));
      if (got == 0) {
        return Fail(ErrorCode::kUnavailable, "{} became shorter while it was read", name_);
      }
      offset += static_cast<std::uint64_t>(got);
      out = out.subspan(static_cast<std::size_t>(got));
    }
    return {};
  }

 private:
  std::string name_;
  int descriptor_;
  std::uint64_t size_ = 0;
};

class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  const std::string& name() const override { return name_; }
  std::uint64_t size() const override { return bytes_.size(); }

  Result<void> Read(std::uint64_t offset, std::span<std::uint8_t> out) const override {
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
    return {};
  }

 private:
  std::string name_ = "route file in memory";
  std::span<const std::uint8_t> bytes_;
};

}  // namespace

Result<std::unique_ptr<ByteSource>> OpenFile(const std::filesystem::path& path) {
  // Without O_NONBLOCK, opening a pipe that nobody writes would block.
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    const int error = errno;
    return Fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnavailable,
                "cannot open {}: {}", path.string(), Reason(error));
  }
  auto file = std::make_unique<FileSource>(path.string(), descriptor);
  if (auto measured = file->Measure(); !measured) return tl::unexpected(measured.error());
  return file;
}

std::unique_ptr<ByteSource> FromMemory(std::span<const std::uint8_t> bytes) {
  return std::make_unique<MemorySource>(bytes);
}

}  // namespace trailcast::archive
