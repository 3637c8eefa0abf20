#include "services/base/text_file.h"

#include <array>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

namespace trailcast {

Result<std::string> PlainText(std::string bytes) {
  using namespace std::string_view_literals;
  const std::string_view view(bytes);
  if (view.starts_with("\xFF\xFE\0\0"sv) || view.starts_with("\0\0\xFE\xFF"sv)) {
    return Fail(ErrorCode::kInvalidArgument, "it is written in UTF-32: save it as UTF-8");
  }
  if (view.starts_with("\xFF\xFE") || view.starts_with("\xFE\xFF")) {
    return Fail(ErrorCode::kInvalidArgument,
                "it is written in UTF-16: save it as UTF-8 (spreadsheets call it 'CSV UTF-8')");
  }
  if (view.find('\0') != std::string_view::npos) {
    return Fail(ErrorCode::kInvalidArgument, "it is no text: expected a text file in UTF-8");
  }
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::string text;
  text.reserve(bytes.size());
  for (std::size_t i = view.starts_with(kMark) ? kMark.size() : 0; i < bytes.size(); ++i) {
    const bool ends_with_two = bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n';
    if (!ends_with_two) text += bytes[i] == '\r' ? '\n' : bytes[i];
  }
  return text;
}

Result<std::string> ReadTextFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    const int error = errno;
    return Fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnavailable,
                "cannot read {}: {}", file.string(), std::generic_category().message(error));
  }
  auto text = ReadText(stream);
  if (!text) return Wrap(text.error(), file.string());
  return text;
}

Result<std::string> ReadText(std::istream& stream) {
  std::string bytes;
  std::array<char, 1 << 16> part{};
  bool is_text = true;
  do {
    stream.read(part.data(), part.size());
    const std::string_view got(part.data(), static_cast<std::size_t>(stream.gcount()));
    bytes += got;
    is_text = got.find('\0') == std::string_view::npos;
  } while (stream && is_text);
  if (stream.bad()) {
    return Fail(ErrorCode::kUnavailable, "it cannot be read: is it a file, and its disk well?");
  }
  return PlainText(std::move(bytes));
}

std::optional<std::uint64_t> ReadNumber(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::uint64_t number = 0;
  if (stream >> number) return number;
  return std::nullopt;
}

Result<void> WriteTextFile(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) {
    return Fail(ErrorCode::kUnavailable,
                "cannot write {}: does its folder exist, and is there room on the disk?",
                file.string());
  }
  return {};
}

}  // namespace trailcast
