#include "services/console/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <utility>

#include "services/base/local_time.h"
#include "services/base/number.h"
#include "services/base/text.h"
#include "services/console/src/api/words.h"
#include "services/exchange/bounds.h"
#include "services/mission/address.h"
#include "services/network/words.h"
#include "services/route/bounds.h"
#include "services/route/query_words.h"

namespace trailcast::console {
namespace {

constexpr std::uint32_t kRoutesAPage = 50;
constexpr std::uint32_t kMostRoutesAPage = 200;
constexpr std::uint32_t kMostRoutesDrawn = 500;
constexpr std::uint32_t kMostChanges = 5000;
constexpr double kWithin_m = 50.0;
constexpr std::size_t kMostNameBytes = 128;

// These read each parameter that was given into a query.
template <typename Query>
using Readers = std::map<std::string, std::function<Result<void>(const std::string&, Query&)>>;

template <typename Query, typename Number>
auto NumberInto(Number Query::*field) {
  return [field](const std::string& text, Query& query) -> Result<void> {
    if (ReadNumber(text, query.*field)) return {};
    return Fail(ErrorCode::kInvalidArgument, "is no number");
  };
}

template <typename Query>
auto TextInto(std::string Query::*field) {
  return [field](const std::string& text, Query& query) -> Result<void> {
    query.*field = text;
    return {};
  };
}

template <typename Query>
auto NameInto(std::string Query::*field) {
  return [field](const std::string& text, Query& query) -> Result<void> {
    if (!IsValidName(text)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "is to be a name of 1 to 64 letters, digits, '_', '.', '-'");
    }
    query.*field = text;
    return {};
  };
}

Result<void> ReadAgent(const std::string& text, mission::Query& query) {
  const auto addressed = mission::ParseAddress(text);
  if (!addressed) return tl::unexpected(addressed.error());
  query.agent = text;
  return {};
}

// Reads a name as a log has it, which may be any text.
template <typename Query>
auto LoggedNameInto(std::string Query::*field) {
  return [field](const std::string& text, Query& query) -> Result<void> {
    if (text.size() > kMostNameBytes) return Fail(ErrorCode::kInvalidArgument, "is too long");
    query.*field = text;
    return {};
  };
}

template <typename Query>
auto LimitInto(std::uint32_t Query::*field, std::uint32_t most) {
  return [field, most](const std::string& text, Query& query) -> Result<void> {
    const auto limit = ParseNumber<std::uint32_t>(text);
    if (!limit || *limit < 1 || *limit > most) {
      return Fail(ErrorCode::kInvalidArgument, "is to be 1 to {}", most);
    }
    query.*field = *limit;
    return {};
  };
}

// Reads parameters. The one named `several` may be given more than once.
template <typename Query>
Result<void> ReadParameters(const Parameters& parameters, const Readers<Query>& readers,
                            const std::string& several, Query& query) {
  for (const auto& [name, text] : parameters) {
    if (text.empty()) continue;  // a form sends this for an empty field
    const auto known = readers.find(name);
    if (known == readers.end()) {
      return Fail(ErrorCode::kInvalidArgument, "there is no parameter '{}'", PlainText(name, 64));
    }
    if (name != several && parameters.count(name) > 1) {
      return Fail(ErrorCode::kInvalidArgument, "'{}' is given more than once", name);
    }
    if (auto read = known->second(text, query); !read) {
      return Fail(ErrorCode::kInvalidArgument, "'{}': {}", name, read.error().message);
    }
  }
  return {};
}

template <route::Place::Frame kFrame>
Result<void> ReadNear(const std::string& text, route::RouteQuery& query) {
  const auto place = route::ReadPlace(kFrame, text);
  if (!place) return tl::unexpected(place.error());
  query.near = {*place, kWithin_m};
  return {};
}

Result<void> ReadTag(const std::string& text, route::RouteQuery& query) {
  query.tags.push_back(text);
  std::sort(query.tags.begin(), query.tags.end());
  query.tags.erase(std::unique(query.tags.begin(), query.tags.end()), query.tags.end());
  return {};
}

Result<void> ReadState(const std::string& text, route::RouteQuery& query) {
  const auto word = ReadWord(route::StateWords(), text);
  if (!word) return tl::unexpected(word.error());
  query.state = word->state;
  query.standing = word->standing;
  return {};
}

Result<void> ReadSort(const std::string& text, route::RouteQuery& query) {
  const auto word = ReadWord(route::OrderWords(), text);
  if (!word) return tl::unexpected(word.error());
  query.order = *word;
  return {};
}

// This query has the radius, too.
struct PagedQuery : route::RouteQuery {
  double within_m = kWithin_m;
};

const Readers<PagedQuery>& RouteParameters() {
  using Query = PagedQuery;
  static const Readers<Query> kAll{
      {"name", TextInto<Query>(&Query::name)},
      {"prefix", TextInto<Query>(&Query::name_prefix)},
      {"tag", ReadTag},
      {"scout", TextInto<Query>(&Query::scout)},
      {"camera", TextInto<Query>(&Query::camera_prefix)},
      {"min_length_m", NumberInto<Query, double>(&Query::min_length_m)},
      {"max_length_m", NumberInto<Query, double>(&Query::max_length_m)},
      {"taught_from_unix_ms", NumberInto<Query, std::int64_t>(&Query::taught_from_unix_ms)},
      {"taught_until_unix_ms", NumberInto<Query, std::int64_t>(&Query::taught_until_unix_ms)},
      {"state", ReadState},
      {"near_site", ReadNear<route::Place::Frame::kSite>},
      {"near_gps", ReadNear<route::Place::Frame::kWgs84>},
      {"within_m", NumberInto<Query, double>(&Query::within_m)},
      {"sort", ReadSort},
      {"limit", LimitInto<Query>(&Query::page_size, kMostRoutesAPage)},
      {"cursor", TextInto<Query>(&Query::cursor)}};
  return kAll;
}

Readers<mission::Query> RecordParameters() {
  using mission::Query;
  return {{"robot", ReadAgent},
          {"route", NameInto<Query>(&Query::route)},
          {"by", NameInto<Query>(&Query::client)},
          {"from_unix_ms", NumberInto<Query, std::int64_t>(&Query::from_unix_ms)},
          {"until_unix_ms", NumberInto<Query, std::int64_t>(&Query::until_unix_ms)},
          {"limit", LimitInto<Query>(&Query::page_size, exchange::kMaxMissionsPerReply)},
          {"before", NumberInto<Query, std::uint64_t>(&Query::before)}};
}

Result<void> ReadMissionState(const std::string& text, mission::Query& query) {
  std::string all;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    const std::string word = mission::ToString(static_cast<mission::State>(i));
    if (text == word) {
      query.states |= 1U << i;
      return {};
    }
    all += (all.empty() ? "" : ", ") + word;
  }
  return Fail(ErrorCode::kInvalidArgument, "is to be one of {}", all);
}

}  // namespace

Result<route::RouteQuery> ReadRouteQuery(const Parameters& parameters) {
  PagedQuery query;
  query.page_size = kRoutesAPage;
  if (auto read = ReadParameters(parameters, RouteParameters(), "tag", query); !read) {
    return tl::unexpected(read.error());
  }
  if (query.near) query.near->radius_m = query.within_m;
  if (auto possible = exchange::CheckQuery(query); !possible) {
    return tl::unexpected(possible.error());
  }
  return query;
}

Result<mission::Query> ReadMissionQuery(const Parameters& parameters) {
  static const Readers<mission::Query> kAll = [] {
    Readers<mission::Query> readers = RecordParameters();
    readers.emplace("mission", NameInto<mission::Query>(&mission::Query::id));
    readers.emplace("state", ReadMissionState);
    return readers;
  }();
  mission::Query query;
  if (auto read = ReadParameters(parameters, kAll, "state", query); !read) {
    return tl::unexpected(read.error());
  }
  return query;
}

Result<mission::Query> ReadCommandQuery(const Parameters& parameters) {
  static const Readers<mission::Query> kAll = RecordParameters();
  mission::Query query;
  if (auto read = ReadParameters(parameters, kAll, "", query); !read) {
    return tl::unexpected(read.error());
  }
  return query;
}

Result<ChangesQuery> ReadChangesQuery(const Parameters& parameters, std::int64_t now_unix_ms) {
  using Query = ChangesQuery;
  bool is_said = false;
  const Readers<Query> all{{"since",
                            [&](const std::string& text, Query& query) -> Result<void> {
                              const auto since_unix_ms =
                                  ParseSince(PlainText(text, 64), now_unix_ms);
                              if (!since_unix_ms) return tl::unexpected(since_unix_ms.error());
                              query.since_unix_ms = *since_unix_ms;
                              is_said = true;
                              return {};
                            }},
                           {"route",
                            [](const std::string& text, Query& query) -> Result<void> {
                              query.routes.push_back(text);
                              return {};
                            }},
                           {"limit", LimitInto<Query>(&Query::limit, kMostChanges)}};
  Query query;
  if (auto read = ReadParameters(parameters, all, "route", query); !read) {
    return tl::unexpected(read.error());
  }
  if (is_said) return query;
  return Fail(ErrorCode::kInvalidArgument, "'since' is missing: monday, yesterday, 09:15, 7d, ..");
}

Result<RunsQuery> ReadRunsQuery(const Parameters& parameters) {
  using Query = RunsQuery;
  static const Readers<Query> kAll{{"robot", LoggedNameInto<Query>(&Query::robot)},
                                   {"route", LoggedNameInto<Query>(&Query::route)},
                                   {"mission", LoggedNameInto<Query>(&Query::mission)},
                                   {"skip", NumberInto<Query, std::size_t>(&Query::skip)}};
  Query query;
  if (auto read = ReadParameters(parameters, kAll, "", query); !read) {
    return tl::unexpected(read.error());
  }
  return query;
}

Result<NetworkQuery> ReadNetworkQuery(const Parameters& parameters) {
  using Query = NetworkQuery;
  static const Readers<Query> kAll{{"search", LoggedNameInto<Query>(&Query::search)},
                                   {"around", LoggedNameInto<Query>(&Query::around)},
                                   {"of", LoggedNameInto<Query>(&Query::of)},
                                   {"limit", LimitInto<Query>(&Query::limit, kMostRoutesDrawn)}};
  Query query;
  if (auto read = ReadParameters(parameters, kAll, "", query); !read) {
    return tl::unexpected(read.error());
  }
  const std::string* const parts[] = {&query.search, &query.around, &query.of};
  const auto given = std::count_if(std::begin(parts), std::end(parts),
                                   [](const std::string* part) { return !part->empty(); });
  if (given <= 1) return query;
  return Fail(ErrorCode::kInvalidArgument, "'search', 'around' and 'of' exclude each other");
}

Result<std::string> ReadWayQuestion(const Parameters& parameters) {
  struct Ends {
    std::string from;
    std::string to;
  };
  static const Readers<Ends> kAll{{"from", LoggedNameInto<Ends>(&Ends::from)},
                                  {"to", LoggedNameInto<Ends>(&Ends::to)}};
  Ends ends;
  if (auto read = ReadParameters(parameters, kAll, "", ends); !read) {
    return tl::unexpected(read.error());
  }
  for (const auto& [name, word] : {std::pair("from", &ends.from), std::pair("to", &ends.to)}) {
    if (const auto goal = network::ParseGoal(*word); !goal) {
      return Wrap(goal.error(), fmt::format("'{}'", name));
    }
  }
  const std::string words = fmt::format("way {} {}", ends.from, ends.to);
  if (!IsPlainText(words, exchange::kMaxLineBytes)) {
    return Fail(ErrorCode::kInvalidArgument, "places are to be text of one line");
  }
  if (const auto question = network::ParseQuestion(words); !question) {
    return tl::unexpected(question.error());
  }
  return words;
}

Result<TeachingId> ReadTeaching(const std::string& text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [read_to, error] = std::from_chars(text.data(), end, value, 16);
  if (error != std::errc() || read_to != end || value == 0 || value > route::kMaxTeaching) {
    return Fail(ErrorCode::kInvalidArgument, "is to be a hexadecimal number");
  }
  return TeachingId(value);
}

}  // namespace trailcast::console
