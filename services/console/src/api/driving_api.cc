#include "services/console/src/api/driving_api.h"

#include <fmt/format.h>

#include <chrono>

#include "services/console/json.h"
#include "services/console/src/api/answers.h"
#include "services/program/json.h"

namespace trailcast::console {

void ServeDriving(http::Server& server, Desk& desk) {
  server.Post("/api/robots/([A-Za-z0-9_.-]{1,64})/drive",
              [&desk](const httplib::Request& request, httplib::Response& response) {
                const std::string robot = request.matches[1];
                const auto word = ReadDrive(request.body);
                if (!word) return Refuse(response, 400, word.error().message);
                using Verdict = Driving::Verdict;
                switch (desk.Drive(AgentId(robot), *word)) {
                  case Verdict::kGood:
                    return Answer(response, 200, program::OneLine({{"passed_on", true}}));
                  case Verdict::kTaken:
                    return Refuse(response, 409,
                                  "somebody else drives " + robot +
                                      ": it is free a second after that one lets go");
                  case Verdict::kUnknown:
                    return Refuse(response, 404,
                                  fmt::format("no robot '{}' is heard: it is not driven", robot));
                  case Verdict::kTeachesNothing:
                    return Refuse(response, 409,
                                  fmt::format("{} teaches no route, and is not driven by hand: "
                                              "'teach ROUTE' has it be taught",
                                              robot));
                  case Verdict::kLate:
                    return Refuse(response, 409,
                                  "this was under way for too long and is not passed on: the "
                                  "network is slow");
                }
              });
}

}  // namespace trailcast::console
