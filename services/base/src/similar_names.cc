#include "services/base/similar_names.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace trailcast {
namespace {

std::string LowerCase(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

struct Candidate {
  bool unlike_at_start = true;
  std::size_t distance = 0;
  std::string name;

  bool operator<(const Candidate& other) const {
    return std::tie(unlike_at_start, distance, name) <
           std::tie(other.unlike_at_start, other.distance, other.name);
  }
};

Candidate Compare(const std::string& wanted, const std::string& name) {
  const std::string a = LowerCase(wanted);
  const std::string b = LowerCase(name);
  const bool prefix = !a.empty() && !b.empty() && (a.starts_with(b) || b.starts_with(a));
  return {!prefix, EditDistance(a, b), name};
}

}  // namespace

std::size_t EditDistance(const std::string& a, const std::string& b) {
  const std::string from = LowerCase(a);
  const std::string to = LowerCase(b);
  // row[j] is the distance between the letters of `from` seen so far and the first j of `to`.
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::vector<std::string> MostSimilar(const std::string& wanted, std::vector<std::string> names,
                                     std::size_t limit) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::vector<Candidate> candidates;
  candidates.reserve(names.size());
  for (const std::string& name : names) candidates.push_back(Compare(wanted, name));
  std::sort(candidates.begin(), candidates.end());
  candidates.resize(std::min(limit, candidates.size()));
  std::vector<std::string> similar;
  similar.reserve(candidates.size());
  for (Candidate& candidate : candidates) similar.push_back(std::move(candidate.name));
  return similar;
}

std::string DidYouMean(const std::string& wanted, std::vector<std::string> names) {
  constexpr std::size_t kMostMeant = 2;
  std::string meant;
  for (const std::string& name : MostSimilar(wanted, std::move(names), kMostMeant)) {
    // A name with more than a third of its letters changed is another name.
    if (EditDistance(wanted, name) > std::max<std::size_t>(1, wanted.size() / 3)) continue;
    meant += (meant.empty() ? "; did you mean '" : " or '") + name + "'";
  }
  return meant.empty() ? "" : meant + "?";
}

}  // namespace trailcast
