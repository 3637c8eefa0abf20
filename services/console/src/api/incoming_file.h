#pragma once

#include <filesystem>
#include <string>

#include "services/base/result.h"
#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Writes a request's body into a file piece by piece: it may be larger than what this program may
// have of memory. Throws nothing, so that whoever holds a place for the file can give it back.
// Errors call the file what `called` says: kInvalidArgument when it did not come whole,
// kUnavailable when there is no room for it.
[[nodiscard]] Result<void> ReceiveInto(const std::filesystem::path& path, const std::string& called,
                                       Desk& desk, const httplib::ContentReader& read);

}  // namespace trailcast::console
