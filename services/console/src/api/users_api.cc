#include "services/console/src/api/users_api.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>
#include <utility>

#include "services/console/json.h"
#include "services/console/src/api/answers.h"
#include "services/program/json.h"
#include "services/users/secret.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;
using program::Json;
using users::Role;
using users::User;
using users::Users;

Json UserJson(const std::string& name, const User& user) {
  return {{"user", name},
          {"role", users::NameOf(user.role)},
          {"has", user.token.empty() ? "password" : "token"}};
}

tl::unexpected<Error> NoSuchUser(const std::string& name) {
  return Fail(ErrorCode::kNotFound, "there is no user '{}'", name);
}

bool IsAdministrator(const User& user) {
  return user.role == Role::kAdminister && !user.password.empty();
}

// Fails if nobody would be left on the page who can let anybody in.
Result<void> KeepAnAdministrator(const Users& users, const std::string& name, const User& was) {
  const bool has = std::any_of(users.begin(), users.end(),
                               [](const auto& each) { return IsAdministrator(each.second); });
  if (has || !IsAdministrator(was)) return {};
  return Fail(ErrorCode::kConflict,
              "{} is the last who has a password and may administer: let another one do so first",
              name);
}

Result<std::string> Hashed(const std::string& name, const std::string& password) {
  if (auto fits = users::CheckPassword(name, password); !fits) {
    return tl::unexpected(fits.error());
  }
  return users::HashPassword(password);
}

Result<Json> AddUser(const users::Guard& guard, const NewUserBody& body) {
  User user{.role = body.role};
  const std::string token = body.password ? "" : users::DrawToken();
  if (body.password) {
    auto hash = Hashed(body.user, *body.password);
    if (!hash) return tl::unexpected(hash.error());
    user.password = *std::move(hash);
  } else {
    user.token = users::DigestOf(token);
  }
  const auto added = guard.Change([&](Users& users) -> Result<void> {
    if (users.emplace(body.user, user).second) return {};
    return Fail(ErrorCode::kConflict, "there is a user '{}' already", body.user);
  });
  if (!added) return tl::unexpected(added.error());
  Json json = UserJson(body.user, user);
  json["token"] = token.empty() ? Json(nullptr) : Json(token);
  return json;
}

Result<Json> ChangeUser(const users::Guard& guard, const std::string& name,
                        const UserChangeBody& body) {
  std::string hash;
  if (body.password) {
    auto hashed = Hashed(name, *body.password);
    if (!hashed) return tl::unexpected(hashed.error());
    hash = *std::move(hashed);
  }
  User now;
  const auto changed = guard.Change([&](Users& users) -> Result<void> {
    const auto found = users.find(name);
    if (found == users.end()) return NoSuchUser(name);
    if (!hash.empty() && !found->second.token.empty()) {
      return Fail(ErrorCode::kConflict, "{} is a program, with a token and no password", name);
    }
    const User was = found->second;
    if (!hash.empty()) found->second.password = hash;
    found->second.role = body.role.value_or(found->second.role);
    now = found->second;
    return KeepAnAdministrator(users, name, was);
  });
  if (!changed) return tl::unexpected(changed.error());
  return UserJson(name, now);
}

Result<Json> RemoveUser(const users::Guard& guard, const std::string& name) {
  const auto removed = guard.Change([&](Users& users) -> Result<void> {
    const auto found = users.find(name);
    if (found == users.end()) return NoSuchUser(name);
    const User was = found->second;
    users.erase(found);
    return KeepAnAdministrator(users, name, was);
  });
  if (!removed) return tl::unexpected(removed.error());
  return Json{{"user", name}};
}

Result<Json> ListUsers(const users::Guard& guard) {
  const auto users = guard.List();
  if (!users) return tl::unexpected(users.error());
  Json list = Json::array();
  for (const auto& [name, user] : *users) list.push_back(UserJson(name, user));
  return Json{{"users", std::move(list)}};
}

// Does it if users log in here, and notes who has done what to whom.
template <typename Do>
void ServeByGuard(const Access& access, const Request& request, Response& response,
                  const char* what, const Do& act) {
  const users::Guard* guard = access.guard();
  if (guard == nullptr) {
    return Refuse(response, 404, "there are no users here: nobody has to log in");
  }
  const Result<Json> done = act(*guard);
  if (!done) return Refuse(response, done.error());
  if (done->contains("user")) {
    spdlog::info("console: {} {} user {}", access.WhoIs(request).name, what,
                 (*done)["user"].get_ref<const std::string&>());
  }
  Answer(response, 200, program::OneLine(*done));
}

}  // namespace

void ServeUsers(http::Server& server, const Access& access) {
  constexpr const char* kUser = "/api/users/([A-Za-z0-9_.-]{1,32})";
  server.Get("/api/users", [&access](const Request& request, Response& response) {
    ServeByGuard(access, request, response, "lists", ListUsers);
  });
  server.Post("/api/users", [&access](const Request& request, Response& response) {
    ServeByGuard(access, request, response, "adds", [&](const users::Guard& guard) {
      return ReadNewUser(request.body).and_then([&](const NewUserBody& body) {
        return AddUser(guard, body);
      });
    });
  });
  server.Put(kUser, [&access](const Request& request, Response& response) {
    ServeByGuard(access, request, response, "changes", [&](const users::Guard& guard) {
      return ReadUserChange(request.body).and_then([&](const UserChangeBody& body) {
        return ChangeUser(guard, request.matches[1], body);
      });
    });
  });
  server.Delete(kUser, [&access](const Request& request, Response& response) {
    ServeByGuard(access, request, response, "removes",
                 [&](const users::Guard& guard) { return RemoveUser(guard, request.matches[1]); });
  });
}

}  // namespace trailcast::console
