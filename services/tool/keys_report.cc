#include "services/tool/keys_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/program/json.h"

namespace trailcast::tool {
namespace {

using State = security::Authority::State;

const char* NameOf(State state) {
  switch (state) {
    case State::kValid:
      return "valid";
    case State::kExpired:
      return "expired";
    case State::kRevoked:
      return "revoked";
  }
  return "unknown";
}

}  // namespace

std::string KeysTable(const std::vector<security::Authority::Row>& rows) {
  if (rows.empty()) return "no members\n";
  std::size_t width = 4;
  for (const auto& row : rows) width = std::max(width, row.name.size());
  const auto line = [&](const std::string& name, const std::string& role,
                        const std::string& expires, const std::string& state,
                        const std::string& keys, const std::string& id) {
    return fmt::format("{:<{}}  {:<8}  {:<20}  {:<7}  {:>4}  {}\n", name, width, role, expires,
                       state, keys, id);
  };
  std::string text = line("name", "role", "expires", "state", "keys", "id");
  for (const auto& row : rows) {
    text += line(row.name, security::NameOf(row.member.role), security::ToText(row.expires),
                 NameOf(row.state), std::to_string(row.member.generation), row.member.id);
  }
  return text;
}

program::Json KeysJson(const std::vector<security::Authority::Row>& rows) {
  auto members = program::Json::array();
  for (const auto& row : rows) {
    members.push_back({{"name", row.name},
                       {"role", security::NameOf(row.member.role)},
                       {"expires", security::ToText(row.expires)},
                       {"state", NameOf(row.state)},
                       {"generation", row.member.generation},
                       {"id", row.member.id}});
  }
  return members;
}

}  // namespace trailcast::tool
