#pragma once

#include <filesystem>
#include <stdexcept>

#include "services/base/durable_file.h"
#include "services/security/certificates.h"
#include "services/security/folder_layout.h"
#include "services/security/member.h"
#include "services/security/src/files.h"
#include "services/security/src/signing.h"

namespace trailcast::test {

// Removes all of `what` from a member's permissions, as they were before it existed.
inline void TakeOutOfPermissions(const std::filesystem::path& authority,
                                 const std::filesystem::path& keys, const std::string& what) {
  using security::ReadSmallFile;
  const security::Identity signer{ReadSmallFile(authority / security::kAuthorityFile).value(),
                                  ReadSmallFile(authority / security::kAuthorityKeyFile).value()};
  const std::filesystem::path file = keys / security::kPermissionsFile;
  std::string text = security::OpenSigned(ReadSmallFile(file).value(), signer.certificate).value();
  if (text.find(what) == std::string::npos) throw std::runtime_error("no " + what + " in " + text);
  for (std::size_t at = 0; (at = text.find(what)) != std::string::npos;)
    text.erase(at, what.size());
  if (!ReplaceFile(file, security::Sign(text, signer).value())) {
    throw std::runtime_error("cannot write " + file.string());
  }
}

// Makes a member's folder one from before segments had scopes: its permissions do not allow the
// partitions below the member's own.
inline void MakeOfBeforeScopes(const std::filesystem::path& authority,
                               const std::filesystem::path& keys) {
  const auto facts =
      security::ReadCertificate(security::ReadSmallFile(keys / security::kIdentityFile).value());
  const auto member = security::ParseCommonName(facts->common_name).value();
  TakeOutOfPermissions(authority, keys,
                       "<partition>" + security::PartitionOf(member) + "/*</partition>");
}

// Makes a member's folder one from before servers spread revocations.
inline void MakeOfBeforeRevocations(const std::filesystem::path& authority,
                                    const std::filesystem::path& keys) {
  TakeOutOfPermissions(authority, keys,
                       std::string("<topic>") + security::kRevocationsTopic + "</topic>");
}

// Makes a member's folder one from before operators commanded robots.
inline void MakeOfBeforeNow(const std::filesystem::path& authority,
                            const std::filesystem::path& keys) {
  TakeOutOfPermissions(authority, keys, "<topic>trailcast/now</topic>");
}

// Makes a member's folder one from before operators sent robots on missions.
inline void MakeOfBeforeMissions(const std::filesystem::path& authority,
                                 const std::filesystem::path& keys) {
  TakeOutOfPermissions(authority, keys, "<topic>trailcast/missions</topic>");
}

}  // namespace trailcast::test
