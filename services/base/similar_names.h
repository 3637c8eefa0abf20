#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trailcast {

// Counts how many letters must be inserted, left out or changed to turn one name into the other
// (Levenshtein's distance). Upper and lower case are the same.
[[nodiscard]] std::size_t EditDistance(const std::string& a, const std::string& b);

// Returns at most `limit` of `names`, each once, the most similar to `wanted` first: those that
// begin with it (or it with them), then by edit distance, then by alphabet. Unlike names are not
// left out, because any name that exists helps a person who mistyped.
[[nodiscard]] std::vector<std::string> MostSimilar(const std::string& wanted,
                                                   std::vector<std::string> names,
                                                   std::size_t limit);

// Returns "; did you mean 'yard' or 'bard'?" with the names that a mistyped `wanted` may stand for,
// or an empty text.
[[nodiscard]] std::string DidYouMean(const std::string& wanted, std::vector<std::string> names);

}  // namespace trailcast
