#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/exchange/messages.h"

namespace trailcast::fleet {

// Returns what a server found of a view, for people: one line for each place, the most similar
// first, or that there is none; and, if not all that is stored was searched, how much was.
[[nodiscard]] std::string WhereText(const exchange::CatalogReply& reply);
// Returns one object for programs.
[[nodiscard]] nlohmann::ordered_json WhereJson(const exchange::CatalogReply& reply);

}  // namespace trailcast::fleet
