#pragma once

#include <string>

#include "services/base/result.h"

namespace trailcast::soak {

// Judges a follower by its exit status and its last words. Returns why it did not arrive, in its
// own words, or nothing if it arrived. It has failed if it may not end so: it may say that it did
// not arrive, and where the soak itself `cut_off` the teaching of its `route`, that nobody finished
// it.
[[nodiscard]] Result<std::string> JudgeFollower(int status, const std::string& last_words,
                                                const std::string& route, bool cut_off);

}  // namespace trailcast::soak
