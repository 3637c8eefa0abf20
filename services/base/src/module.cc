#include "services/base/module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace trailcast {
namespace {

namespace fs = std::filesystem;

// Returns where the library is, or the path beside the program if it is nowhere.
fs::path Find(const std::string& library) {
  std::error_code error;
  const fs::path programs = fs::read_symlink("/proc/self/exe", error).parent_path();
  const char* const named = std::getenv("TRAILCAST_MODULES");  // NOLINT(concurrency-mt-unsafe)
  for (const fs::path& folder : {fs::path(named == nullptr ? "" : named), programs,
                                 programs.parent_path() / "lib" / "trailcast",
                                 fs::path(TRAILCAST_MODULES), fs::path("/usr/lib/trailcast")}) {
    if (!folder.empty() && fs::exists(folder / library, error)) return folder / library;
  }
  return programs / library;
}

}  // namespace

Result<void*> FindInModule(const std::string& library, const std::string& symbol) {
  const fs::path file = Find(library);
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const address = handle == nullptr ? nullptr : dlsym(handle, symbol.c_str());
  if (address != nullptr) return address;
  const char* const why = dlerror();  // NOLINT(concurrency-mt-unsafe): the thread's own in glibc
  return Fail(ErrorCode::kUnavailable, "{}", why == nullptr ? file.string() : why);
}

}  // namespace trailcast
