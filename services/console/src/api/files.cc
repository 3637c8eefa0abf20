#include "services/console/src/api/files.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

// What the build puts into TRAILCAST_PAGE_DIR, byte for byte.
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
TRAILCAST_EMBED(js, "page.js");
TRAILCAST_EMBED(css, "page.css");
TRAILCAST_EMBED(icon, "icon.svg");
TRAILCAST_EMBED(openapi, "openapi.yaml");

namespace trailcast::console {
namespace {

// FNV-1a.
std::string TagOf(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  }
  return fmt::format("\"{:016x}\"", hash);
}

File MakeFile(const char* path, const char* type, const char* begin, const char* end) {
  const std::string_view bytes(begin, static_cast<std::size_t>(end - begin));
  return {path, type, bytes, TagOf(bytes)};
}

}  // namespace

std::span<const File> Files() {
  static const std::array kFiles{
      MakeFile("/", "text/html; charset=utf-8", trailcast_html, trailcast_html_end),
      MakeFile("/page.js", "text/javascript; charset=utf-8", trailcast_js, trailcast_js_end),
      MakeFile("/page.css", "text/css; charset=utf-8", trailcast_css, trailcast_css_end),
      MakeFile("/icon.svg", "image/svg+xml", trailcast_icon, trailcast_icon_end),
      MakeFile("/api/openapi.yaml", "application/yaml", trailcast_openapi, trailcast_openapi_end)};
  return kFiles;
}

}  // namespace trailcast::console
