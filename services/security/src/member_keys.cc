#include "services/security/member_keys.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "services/exchange/topics.h"
#include "services/security/certificates.h"
#include "services/security/folder_layout.h"
#include "services/security/src/files.h"
#include "services/security/src/signing.h"

namespace trailcast::security {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFiles{kAuthorityFile,   kGovernanceFile,  kRevokedFile, kIdentityFile,
                            kIdentityKeyFile, kPermissionsFile, kMemberFile};

constexpr const char* kCopyAgain =
    "copy the folder that 'trailcast keys add' (or renew) wrote for this member again, whole";

// Returns the value of `key = "value"`, or an empty text.
std::string ValueOf(const std::string& text, const std::string& key) {
  const std::string open = key + " = \"";
  std::size_t at = text.starts_with(open) ? 0 : text.find("\n" + open);
  if (at == std::string::npos) return "";
  at = text.find('"', at) + 1;
  const std::size_t end = text.find('"', at);
  return end == std::string::npos ? "" : text.substr(at, end - at);
}

Result<void> CheckFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return Fail(ErrorCode::kNotFound, "there is no folder {}: {}", folder.string(), kCopyAgain);
  }
  if (fs::exists(folder / kAuthorityKeyFile, error)) {
    return Fail(ErrorCode::kConflict,
                "{} is the authority's own folder, which stays where it is; a program is given a "
                "member's, {}",
                folder.string(), (folder / kMembersFolder / "NAME").string());
  }
  for (const char* file : kFiles) {
    if (!fs::exists(folder / file, error)) {
      return Fail(ErrorCode::kNotFound, "{} is missing: {}", (folder / file).string(), kCopyAgain);
    }
  }
  for (const char* name : {kIdentityKeyFile, kMemberFile}) {
    const fs::path secret = folder / name;
    if ((fs::status(secret, error).permissions() & fs::perms::others_all) != fs::perms::none) {
      return Fail(ErrorCode::kConflict, "{} is open to everybody on this machine: chmod 600 {}",
                  secret.string(), secret.string());
    }
  }
  return {};
}

struct Contents {
  std::string authority;
  std::string revoked;
  Identity identity;
  std::string governance;
  std::string permissions;
  std::string about;
};

Result<Contents> ReadAll(const fs::path& folder) {
  Contents contents;
  for (const auto& [file, text] : {std::pair{kAuthorityFile, &contents.authority},
                                   {kRevokedFile, &contents.revoked},
                                   {kIdentityFile, &contents.identity.certificate},
                                   {kIdentityKeyFile, &contents.identity.key},
                                   {kGovernanceFile, &contents.governance},
                                   {kPermissionsFile, &contents.permissions},
                                   {kMemberFile, &contents.about}}) {
    auto read = ReadSmallFile(folder / file);
    if (!read) return tl::unexpected(read.error());
    *text = *std::move(read);
  }
  return contents;
}

tl::unexpected<Error> Wrong(const fs::path& file, const std::string& what) {
  return Fail(ErrorCode::kCorrupt, "{}: {}; {}", file.string(), what, kCopyAgain);
}

Result<void> CheckIdentity(const fs::path& folder, const Contents& contents) {
  const fs::path file = folder / kIdentityFile;
  const auto is_signed = IsSignedBy(contents.identity.certificate, contents.authority);
  if (!is_signed) return Wrong(file, is_signed.error().message);
  if (!*is_signed) return Wrong(file, "was not given by the authority in authority.pem");
  const auto fits = KeyFits(contents.identity);
  if (!fits) return Wrong(folder / kIdentityKeyFile, fits.error().message);
  if (!*fits) return Wrong(folder / kIdentityKeyFile, "is not the key of identity.pem");
  return {};
}

Result<void> CheckDates(const MemberKeys& keys, const CertificateFacts& facts, Time now) {
  if (now >= facts.validity.until) {
    return Fail(
        ErrorCode::kUnavailable,
        "the keys in {} expired on {}: 'trailcast keys renew {}' where the authority is, and "
        "copy the folder again",
        keys.folder.string(), ToText(facts.validity.until), keys.name);
  }
  if (now < facts.validity.from) {
    return Fail(
        ErrorCode::kUnavailable,
        "the keys in {} are valid from {} only, and it is {} here: set this machine's clock",
        keys.folder.string(), ToText(facts.validity.from), ToText(now));
  }
  return {};
}

// Also stores the list in `keys`.
Result<void> CheckRevoked(MemberKeys& keys, const Contents& contents, const std::string& serial) {
  auto list = ReadRevocationList(contents.revoked, contents.authority);
  if (!list) return Wrong(keys.folder / kRevokedFile, list.error().message);
  keys.revoked = *std::move(list);
  const std::vector<std::string>& revoked = keys.revoked.serials;
  if (std::find(revoked.begin(), revoked.end(), serial) == revoked.end()) return {};
  return Fail(ErrorCode::kUnavailable,
              "the keys in {} were revoked; if that was not meant, 'trailcast keys renew {}' where "
              "the authority is",
              keys.folder.string(), keys.name);
}

// Also stores what the permissions allow in `keys`.
Result<void> CheckDocuments(MemberKeys& keys, const Contents& contents) {
  const auto governance = OpenSigned(contents.governance, contents.authority);
  if (!governance) return Wrong(keys.folder / kGovernanceFile, governance.error().message);
  const fs::path file = keys.folder / kPermissionsFile;
  const auto permissions = OpenSigned(contents.permissions, contents.authority);
  if (!permissions) return Wrong(file, permissions.error().message);
  const auto subject = ElementOf(*permissions, "subject_name");
  if (subject != SubjectOf(keys.member)) {
    return Wrong(file, fmt::format("is for {}, and identity.pem for {}", subject.value_or("nobody"),
                                   SubjectOf(keys.member)));
  }
  keys.scoped = AllowsScopes(*permissions, keys.member);
  keys.revocations = AllowsTopic(*permissions, kRevocationsTopic);
  const exchange::TopicUse rights = RightsOf(keys.member.role);
  for (const auto* topics : {&rights.write, &rights.read}) {
    for (const exchange::Topic topic : *topics) {
      if (!AllowsTopic(*permissions, exchange::NameOf(topic))) keys.lacks.insert(topic);
    }
  }
  return {};
}

}  // namespace

Result<std::string> NameInKeys(const fs::path& folder) {
  if (auto ok = CheckFolder(folder); !ok) return tl::unexpected(ok.error());
  const auto about = ReadSmallFile(folder / kMemberFile);
  if (!about) return tl::unexpected(about.error());
  std::string name = ValueOf(*about, "name");
  if (name.empty()) return Wrong(folder / kMemberFile, "names no member");
  return name;
}

Result<MemberKeys> LoadMemberKeys(const fs::path& folder, Time now) {
  MemberKeys keys;
  std::error_code error;
  keys.folder = fs::absolute(folder, error);
  if (auto ok = CheckFolder(keys.folder); !ok) return tl::unexpected(ok.error());
  const auto contents = ReadAll(keys.folder);
  if (!contents) return tl::unexpected(contents.error());
  keys.name = ValueOf(contents->about, "name");
  keys.name_key = ValueOf(contents->about, "name_key");
  const auto facts = ReadCertificate(contents->identity.certificate);
  if (!facts) return Wrong(keys.folder / kIdentityFile, facts.error().message);
  auto member = ParseCommonName(facts->common_name);
  if (!member) return Wrong(keys.folder / kIdentityFile, "is no member's certificate");
  keys.member = *std::move(member);
  keys.expires = facts->validity.until;
  keys.authority = contents->authority;
  if (MemberIdOf(keys.name_key, keys.name) != keys.member.id) {
    return Wrong(keys.folder / kMemberFile, "is of another member than identity.pem");
  }
  for (const auto& checked :
       {CheckIdentity(keys.folder, *contents), CheckDates(keys, *facts, now),
        CheckRevoked(keys, *contents, facts->serial), CheckDocuments(keys, *contents)}) {
    if (!checked) return tl::unexpected(checked.error());
  }
  return keys;
}

std::string KeysVersion(const fs::path& folder) {
  std::string version;
  for (const char* file : kFiles) {
    // ReplaceFile makes a new file, which has another inode. The times alone can stay the same for
    // some ms.
    struct stat about {};
    const bool is_there = stat((folder / file).c_str(), &about) == 0;
    version += is_there ? fmt::format("{}.{}.{}.{}/", about.st_ino, about.st_size,
                                      about.st_mtim.tv_sec, about.st_mtim.tv_nsec)
                        : "-";
  }
  return version;
}

}  // namespace trailcast::security
