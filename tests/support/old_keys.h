#pragma once

#include <filesystem>
#include <stdexcept>

#include "services/security/folder_layout.h"
#include "services/security/member.h"
#include "services/security/src/files.h"
#include "services/security/src/signing.h"

namespace trailcast::test {

// Makes a member's folder one that was given before segments had scopes: its permissions do not
// allow the partitions below the member's own.
inline void MakeOfBeforeScopes(const std::filesystem::path& authority,
                               const std::filesystem::path& keys) {
  using security::ReadSmallFile;
  const security::Identity signer{ReadSmallFile(authority / security::kAuthorityFile).value(),
                                  ReadSmallFile(authority / security::kAuthorityKeyFile).value()};
  const std::filesystem::path file = keys / security::kPermissionsFile;
  std::string text = security::OpenSigned(ReadSmallFile(file).value(), signer.certificate).value();
  const std::size_t end = text.find("/*</partition>");
  const std::size_t begin = text.rfind("<partition>", end);
  if (end == std::string::npos) throw std::runtime_error("there are no scopes in " + text);
  text.erase(begin, end + std::string("/*</partition>").size() - begin);
  if (!security::WriteFile(file, security::Sign(text, signer).value(), security::kForEverybody)) {
    throw std::runtime_error("cannot write " + file.string());
  }
}

}  // namespace trailcast::test
