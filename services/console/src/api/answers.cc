#include "services/console/src/api/answers.h"

#include "services/console/json.h"

namespace trailcast::console {

void Answer(httplib::Response& response, int status, const std::string& json) {
  response.status = status;
  response.set_header("Cache-Control", "no-store");
  response.set_content(json, "application/json; charset=utf-8");
}

void Refuse(httplib::Response& response, int status, const std::string& why) {
  if (status == 401) response.set_header("WWW-Authenticate", "Bearer");
  Answer(response, status, ErrorBody(why));
}

void Refuse(httplib::Response& response, const Error& error) {
  switch (error.code) {
    case ErrorCode::kInvalidArgument:
      return Refuse(response, 400, error.message);
    case ErrorCode::kNotFound:
      return Refuse(response, 404, error.message);
    case ErrorCode::kConflict:
      return Refuse(response, 409, error.message);
    case ErrorCode::kCorrupt:
      return Refuse(response, 422, error.message);
    default:
      return Refuse(response, 503, error.message);
  }
}

}  // namespace trailcast::console
