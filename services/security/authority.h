#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/security/certificates.h"
#include "services/security/member.h"

namespace trailcast::security {

// The fleet's authority: a folder that stays on one machine and whose key signs who is a member and
// what it may do. In it, members/NAME/ is to be copied to that member's machine (member_keys.h
// reads it), and issued/NAME.GENERATION.pem are all certificates ever issued. Two processes must
// not use it at once.
class Authority {
 public:
  // Makes an authority. kConflict means that the folder has one already, which is never replaced.
  [[nodiscard]] static Result<Authority> Create(const std::filesystem::path& folder, Time now,
                                                int days);
  // kNotFound means that the folder has no authority.
  [[nodiscard]] static Result<Authority> Open(const std::filesystem::path& folder);

  // Adds a member and returns its folder. kConflict means that one of that name exists, revoked or
  // not.
  [[nodiscard]] Result<std::filesystem::path> Add(const std::string& name, Role role, Time now,
                                                  int days) const;
  // Issues a member's keys of the next generation. With another role, the earlier ones are revoked.
  // This also reinstates a revoked member.
  [[nodiscard]] Result<std::filesystem::path> Renew(const std::string& name,
                                                    std::optional<Role> role, Time now,
                                                    int days) const;
  // Puts all certificates of the member on the list of revoked ones, in every member's folder here.
  [[nodiscard]] Result<void> Revoke(const std::string& name, Time now) const;

  enum class State : std::uint8_t { kValid, kExpired, kRevoked };
  struct Row {
    std::string name;
    Member member;  // the latest generation
    Time expires;
    State state = State::kValid;
  };
  [[nodiscard]] Result<std::vector<Row>> List(Time now) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // Returns the file with the list of revoked certificates, which goes to every member's machine.
  [[nodiscard]] std::filesystem::path RevocationFile() const;

 private:
  Authority(std::filesystem::path folder, Identity identity, std::string name_key, Time until)
      : folder_(std::move(folder)),
        identity_(std::move(identity)),
        name_key_(std::move(name_key)),
        until_(until) {}

  struct Issued {
    std::uint32_t generation = 0;
    CertificateFacts facts;
    Member member;
  };
  // Returns one member's certificates by generation; they are empty if there is no such member.
  [[nodiscard]] Result<std::vector<Issued>> IssuedTo(const std::string& name) const;
  [[nodiscard]] Result<std::vector<std::string>> Names() const;
  [[nodiscard]] Result<std::filesystem::path> Give(const std::string& name, const Member& member,
                                                   Time now, int days) const;
  [[nodiscard]] Result<void> RevokeSerials(const std::vector<Issued>& issued, Time now) const;
  // Does the same for a member that must exist; kNotFound names the existing ones.
  [[nodiscard]] Result<std::vector<Issued>> Known(const std::string& name) const;

  std::filesystem::path folder_;
  Identity identity_;
  std::string name_key_;
  Time until_;  // when the authority itself expires
};

}  // namespace trailcast::security
