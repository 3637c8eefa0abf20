#include "services/security/authority.h"

#include <fmt/ranges.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <set>

#include "services/base/durable_file.h"
#include "services/base/hex.h"
#include "services/base/ids.h"
#include "services/base/process_name.h"
#include "services/security/documents.h"
#include "services/security/folder_layout.h"
#include "services/security/revocation_list.h"
#include "services/security/src/files.h"
#include "services/security/src/signing.h"

namespace trailcast::security {
namespace {

namespace fs = std::filesystem;

// Robots' clocks are not always right, so certificates are valid from a day ago.
constexpr std::chrono::hours kClockMargin{24};

Time After(Time now, int days) { return now + std::chrono::hours(24) * days; }

Result<std::string> MakeNameKey() {
  std::array<unsigned char, 32> bytes{};
  if (RAND_bytes(bytes.data(), bytes.size()) != 1) {
    return Fail(ErrorCode::kInternal, "no random numbers to be had");
  }
  return ToHex(bytes);
}

// Writes several files, until one fails.
struct File {
  const char* name;
  std::string text;
  mode_t mode;
};
Result<void> WriteFiles(const fs::path& folder, const std::vector<File>& files) {
  for (const File& file : files) {
    if (auto written = ReplaceFile(folder / file.name, file.text, file.mode); !written) {
      return written;
    }
  }
  return {};
}

}  // namespace

fs::path Authority::RevocationFile() const { return folder_ / kRevokedFile; }

Result<Authority> Authority::Create(const fs::path& folder, Time now, int days) {
  std::error_code error;
  if (fs::exists(folder / kAuthorityKeyFile, error) || fs::exists(folder / kAuthorityFile, error)) {
    return Fail(ErrorCode::kConflict,
                "{} has an authority already, and a second one would not know its members; choose "
                "another folder",
                folder.string());
  }
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    return Fail(ErrorCode::kConflict,
                "{} is not empty: an authority has a folder of its own, closed to others; give a "
                "new one",
                folder.string());
  }
  const Validity validity{now - kClockMargin, After(now, days)};
  auto identity = MakeAuthority("trailcast authority", validity);
  if (!identity) return tl::unexpected(identity.error());
  auto name_key = MakeNameKey();
  if (!name_key) return tl::unexpected(name_key.error());
  const auto governance = Sign(GovernanceXml(), *identity);
  if (!governance) return tl::unexpected(governance.error());
  const auto revoked = MakeRevocationList(*identity, {}, 1, validity);
  if (!revoked) return tl::unexpected(revoked.error());
  for (const fs::path& each : {folder, folder / kIssuedFolder, folder / kMembersFolder}) {
    if (auto made = MakePrivateFolder(each); !made) return tl::unexpected(made.error());
  }
  if (auto written = WriteFiles(folder, {{kAuthorityKeyFile, identity->key, kForOwner},
                                         {kNameKeyFile, *name_key, kForOwner},
                                         {kGovernanceFile, *governance, kForEverybody},
                                         {kRevokedFile, *revoked, kForEverybody},
                                         {kAuthorityFile, identity->certificate, kForEverybody}});
      !written) {
    return tl::unexpected(written.error());
  }
  return Authority(folder, *std::move(identity), *std::move(name_key), validity.until);
}

Result<Authority> Authority::Open(const fs::path& folder) {
  if (!fs::exists(folder / kAuthorityKeyFile)) {
    return Fail(ErrorCode::kNotFound,
                "{} has no authority's key: 'trailcast keys init {}' makes a new authority, "
                "--authority names the folder of another",
                folder.string(), folder.string());
  }
  auto key = ReadSmallFile(folder / kAuthorityKeyFile);
  if (!key) return tl::unexpected(key.error());
  auto certificate = ReadSmallFile(folder / kAuthorityFile);
  if (!certificate) return tl::unexpected(certificate.error());
  auto name_key = ReadSmallFile(folder / kNameKeyFile);
  if (!name_key) return tl::unexpected(name_key.error());
  Identity identity{*std::move(certificate), *std::move(key)};
  const auto facts = ReadCertificate(identity.certificate);
  if (!facts) return Wrap(facts.error(), (folder / kAuthorityFile).string());
  const auto fits = KeyFits(identity);
  if (!fits) return Wrap(fits.error(), (folder / kAuthorityKeyFile).string());
  if (!*fits) {
    return Fail(ErrorCode::kCorrupt, "{} and {} in {} do not belong together", kAuthorityKeyFile,
                kAuthorityFile, folder.string());
  }
  return Authority(folder, std::move(identity), *std::move(name_key), facts->validity.until);
}

Result<std::vector<Authority::Issued>> Authority::IssuedTo(const std::string& name) const {
  std::vector<Issued> issued;
  for (std::uint32_t generation = 1;; ++generation) {
    const fs::path file = folder_ / kIssuedFolder / fmt::format("{}.{}.pem", name, generation);
    if (!fs::exists(file)) return issued;
    const auto certificate = ReadSmallFile(file);
    if (!certificate) return tl::unexpected(certificate.error());
    auto facts = ReadCertificate(*certificate);
    if (!facts) return Wrap(facts.error(), file.string());
    auto member = ParseCommonName(facts->common_name);
    if (!member) {
      return Fail(ErrorCode::kCorrupt, "{}: '{}' is no member of a fleet", file.string(),
                  facts->common_name);
    }
    issued.push_back({generation, *std::move(facts), *std::move(member)});
  }
}

Result<std::vector<std::string>> Authority::Names() const {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_ / kIssuedFolder, error)) {
    const std::string stem = entry.path().stem();  // NAME.GENERATION
    const std::size_t dot = stem.rfind('.');
    if (entry.path().extension() == ".pem" && dot != std::string::npos) {
      names.insert(stem.substr(0, dot));
    }
  }
  if (error) {
    return Fail(ErrorCode::kUnavailable, "{}: {}", (folder_ / kIssuedFolder).string(),
                error.message());
  }
  return std::vector<std::string>(names.begin(), names.end());
}

Result<std::vector<Authority::Issued>> Authority::Known(const std::string& name) const {
  auto issued = IssuedTo(name);
  if (!issued || !issued->empty()) return issued;
  const auto names = Names();
  if (!names) return tl::unexpected(names.error());
  return Fail(ErrorCode::kNotFound, "there is no member '{}'; there are: {}", name,
              names->empty() ? "none" : fmt::format("{}", fmt::join(*names, ", ")));
}

Result<fs::path> Authority::Give(const std::string& name, const Member& member, Time now,
                                 int days) const {
  // Certificates do not outlive the authority, without which nobody would accept them.
  const Validity validity{now - kClockMargin, std::min(After(now, days), until_)};
  if (validity.until <= now && days > 0) {
    return Fail(ErrorCode::kUnavailable,
                "the authority itself ended on {}: make a new one with 'trailcast keys init', and "
                "keys for every member with it",
                ToText(until_));
  }
  const auto identity = Issue(identity_, CommonNameOf(member), validity);
  if (!identity) return tl::unexpected(identity.error());
  const auto permissions = Sign(PermissionsXml(member, validity), identity_);
  if (!permissions) return tl::unexpected(permissions.error());
  const auto governance = ReadSmallFile(folder_ / kGovernanceFile);
  if (!governance) return tl::unexpected(governance.error());
  const auto revoked = ReadSmallFile(RevocationFile());
  if (!revoked) return tl::unexpected(revoked.error());
  // A certificate is recorded before anybody can have it, because it could not be revoked
  // otherwise.
  const std::string record = fmt::format("{}.{}.pem", name, member.generation);
  if (auto written =
          ReplaceFile(folder_ / kIssuedFolder / record, identity->certificate, kForEverybody);
      !written) {
    return tl::unexpected(written.error());
  }
  const fs::path folder = folder_ / kMembersFolder / name;
  if (auto made = MakePrivateFolder(folder); !made) return tl::unexpected(made.error());
  const std::string about = fmt::format("name = \"{}\"\nname_key = \"{}\"\n", name, name_key_);
  if (auto written = WriteFiles(folder, {{kIdentityKeyFile, identity->key, kForOwner},
                                         {kMemberFile, about, kForOwner},
                                         {kPermissionsFile, *permissions, kForEverybody},
                                         {kGovernanceFile, *governance, kForEverybody},
                                         {kRevokedFile, *revoked, kForEverybody},
                                         {kAuthorityFile, identity_.certificate, kForEverybody},
                                         {kIdentityFile, identity->certificate, kForEverybody}});
      !written) {
    return tl::unexpected(written.error());
  }
  return folder;
}

Result<fs::path> Authority::Add(const std::string& name, Role role, Time now, int days) const {
  if (!IsValidName(name)) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' is no name: 1 to 64 of letters, digits, '_', '.' and '-'", name);
  }
  if (WithoutProcess(name) != name) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' ends like the name of a process of '{}': choose another", name,
                WithoutProcess(name));
  }
  const auto issued = IssuedTo(name);
  if (!issued) return tl::unexpected(issued.error());
  if (!issued->empty()) {
    return Fail(ErrorCode::kConflict,
                "there is a member '{}' already, a {}; 'trailcast keys renew {}' gives it new keys",
                name, NameOf(issued->back().member.role), name);
  }
  const Member member{.role = role, .id = MemberIdOf(name_key_, name), .generation = 1};
  return Give(name, member, now, days);
}

Result<fs::path> Authority::Renew(const std::string& name, std::optional<Role> role, Time now,
                                  int days) const {
  const auto issued = Known(name);
  if (!issued) return tl::unexpected(issued.error());
  Member member = issued->back().member;
  ++member.generation;
  const bool changes = role && *role != member.role;
  if (changes) {
    member.role = *role;
    if (auto revoked = RevokeSerials(*issued, now); !revoked) {
      return tl::unexpected(revoked.error());
    }
  }
  return Give(name, member, now, days);
}

Result<void> Authority::RevokeSerials(const std::vector<Issued>& issued, Time now) const {
  const auto before = RevocationListIn(folder_);
  if (!before) return tl::unexpected(before.error());
  std::vector<std::string> serials = before->serials;
  for (const Issued& each : issued) {
    if (std::find(serials.begin(), serials.end(), each.facts.serial) == serials.end()) {
      serials.push_back(each.facts.serial);
    }
  }
  const auto list =
      MakeRevocationList(identity_, serials, before->number + 1, {now - kClockMargin, until_});
  if (!list) return tl::unexpected(list.error());
  if (auto written = ReplaceFile(RevocationFile(), *list, kForEverybody); !written) return written;
  const auto names = Names();
  if (!names) return tl::unexpected(names.error());
  for (const std::string& name : *names) {
    const fs::path folder = folder_ / kMembersFolder / name;
    if (!fs::exists(folder)) continue;  // it was moved to the member's machine
    if (auto written = ReplaceFile(folder / kRevokedFile, *list, kForEverybody); !written) {
      return written;
    }
  }
  return {};
}

Result<void> Authority::Revoke(const std::string& name, Time now) const {
  const auto issued = Known(name);
  if (!issued) return tl::unexpected(issued.error());
  return RevokeSerials(*issued, now);
}

Result<std::vector<Authority::Row>> Authority::List(Time now) const {
  const auto names = Names();
  if (!names) return tl::unexpected(names.error());
  const auto list = RevocationListIn(folder_);
  if (!list) return tl::unexpected(list.error());
  const std::vector<std::string>& revoked = list->serials;
  std::vector<Row> rows;
  for (const std::string& name : *names) {
    const auto issued = IssuedTo(name);
    if (!issued) return tl::unexpected(issued.error());
    if (issued->empty()) continue;
    const Issued& latest = issued->back();
    const bool is_revoked =
        std::find(revoked.begin(), revoked.end(), latest.facts.serial) != revoked.end();
    const Time expires = latest.facts.validity.until;
    rows.push_back({name, latest.member, expires,
                    is_revoked       ? State::kRevoked
                    : expires <= now ? State::kExpired
                                     : State::kValid});
  }
  return rows;
}

}  // namespace trailcast::security
