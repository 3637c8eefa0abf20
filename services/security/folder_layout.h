#pragma once

namespace trailcast::security {

// These are the files of a member's folder. All but identity.key and member.toml may be shown to
// anybody.
inline constexpr const char* kAuthorityFile = "authority.pem";    // the authority's certificate
inline constexpr const char* kGovernanceFile = "governance.p7s";  // signed
inline constexpr const char* kRevokedFile = "revoked.pem";        // list of revoked certificates
inline constexpr const char* kIdentityFile = "identity.pem";      // the member's certificate
inline constexpr const char* kIdentityKeyFile = "identity.key";
inline constexpr const char* kPermissionsFile = "permissions.p7s";  // signed
inline constexpr const char* kMemberFile = "member.toml";  // name, and the fleet's name key

// The authority has the first three as well, and these:
inline constexpr const char* kAuthorityKeyFile = "authority.key";
inline constexpr const char* kNameKeyFile = "name.key";
inline constexpr const char* kIssuedFolder = "issued";
inline constexpr const char* kMembersFolder = "members";

}  // namespace trailcast::security
