#include "services/webhooks/hook.h"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <stdexcept>

#include "services/base/hex.h"
#include "services/base/text_file.h"
#include "services/program/json.h"

namespace trailcast::webhooks {
namespace {

using program::Json;

constexpr std::array<std::string_view, 2> kKinds{"alert", "mission"};

bool IsEvent(const std::string& name) {
  for (const std::string_view kind : kKinds) {
    if (name == kind || name.starts_with(std::string(kind) + ".")) return true;
  }
  return false;
}

Result<Hook> HookOf(const Json& json) {
  const auto wrong = [](const char* what) { return Fail(ErrorCode::kInvalidArgument, "{}", what); };
  if (!json.is_object()) return wrong("it is no object with a \"url\"");
  Hook hook;
  for (const auto& [name, value] : json.items()) {
    if (name == "url" && value.is_string()) {
      hook.url = value.get<std::string>();
    } else if (name == "secret" && value.is_string()) {
      hook.secret = value.get<std::string>();
    } else if (name == "events" && value.is_array()) {
      for (const Json& event : value) {
        if (!event.is_string() || !IsEvent(event.get<std::string>())) {
          return wrong(
              "\"events\" has other than alert, mission, or one of theirs as mission.failed");
        }
        hook.events.insert(event.get<std::string>());
      }
    } else {
      return Fail(ErrorCode::kInvalidArgument,
                  "'{}' is not known, or not of its type: expected \"url\" and, if at all, "
                  "\"secret\", which are texts, and \"events\", a list of texts",
                  name);
    }
  }
  auto to = http::ParseUrl(hook.url);
  if (!to) return Wrap(to.error(), "\"url\"");
  hook.to = *std::move(to);
  return hook;
}

}  // namespace

bool Hook::Wants(std::string_view event) const {
  return events.empty() || events.contains(std::string(event)) ||
         events.contains(std::string(event.substr(0, event.find('.'))));
}

Result<std::vector<Hook>> ParseHooks(const std::string& json) {
  const Json list = Json::parse(json, nullptr, false);
  if (list.is_discarded() || !list.is_array()) {
    return Fail(ErrorCode::kInvalidArgument,
                "expected a list in JSON: [{{\"url\": \"https://...\", \"secret\": \"...\"}}]");
  }
  if (list.size() > kMostHooks) {
    return Fail(ErrorCode::kInvalidArgument, "{} hooks are more than {}", list.size(), kMostHooks);
  }
  std::vector<Hook> hooks;
  for (const Json& each : list) {
    auto hook = HookOf(each);
    if (!hook) return Wrap(hook.error(), fmt::format("hook {}", hooks.size() + 1));
    for (const Hook& other : hooks) {
      if (other.url == hook->url) {
        return Fail(ErrorCode::kInvalidArgument, "hook {} has the URL of an earlier one",
                    hooks.size() + 1);
      }
    }
    hooks.push_back(*std::move(hook));
  }
  return hooks;
}

Result<std::vector<Hook>> LoadHooks(const std::filesystem::path& file) {
  const auto text = ReadTextFile(file);
  if (!text) return tl::unexpected(text.error());
  auto hooks = ParseHooks(*text);
  if (!hooks) return Wrap(hooks.error(), file.string());
  return hooks;
}

std::string SignatureOf(const std::string& secret, std::int64_t unix_s, const std::string& body) {
  const std::string signed_text = fmt::format("{}.{}", unix_s, body);
  std::array<unsigned char, 32> code{};
  unsigned int size = 0;
  if (HMAC(EVP_sha256(), secret.data(), static_cast<int>(secret.size()),
           reinterpret_cast<const unsigned char*>(signed_text.data()), signed_text.size(),
           code.data(), &size) == nullptr) {
    throw std::runtime_error("OpenSSL has no HMAC-SHA256");
  }
  return fmt::format("t={},v1={}", unix_s, ToHex(code));
}

}  // namespace trailcast::webhooks
