#pragma once

#include <filesystem>
#include <string>

#include "services/base/result.h"
#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Writes a request's body into a file piece by piece, because it may be larger than this program's
// memory. It throws nothing, so that a caller that holds a place for the file can give it back.
// Errors call the file `called`: kInvalidArgument when it did not arrive whole, and kUnavailable
// when there is no room for it.
[[nodiscard]] Result<void> ReceiveInto(const std::filesystem::path& path, const std::string& called,
                                       Desk& desk, const httplib::ContentReader& read);

}  // namespace trailcast::console
