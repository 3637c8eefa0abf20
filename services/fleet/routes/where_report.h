#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/exchange/messages.h"

namespace trailcast::fleet {

// What a server found of a view, for people: a line a place, likest first, or that there is none;
// and, where not all that is stored was searched, how much was.
[[nodiscard]] std::string WhereText(const exchange::CatalogReply& reply);
// For programs: one object.
[[nodiscard]] nlohmann::ordered_json WhereJson(const exchange::CatalogReply& reply);

}  // namespace trailcast::fleet
