#include "tests/soak/verdict.h"

#include <regex>

namespace trailcast::soak {
namespace {

constexpr int kArrived = 0;
constexpr int kFailed = 1;
constexpr int kNotArrived = 3;

}  // namespace

Result<std::string> JudgeFollower(int status, const std::string& last_words,
                                  const std::string& route, bool cut_off) {
  if (status == kArrived) return std::string();
  const std::regex not_arrived("not arrived: (.*)");
  const std::regex nobody_finished_it(
      fmt::format("waited [0-9]+ s in vain: (server 'server' has no active revision of route '{}'; "
                  "it has [0-9a-f]+@1 \\(cut off\\): its teaching was cut off), and robots follow "
                  "no revision of it; teach it again, or finish it",
                  route));
  std::smatch why;
  const bool may_end_so =
      (status == kNotArrived && std::regex_search(last_words, why, not_arrived)) ||
      (status == kFailed && cut_off && std::regex_search(last_words, why, nobody_finished_it));
  if (may_end_so) return why[1].str();
  return Fail(ErrorCode::kUnavailable, "ended with status {}:\n{}", status, last_words);
}

}  // namespace trailcast::soak
