#include "services/console/src/api/incoming_file.h"

#include <fstream>

#include "services/base/guarded.h"

namespace trailcast::console {

Result<void> ReceiveInto(const std::filesystem::path& path, const std::string& called, Desk& desk,
                         const httplib::ContentReader& read) {
  return Guarded("an upload", [&]() -> Result<void> {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    const bool came = read([&](const char* data, std::size_t size) {
      return !desk.closed() && file.write(data, static_cast<std::streamsize>(size));
    });
    file.close();
    if (!file) return Fail(ErrorCode::kUnavailable, "there is no room for the {} here", called);
    if (!came) return Fail(ErrorCode::kInvalidArgument, "the {} did not come whole", called);
    return {};
  });
}

}  // namespace trailcast::console
