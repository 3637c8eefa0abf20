#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trailcast {

// How many letters must be put in, left out or changed to make one of the other, upper and lower
// case being the same (Levenshtein's distance).
[[nodiscard]] std::size_t EditDistance(const std::string& a, const std::string& b);

// Of `names`, each once, those most like `wanted` first, at most `limit`: names that begin with it
// (or it with them), then by edit distance, then by alphabet. Names are never left out for being
// unlike: for a person who mistyped, any name that exists helps.
[[nodiscard]] std::vector<std::string> MostSimilar(const std::string& wanted,
                                                   std::vector<std::string> names,
                                                   std::size_t limit);

// "; did you mean 'yard' or 'bard'?" of those names that a mistyped `wanted` may have meant; else
// empty.
[[nodiscard]] std::string DidYouMean(const std::string& wanted, std::vector<std::string> names);

}  // namespace trailcast
