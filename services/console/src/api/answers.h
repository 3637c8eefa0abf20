#pragma once

#include <string>

#include "services/base/result.h"
#include "services/http/server.h"

namespace trailcast::console {

void Answer(httplib::Response& response, int status, const std::string& json);
void Refuse(httplib::Response& response, int status, const std::string& why);
// Refuses with the status for the kind of error.
void Refuse(httplib::Response& response, const Error& error);

}  // namespace trailcast::console
