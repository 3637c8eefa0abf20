#include "services/security/member.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <charconv>
#include <new>
#include <span>

#include "services/base/hex.h"

namespace trailcast::security {
namespace {

constexpr std::size_t kIdDigits = 16;

bool IsId(std::string_view text) { return text.size() == kIdDigits && IsHex(text); }

// Takes "role" and "id", with `between` between them, from the beginning of `text`.
std::optional<Member> TakeRoleAndId(std::string_view& text, char between) {
  const std::size_t end = text.find(between);
  if (end == std::string_view::npos) return std::nullopt;
  const auto role = FindRole(text.substr(0, end));
  const std::string_view id = text.substr(end + 1, kIdDigits);
  if (!role || !IsId(id)) return std::nullopt;
  text.remove_prefix(end + 1 + kIdDigits);
  return Member{.role = *role, .id = std::string(id)};
}

}  // namespace

std::string CommonNameOf(const Member& member) {
  return fmt::format("{}.{}.{}", NameOf(member.role), member.id, member.generation);
}

std::optional<Member> ParseCommonName(std::string_view text) {
  auto member = TakeRoleAndId(text, '.');
  if (!member || !text.starts_with('.')) return std::nullopt;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + 1, end, member->generation);
  if (error != std::errc() || rest != end) return std::nullopt;
  return member;
}

std::string SubjectOf(const Member& member) { return "CN=" + CommonNameOf(member); }

std::string PartitionOf(const Member& member) {
  return fmt::format("{}/{}", NameOf(member.role), member.id);
}

std::optional<Member> ParsePartition(std::string_view text) {
  auto member = TakeRoleAndId(text, '/');
  return member && (text.empty() || text.starts_with('/')) ? member : std::nullopt;
}

std::string MemberIdOf(std::string_view name_key, std::string_view name) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  // HMAC fails only if it cannot allocate memory.
  if (HMAC(EVP_sha256(), name_key.data(), static_cast<int>(name_key.size()),
           reinterpret_cast<const unsigned char*>(name.data()), name.size(), digest.data(),
           &length) == nullptr) {
    throw std::bad_alloc();
  }
  return ToHex(std::span(digest).first(kIdDigits / 2));
}

}  // namespace trailcast::security
