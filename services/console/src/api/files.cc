#include "services/console/src/api/files.h"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

// This embeds what the build puts into TRAILCAST_PAGE_DIR, byte for byte.
#define TRAILCAST_EMBED(name, file)            \
  asm(".pushsection .rodata\n"                 \
      ".global trailcast_" #name               \
      "\n"                                     \
      ".global trailcast_" #name               \
      "_end\n"                                 \
      "trailcast_" #name                       \
      ":\n"                                    \
      ".incbin \"" TRAILCAST_PAGE_DIR "/" file \
      "\"\n"                                   \
      "trailcast_" #name                       \
      "_end:\n"                                \
      ".popsection\n");                        \
  extern "C" const char trailcast_##name[];    \
  extern "C" const char trailcast_##name##_end[]

TRAILCAST_EMBED(html, "index.html");
TRAILCAST_EMBED(css, "page.css");
TRAILCAST_EMBED(icon, "icon.svg");
TRAILCAST_EMBED(openapi, "openapi.yaml");
TRAILCAST_EMBED(css_gz, "page.css.gz");
TRAILCAST_EMBED(openapi_gz, "openapi.yaml.gz");

#define CODE(number, file)             \
  TRAILCAST_EMBED(code##number, file); \
  TRAILCAST_EMBED(code##number##_gz, file ".gz");
#include TRAILCAST_PAGE_CODE
#undef CODE

namespace trailcast::console {
namespace {

// Returns the FNV-1a hash, in quotes.
std::string TagOf(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  }
  return fmt::format("\"{:016x}\"", hash);
}

std::string_view Between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

// `packed` is the same by gzip. It is empty if that is hardly shorter.
File MakeFile(const char* path, const char* type, std::string_view bytes,
              std::string_view packed = {}) {
  return {path, type, bytes, packed, TagOf(bytes)};
}

std::vector<File> MakeFiles() {
  std::vector files{
      MakeFile("/", "text/html; charset=utf-8", Between(trailcast_html, trailcast_html_end)),
      MakeFile("/page.css", "text/css; charset=utf-8", Between(trailcast_css, trailcast_css_end),
               Between(trailcast_css_gz, trailcast_css_gz_end)),
      MakeFile("/icon.svg", "image/svg+xml", Between(trailcast_icon, trailcast_icon_end)),
      MakeFile("/api/openapi.yaml", "application/yaml",
               Between(trailcast_openapi, trailcast_openapi_end),
               Between(trailcast_openapi_gz, trailcast_openapi_gz_end))};
#define CODE(number, file)                                                    \
  files.push_back(                                                            \
      MakeFile("/" file, "text/javascript; charset=utf-8",                    \
               Between(trailcast_code##number, trailcast_code##number##_end), \
               Between(trailcast_code##number##_gz, trailcast_code##number##_gz_end)));
#include TRAILCAST_PAGE_CODE
#undef CODE
  return files;
}

}  // namespace

std::span<const File> Files() {
  static const std::vector<File> files = MakeFiles();
  return files;
}

}  // namespace trailcast::console
